// SPDX-License-Identifier: MIT
#include "plot/spectrum_picture.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "plot/drawing/colour_bar.hpp"
#include "report/grid_files.hpp"

namespace stipple::plot {
namespace {

Colour grey(double power) {
    const auto level = static_cast<std::uint8_t>(std::lround(255 * shade_of_power(power)));
    return {level, level, level};
}

PixelImage picture_of(const Grid& power, const Area& area) {
    PixelImage raster{.area = area, .columns = power.columns, .rows = power.rows};
    raster.pixels.reserve(power.values.size());
    for (std::size_t row = power.rows; row-- > 0;)
        for (std::size_t column = 0; column < power.columns; ++column) {
            const bool centre = row == power.rows / 2 && column == power.columns / 2;
            raster.pixels.push_back(centre ? Colour{}
                                           : grey(power.values[row * power.columns + column]));
        }
    return raster;
}

}  // namespace

Drawing draw_spectrum(const Grid& power, const std::string& title, const std::string& subtitle,
                      const PictureStyle& style, const TableNames& names) {
    if (power.rows != power.columns || power.rows % 2 == 0)
        fail(ErrorKind::input,
             "a spectrum is a table of (2F + 1) x (2F + 1) numbers; there are {} x {}", power.rows,
             power.columns);
    if (std::ranges::any_of(power.values, [](double p) { return !(p >= 0); }))
        fail(ErrorKind::input, "a spectrum has no negative power; this table has");
    const Theme& theme = *style.theme;
    const double last = (static_cast<double>(power.rows / 2) + 0.5) * names.cell;
    const bool whole = names.cell == 1;
    const Axis x{.low = -last, .high = last, .whole = whole, .name = names.x};
    const Axis y{.low = -last, .high = last, .whole = whole, .name = names.y};
    auto [drawing, top] = titled_drawing(title, subtitle, style, 640);
    const double left = std::ceil(picture_margin / 2 + Panel::room_left(y, 500));
    const double below = Panel::room_below(x) + picture_margin;
    double side = std::floor(drawing.width - left - colour_bar_room - picture_margin);
    if (style.height > 0) side = std::min(side, std::floor(style.height - top - below - 14));
    side = std::max(side, 60.0);
    if (style.height <= 0) drawing.height = std::ceil(top + 14 + side + below);
    const Area frame{left, std::ceil(top) + 14, side, side};
    drawing.add(picture_of(power, frame));
    Panel(frame, x, y).draw_axes(drawing, theme, true);
    draw_colour_bar(drawing, {frame.right() + 14, frame.top, 14, side}, names.shade, theme,
                    [](double s) {
                        const auto level = static_cast<std::uint8_t>(std::lround(255 * s));
                        return Colour{level, level, level};
                    },
                    {{0, "0"}, {0.2, "1/4"}, {0.5, "1"}, {0.8, "4"}, {1, "∞"}});
    return std::move(drawing);
}

}  // namespace stipple::plot
