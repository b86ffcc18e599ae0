// SPDX-License-Identifier: MIT
#include "plot/text_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/text.hpp"
#include "io/format.hpp"
#include "plot/drawing/dot_matrix.hpp"
#include "plot/drawing/ticks.hpp"
#include "report/grid_files.hpp"

namespace stipple::plot {
namespace {

constexpr std::size_t frame_columns = 3;  ///< beside the field, without the numbers
constexpr std::size_t frame_rows = 6;     ///< title, names, frame and numbers, and the prompt
constexpr std::size_t least_columns = 8;
constexpr std::size_t least_rows = 4;

std::size_t inner(std::size_t room, std::size_t taken, std::size_t least) {
    return room > taken + least ? room - taken : least;
}

/// Letters that are left beside the numbers.
std::size_t columns_for(const TextRoom& room, const TextFrame& frame) {
    const std::size_t numbers =
        std::max(code_points(frame.low_y).size(), code_points(frame.high_y).size());
    return inner(room.columns, frame_columns + numbers, least_columns);
}

/// A field for a picture of that height over width, where a dot is as high as wide.
DotMatrix field_for(const TextRoom& room, const TextFrame& frame, double ratio) {
    const std::size_t columns = columns_for(room, frame);
    const std::size_t rows = inner(room.rows, frame_rows, least_rows);
    const double wanted = ratio * static_cast<double>(columns) / 2;
    if (wanted <= static_cast<double>(rows))
        return {columns, std::max<std::size_t>(static_cast<std::size_t>(std::lround(wanted)), 2)};
    const auto narrow =
        static_cast<std::size_t>(std::lround(2 * static_cast<double>(rows) / ratio));
    return {std::clamp(narrow, least_columns, columns), rows};
}

std::string plane_as_text(const PointsPicture& picture, const TextRoom& room) {
    const Box box = shown_box(picture.sets);
    const auto names = coordinate_names(box.dimension());
    const TextFrame frame{.title = picture.title,
                          .low_x = rounded(box.low[0]),
                          .high_x = rounded(box.high[0]),
                          .name_x = names[0],
                          .low_y = rounded(box.low[1]),
                          .high_y = rounded(box.high[1]),
                          .name_y = names[1]};
    DotMatrix dots = field_for(room, frame, std::clamp(box.extent(1) / box.extent(0), 0.05, 20.0));
    for (const PointSet* set : picture.sets)
        for (std::size_t i = 0; i < set->count(); ++i)
            dots.set(((*set)[i][0] - box.low[0]) / box.extent(0),
                     ((*set)[i][1] - box.low[1]) / box.extent(1));
    return framed(dots, frame);
}

std::string space_as_text(const PointsPicture& picture, const TextRoom& room) {
    const Box box = shown_box(picture.sets);
    const auto [low, high] = projected_range(box);
    const double across = high.right - low.right;
    const double upward = high.up - low.up;
    DotMatrix dots = field_for(room, {}, upward / across);
    for (const PointSet* set : picture.sets)
        for (std::size_t i = 0; i < set->count(); ++i) {
            const Projected projected = project(box, (*set)[i]);
            dots.set((projected.right - low.right) / across, (projected.up - low.up) / upward);
        }
    return framed(dots, {.title = picture.title, .name_x = "x and y to the right, z upward"});
}

void draw_bars(DotMatrix& dots, const Bars& bars, const Axis& x, const Axis& y) {
    for (std::size_t i = 0; i < bars.heights.size(); ++i) {
        const double top = y.share(bars.heights[i]);
        const double left = x.share(bars.edges[i]);
        const double right = x.share(bars.edges[i + 1]);
        const double step = 1 / static_cast<double>(dots.width());
        if (!(bars.heights[i] > 0)) continue;
        for (double at = left + step / 2; at < right; at += step) dots.draw(at, 0, at, top);
    }
}

}  // namespace

std::string chart_as_text(const Chart& chart, const PictureStyle& style, const TextRoom& room) {
    const auto [x, y] = chart_axes(chart, 0, style);
    const ChartPanel& panel = chart.panels[0];
    const auto scale = [](const Axis& axis) { return axis.log ? " (logarithmic)" : ""; };
    const TextFrame frame{.title = style.title.value_or(chart.title),
                          .low_x = rounded(x.low),
                          .high_x = rounded(x.high),
                          .name_x = chart.panels.back().x_name + scale(x),
                          .low_y = rounded(y.low, 3),
                          .high_y = rounded(y.high, 3),
                          .name_y = panel.y_name + scale(y)};
    DotMatrix dots(columns_for(room, frame), inner(room.rows, frame_rows, least_rows));
    for (const Bars& bars : panel.bars) draw_bars(dots, bars, x, y);
    for (const Series& series : panel.series)
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            const double right = x.share(series.x[i]);
            const double up = y.share(series.y[i]);
            const bool joined = i > 0 && std::isfinite(series.y[i - 1]);
            if (joined)
                dots.draw(x.share(series.x[i - 1]), y.share(series.y[i - 1]), right, up);
            else
                dots.set(right, up);
        }
    return framed(dots, frame);
}

std::string points_as_text(const PointsPicture& picture, const TextRoom& room) {
    const std::size_t d = picture.sets[0]->dimension();
    if (d == 1) return chart_as_text(histogram_chart(picture), {}, room);
    return d == 3 ? space_as_text(picture, room) : plane_as_text(picture, room);
}

std::string spectrum_as_text(const Grid& power, const std::string& title, const TextRoom& room) {
    constexpr std::array<const char*, 5> shades = {" ", "░", "▒", "▓", "█"};
    const std::size_t rows =
        std::min({inner(room.rows, frame_rows, least_rows),
                  inner(room.columns, frame_columns, least_columns) / 2, power.rows});
    const std::size_t columns = 2 * rows;
    std::string text = printable(title) + "\n";
    for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 0; i < columns; ++i) {
            const std::size_t top = (rows - 1 - j) * power.rows / rows;
            const std::size_t bottom = std::max((rows - j) * power.rows / rows, top + 1);
            const std::size_t left = i * power.columns / columns;
            const std::size_t right = std::max((i + 1) * power.columns / columns, left + 1);
            double sum = 0;
            double cells = 0;
            for (std::size_t row = top; row < bottom; ++row)
                for (std::size_t column = left; column < right; ++column) {
                    const double p = power.values[row * power.columns + column];
                    const bool centre = row == power.rows / 2 && column == power.columns / 2;
                    sum += centre ? 0 : shade_of_power(p);
                    ++cells;
                }
            text += shades[static_cast<std::size_t>(std::clamp(5 * sum / cells, 0.0, 4.0))];
        }
        text += "\n";
    }
    return text + fmt::format("frequencies from −{0} to {0}\n", power.rows / 2);
}

}  // namespace stipple::plot
