// SPDX-License-Identifier: MIT
//
// Pictures as text for terminals: points, the curves of a chart, a spectrum, a local discrepancy.
#pragma once

#include <string>
#include <vector>

#include "plot/chart.hpp"
#include "plot/local_discrepancy.hpp"
#include "plot/points_picture.hpp"
#include "stipple/report.hpp"

namespace stipple::plot {

/// Characters that there is room for. Both at least 1; what is too small is made as large as needed.
struct TextRoom {
    std::size_t columns = 80;
    std::size_t rows = 24;
    bool coloured = false;  ///< by a terminal's codes
};

/// Points of one coordinate: their histogram; of two: where they are; of three: seen from a fixed
/// place; of more: as many of the first pairs as the columns have room for.
std::string points_as_text(const PointsPicture& picture, const TextRoom& room);

/// All curves and bars, panel below panel. Where there are several, each has a letter, which stands
/// where it ends, on the right.
std::string chart_as_text(const Chart& chart, PictureStyle style, const TextRoom& room);

/// A spectrum in five shades.
std::string spectrum_as_text(const Grid& power, const std::string& title, const TextRoom& room);

/// The local discrepancy in shades up to `largest`: blocks where there are too many points, letters
/// where there are too few.
std::string local_discrepancy_as_text(const PointSet& points, const WorstBoxes& worst,
                                      const std::string& title, double largest,
                                      const TextRoom& room, const RunContext& run);

/// Room for each of several pictures.
TextRoom shared_room(const TextRoom& room, std::size_t pictures);

/// Pictures that were made for such a room, side by side.
std::string side_by_side(const std::vector<std::string>& pictures, const TextRoom& room);

}  // namespace stipple::plot
