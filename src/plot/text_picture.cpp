// SPDX-License-Identifier: MIT
#include "plot/text_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/text.hpp"
#include "io/format.hpp"
#include "plot/drawing/dot_matrix.hpp"
#include "plot/drawing/ticks.hpp"
#include "report/grid_files.hpp"

namespace stipple::plot {
namespace {

constexpr std::size_t frame_columns = 3;  ///< columns of the frame, without the numbers beside it
constexpr std::size_t frame_rows = 6;     ///< title, names, frame, numbers and shell prompt
constexpr std::array<const char*, 5> shades = {" ", "░", "▒", "▓", "█"};
constexpr std::size_t least_columns = 8;
constexpr std::size_t least_rows = 4;

std::size_t inner(std::size_t room, std::size_t taken, std::size_t least) {
    return room > taken + least ? room - taken : least;
}

/// Number of columns for the picture itself, without its frame and the numbers beside it.
std::size_t columns_for(const TextRoom& room, const TextFrame& frame) {
    const std::size_t numbers =
        std::max(code_points(frame.low_y).size(), code_points(frame.high_y).size());
    return inner(room.columns, frame_columns + numbers, least_columns);
}

/// Matrix of dots for a picture with this ratio of height to width; dots are as high as wide.
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

/// Draws coordinates i and j of the points; both have equal scales for two-dimensional points.
std::string plane_as_text(const PointsPicture& picture, const TextRoom& room, std::size_t i = 0,
                          std::size_t j = 1) {
    const Box box = shown_box(picture.sets);
    const bool plane = box.dimension() == 2;
    const auto names = shown_names(picture);
    const auto [low_x, high_x] = shown_ends(picture, box, i);
    const auto [low_y, high_y] = shown_ends(picture, box, j);
    const TextFrame frame{.low_x = printable(low_x),
                          .high_x = printable(high_x),
                          .name_x = printable(names[i]),
                          .low_y = printable(low_y),
                          .high_y = printable(high_y),
                          .name_y = printable(names[j]),
                          .coloured = room.coloured};
    const double ratio = plane ? picture_ratio(picture, box) : 1;
    const Axis x = shown_axis(picture, box, i);
    const Axis y = shown_axis(picture, box, j);
    DotMatrix dots = field_for(room, frame, ratio);
    for (std::size_t s = 0; s < picture.sets.size(); ++s) {
        dots.take_pen(s);
        const PointSet& set = *picture.sets[s];
        for (std::size_t k = 0; k < set.count(); ++k)
            dots.set(x.share(set[k][i]), y.share(set[k][j]));
    }
    return framed(dots, frame);
}

std::string pairs_as_text(const PointsPicture& picture, const TextRoom& room) {
    constexpr std::size_t least = 24;  // minimum number of columns for a pair
    const std::size_t d = picture.sets[0]->dimension();
    const std::size_t shown = std::min(d, std::max<std::size_t>(3, 1 + room.columns / least));
    TextRoom part = room;
    part.columns = room.columns / (shown - 1) - 1;
    std::string text;
    for (std::size_t j = 1; j < shown; ++j) {
        std::vector<std::string> row;
        for (std::size_t i = 0; i < j; ++i) row.push_back(plane_as_text(picture, part, i, j));
        text += side_by_side(row, room);
    }
    if (shown == d) return text;
    return text + fmt::format("the first {} of {} coordinates\n", shown, d);
}

std::string space_as_text(const PointsPicture& picture, const TextRoom& room) {
    const Box box = shown_box(picture.sets);
    const auto [low, high] = projected_range(box);
    const double across = high.right - low.right;
    const double upward = high.up - low.up;
    DotMatrix dots = field_for(room, {}, upward / across);
    for (std::size_t s = 0; s < picture.sets.size(); ++s) {
        dots.take_pen(s);
        for (std::size_t i = 0; i < picture.sets[s]->count(); ++i) {
            const Projected projected = project(box, (*picture.sets[s])[i]);
            dots.set((projected.right - low.right) / across, (projected.up - low.up) / upward);
        }
    }
    const auto names = shown_names(picture);
    return framed(dots, {.name_x = printable(fmt::format("{} and {} to the right, {} upward",
                                                         names[0], names[1], names[2])),
                         .coloured = room.coloured});
}

/// Draws bars. @param base relative height, 0 to 1, at which the bars start
void draw_bars(DotMatrix& dots, const Bars& bars, const Axis& x, const Axis& y, double base = 0) {
    for (std::size_t i = 0; i < bars.heights.size(); ++i) {
        const double top = std::min(y.share(bars.heights[i]), 1.0);
        const auto columns = static_cast<double>(dots.width());
        const double left = std::max(x.share(bars.edges[i]), 0.0);
        const double right = std::min(x.share(bars.edges[i + 1]), 1.0);
        if (!(left < right) || (!(bars.heights[i] > 0) && base == 0)) continue;
        // A bar has the columns whose middle it covers; a thinner one, the column of its own middle.
        const auto first_from = [&](double share) {
            return std::ceil(share * columns - 0.5 - 1e-9);
        };
        const bool thin = first_from(left) >= first_from(right);
        const double first = thin ? std::floor((left + right) / 2 * columns) : first_from(left);
        const double end = thin ? first + 1 : first_from(right);
        for (double column = first; column < end; ++column)
            dots.draw((column + 0.5) / columns, base, (column + 0.5) / columns, top);
    }
}

/// Letter of a curve: a, b, ..., z, A, ...
std::string curve_letter(std::size_t curve) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    return std::string(1, letters[curve % letters.size()]);
}

/// Legend: letters and names of curves, or squares and names of bars; empty if needs_legend() is
/// false.
std::string legend_as_text(const Chart& chart, std::size_t number, const TextRoom& room) {
    if (!needs_legend(chart, number)) return {};
    const ChartPanel& panel = chart.panels[number];
    std::vector<std::string> names;
    for (const Bars& bars : panel.bars) names.push_back(bars.name);
    for (const Series& series : panel.series) names.push_back(series.name);
    std::string text;
    std::size_t used = 0;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string name = " " + printable(names[i]);
        const std::size_t width = 1 + code_points(name).size();
        const bool fits = used > 0 && used + 3 + width <= room.columns;
        text += fits ? "   " : used > 0 ? "\n" : "";
        used = fits ? used + 3 + width : width;
        const std::size_t bars = panel.bars.size();
        text += in_colour(i < bars ? "■" : curve_letter(i - bars), i, room.coloured) + name;
    }
    return text + "\n";
}

void draw_curve(DotMatrix& dots, const Series& series, const Axis& x, const Axis& y) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        const double right = x.share(series.x[i]);
        const double up = y.share(series.y[i]);
        if (i > 0 && std::isfinite(series.y[i - 1]))
            dots.draw(x.share(series.x[i - 1]), y.share(series.y[i - 1]), right, up);
        else
            dots.set(right, up);
    }
}

/// Draws series i as bars, one in each category.
void draw_columns(DotMatrix& dots, const ChartPanel& panel, std::size_t i, const Axis& x,
                  const Axis& y) {
    const Series& series = panel.series[i];
    for (std::size_t c = 0; c < series.x.size(); ++c) {
        const auto [left, right] = bar_edges(panel, i, series.x[c]);
        const Bars bar{.edges = {left, right}, .heights = {series.y[c]}};
        if (std::isfinite(series.y[c])) draw_bars(dots, bar, x, y, y.share(0));
    }
}

/// For each row of `dots`, the letters of the curves that end at its height.
std::vector<std::string> ends_of(const ChartPanel& panel, const DotMatrix& dots, const Axis& y,
                                 bool coloured) {
    const std::size_t rows = dots.height() / 4;
    std::vector<std::string> ends(rows);
    for (std::size_t s = 0; s < panel.series.size(); ++s) {
        const auto& values = panel.series[s].y;
        const auto last = std::find_if(values.rbegin(), values.rend(),
                                       [](double value) { return std::isfinite(value); });
        if (last == values.rend()) continue;
        const std::size_t row = cell_at(std::clamp(y.share(*last), 0.0, 1.0), rows).value_or(0);
        std::string& end = ends[rows - 1 - row];
        if (end.empty()) end = " ";
        end += in_colour(curve_letter(s), s, coloured);
    }
    return ends;
}

/// Numbers at the ends of a panel's y axis.
std::pair<std::string, std::string> ends_upward(const Chart& chart, std::size_t number,
                                                const PictureStyle& style) {
    const Axis y = chart_axes(chart, number, style).second;
    return rounded_ends(y.low, y.high, 3);
}

/// One panel in its frame. If all panels share the x axis, only the last one shows its numbers.
/// @param side width of the numbers to the left of all panels
std::string panel_as_text(const Chart& chart, std::size_t number, const PictureStyle& style,
                          std::size_t side, const TextRoom& room) {
    const auto [x, y] = chart_axes(chart, number, style);
    const ChartPanel& panel = chart.panels[number];
    const bool last = chart.own_x || number + 1 == chart.panels.size();
    const auto scale = [](const Axis& axis) { return axis.log ? " (logarithmic)" : ""; };
    TextFrame frame{.name_x = last ? printable(x.name) + scale(x) : "",
                    .name_y = printable(y.name) + scale(y),
                    .coloured = room.coloured};
    std::tie(frame.low_y, frame.high_y) = ends_upward(chart, number, style);
    if (last) std::tie(frame.low_x, frame.high_x) = rounded_ends(x.low, x.high);
    if (!panel.categories.empty()) {
        frame.low_x = frame.high_x = "";
        frame.name_x = printable(join(panel.categories, ", "));
    }
    frame.high_y.insert(0, side - std::min(side, code_points(frame.high_y).size()), ' ');
    const bool several = panel.series.size() > 1;
    const std::size_t letters = several ? std::min<std::size_t>(1 + panel.series.size(), 5) : 0;
    const std::size_t columns = columns_for(room, frame);
    DotMatrix dots(columns > letters + least_columns ? columns - letters : columns,
                   inner(room.rows, frame_rows, least_rows));
    std::size_t pen = 0;
    for (const Bars& bars : panel.bars) {
        dots.take_pen(pen++);
        draw_bars(dots, bars, x, y);
    }
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
        dots.take_pen(pen++);
        if (panel.categories.empty())
            draw_curve(dots, panel.series[i], x, y);
        else
            draw_columns(dots, panel, i, x, y);
    }
    if (several) frame.beside = ends_of(panel, dots, y, room.coloured);
    return framed(dots, frame);
}

}  // namespace

std::string chart_as_text(const Chart& chart, PictureStyle style, const TextRoom& room) {
    style.tight = true;  // axes, and their numbers, end exactly at the data
    std::string text;
    TextRoom part = room;
    part.rows = std::max(room.rows / chart.panels.size(), frame_rows + 2 * least_rows);
    std::size_t side = 0;
    for (std::size_t number = 0; number < chart.panels.size(); ++number)
        for (const auto& [low, high] = ends_upward(chart, number, style);
             const std::string& end : {low, high})
            side = std::max(side, code_points(end).size());
    for (std::size_t number = 0; number < chart.panels.size(); ++number) {
        if (room.letter && chart.panels.size() > 1) text += letter_of(*room.letter + number) + "\n";
        text +=
            legend_as_text(chart, number, room) + panel_as_text(chart, number, style, side, part);
    }
    return text;
}

std::string points_as_text(const PointsPicture& picture, const TextRoom& room) {
    const std::size_t d = picture.sets[0]->dimension();
    if (d == 1) return chart_as_text(histogram_chart(picture), {}, room);
    if (is_space(picture)) return space_as_text(picture, room);
    return d > 2 ? pairs_as_text(picture, room) : plane_as_text(picture, room);
}

TextRoom shared_room(const TextRoom& room, std::size_t pictures) {
    constexpr std::size_t least = 32;  // minimum number of columns for a picture
    TextRoom part = room;
    const std::size_t beside =
        std::clamp<std::size_t>(room.columns / least, 1, std::max<std::size_t>(pictures, 1));
    part.columns = room.columns / beside - (beside > 1 ? 1 : 0);
    return part;
}

std::string side_by_side(const std::vector<std::string>& pictures, const TextRoom& room) {
    std::string text;
    for (std::size_t first = 0; first < pictures.size();) {
        std::vector<std::string> lines;
        std::size_t used = 0;
        std::size_t at = first;
        for (; at < pictures.size(); ++at) {
            std::size_t width = 0;
            std::vector<std::string_view> own = split(pictures[at], '\n');
            if (own.back().empty()) own.pop_back();
            for (const auto line : own) width = std::max(width, shown_width(line));
            if (at > first && used + width > room.columns) break;
            lines.resize(std::max(lines.size(), own.size()));
            for (std::size_t i = 0; i < own.size(); ++i) {
                lines[i].append(used - std::min(used, shown_width(lines[i])), ' ');
                lines[i] += own[i];
            }
            used += width + 1;
        }
        text += join(lines, "\n") + "\n";
        first = at;
    }
    return text;
}

std::string spectrum_as_text(const Grid& power, const TextRoom& room) {
    const std::size_t rows =
        std::min({inner(room.rows, frame_rows, least_rows),
                  inner(room.columns, frame_columns, least_columns) / 2, power.rows});
    const std::size_t columns = 2 * rows;
    std::string text;
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

std::string pair_table_as_text(const PairTable& table, double largest) {
    std::string text;
    for (std::size_t j = table.dimension - 1; j > 0; --j) {
        text += fmt::format("{:3} │", j + 1);
        for (std::size_t i = 0; i < j; ++i) {
            const double share = largest > 0 ? table.at(i, j) / largest : 0;
            const char* shade = shades[static_cast<std::size_t>(std::clamp(5 * share, 0.0, 4.0))];
            text += fmt::format("{0}{0}", shade);
        }
        text += "\n";
    }
    return text + fmt::format("    └{0:─<{1}}\n     1{2:>{3}}\n", "", 2 * (table.dimension - 1),
                              table.dimension - 1, 2 * (table.dimension - 1) - 1);
}

std::string local_discrepancy_as_text(const PointSet& points, const WorstBoxes& worst,
                                      double largest, const TextRoom& room, const RunContext& run) {
    constexpr std::array<const char*, 5> few = {" ", "·", ":", "o", "O"};
    const std::size_t rows = std::min(inner(room.rows, frame_rows + 2, least_rows),
                                      inner(room.columns, frame_columns, least_columns) / 2);
    const Grid grid = local_discrepancy(points, 2 * rows, rows, run);
    std::string text = fmt::format("┌{:─<{}}┐\n", "", grid.columns);
    for (std::size_t row = rows; row-- > 0;) {
        text += "│";
        for (std::size_t column = 0; column < grid.columns; ++column) {
            const double share = grid.values[row * grid.columns + column] / largest;
            const auto level = static_cast<std::size_t>(std::clamp(5 * std::abs(share), 0.0, 4.0));
            const char* letter = (share < 0 ? few : shades)[level];
            text += level == 0 ? letter : in_colour(letter, share < 0 ? 0 : 1, room.coloured);
        }
        text += "│\n";
    }
    text += fmt::format("└{:─<{}}┘\n", "", grid.columns);
    text += fmt::format("star discrepancy {}\n", rounded(worst.star(), 6));
    const auto narrow = [](const std::optional<AnchoredBox>& box) {
        std::string words = box ? text_of(*box, 3) : "nowhere";
        std::erase(words, ' ');
        return words;
    };
    return text +
           fmt::format("few ·:oO {}\nmany ░▒▓█ {}\n", narrow(worst.open), narrow(worst.closed));
}

}  // namespace stipple::plot
