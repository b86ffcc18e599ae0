// SPDX-License-Identifier: MIT
//
// Pictures as text for terminals: points, the curves of a chart, a spectrum.
#pragma once

#include <string>

#include "plot/chart.hpp"
#include "plot/points_picture.hpp"
#include "stipple/report.hpp"

namespace stipple::plot {

/// Characters that there is room for. Both at least 1; what is too small is made as large as needed.
struct TextRoom {
    std::size_t columns = 80;
    std::size_t rows = 24;
};

/// Points of one coordinate: their histogram; of two: where they are; of three: seen from a fixed
/// place; of more: the first two coordinates.
std::string points_as_text(const PointsPicture& picture, const TextRoom& room);

/// All curves and bars of the first panel.
std::string chart_as_text(const Chart& chart, const PictureStyle& style, const TextRoom& room);

/// A spectrum in five shades.
std::string spectrum_as_text(const Grid& power, const std::string& title, const TextRoom& room);

}  // namespace stipple::plot
