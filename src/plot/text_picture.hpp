// SPDX-License-Identifier: MIT
//
// Pictures as text for terminals: points, charts, spectra, local discrepancies.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plot/chart.hpp"
#include "plot/local_discrepancy.hpp"
#include "plot/pair_table.hpp"
#include "plot/points_picture.hpp"
#include "stipple/report.hpp"

namespace stipple::plot {

/// Available characters, at least 1 in each direction. Pictures that need more exceed them. The
/// rows include one for the title, written by the caller.
struct TextRoom {
    std::size_t columns = 80;
    std::size_t rows = 24;
    bool coloured = false;                   ///< uses terminal colour codes
    std::optional<std::size_t> letter = {};  ///< letter of the first panel: 0 for (a)
};

/// One coordinate: a histogram. Two: the plane. Three: a view from a fixed direction. More: as many
/// of the first pairs as fit into the columns.
std::string points_as_text(const PointsPicture& picture, const TextRoom& room);

/// All curves and bars, one panel below the other. Each of several curves has a letter at its end,
/// on the right.
std::string chart_as_text(const Chart& chart, PictureStyle style, const TextRoom& room);

/// A spectrum in five shades of grey.
std::string spectrum_as_text(const Grid& power, const TextRoom& room);

/// The local discrepancy in shades up to `largest`: blocks for boxes with too many points, letters
/// for boxes with too few.
std::string local_discrepancy_as_text(const PointSet& points, const WorstBoxes& worst,
                                      double largest, const TextRoom& room, const RunContext& run);

/// One number for each pair of coordinates, in five shades up to `largest`.
std::string pair_table_as_text(const PairTable& table, double largest);

/// Room for each of several pictures, if as many as fit into a row are placed side by side.
TextRoom shared_room(const TextRoom& room, std::size_t pictures);

/// Joins pictures side by side; starts a new row where room.columns is exceeded.
std::string side_by_side(const std::vector<std::string>& pictures, const TextRoom& room);

}  // namespace stipple::plot
