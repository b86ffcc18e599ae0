// SPDX-License-Identifier: MIT
#include "plot/local_discrepancy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/error.hpp"
#include "io/format.hpp"
#include "math/discrepancy/star/search.hpp"
#include "pipeline/pipeline.hpp"

namespace stipple::plot {
namespace {

double middle_of_cell(std::size_t cell, std::size_t cells) {
    return (static_cast<double>(cell) + 0.5) / static_cast<double>(cells);
}

/// Index of the first cell whose middle is above x; `cells` if there is none.
std::size_t first_cell_above(double x, std::size_t cells) {
    const auto all = static_cast<double>(cells);
    auto cell = static_cast<std::size_t>(std::min(std::floor(x * all + 0.5), all));
    // Corrects rounding errors of the product and of the middles.
    while (cell > 0 && x < middle_of_cell(cell - 1, cells)) --cell;
    while (cell < cells && !(x < middle_of_cell(cell, cells))) ++cell;
    return cell;
}

std::optional<AnchoredBox> box_of(const discrepancy::WorstBox& worst, double sign) {
    constexpr double rounding = 1e-12;  // largest rounding error of a value that is 0
    if (!(worst.value() > rounding)) return std::nullopt;
    const auto corner = worst.corner(&discrepancy::Interval::upper);
    return AnchoredBox{.corner = {corner[0], corner[1]}, .value = sign * worst.value()};
}

/// Blue for too few points, orange for too many, which colour-blind readers can distinguish.
Colour colour_of_discrepancy(double share, const Theme& theme) {
    const double size = std::min(std::abs(share), 1.0);
    return mixed(theme.background, theme.series_colour(share < 0 ? 0 : 1), size);
}

/// Number of pixels between two positions, rounded as by png_bytes_of(). @param resolution pixels
/// per unit
std::size_t pixels_between(double from, double to, double resolution) {
    constexpr double most = 2048;
    const double pixels = std::round(to * resolution) - std::round(from * resolution);
    return static_cast<std::size_t>(std::clamp(pixels, 1.0, most));
}

PixelImage image_of_discrepancy(const Grid& grid, const Area& area, double largest,
                                const Theme& theme) {
    PixelImage image{.area = area, .columns = grid.columns, .rows = grid.rows};
    image.pixels.reserve(grid.values.size());
    for (std::size_t row = grid.rows; row-- > 0;)
        for (std::size_t column = 0; column < grid.columns; ++column)
            image.pixels.push_back(
                colour_of_discrepancy(grid.values[row * grid.columns + column] / largest, theme));
    return image;
}

/// Draws points as small disks, except if they would cover much of the image.
void draw_dots(Drawing& drawing, const PointSet& points, const Panel& panel, const Theme& theme) {
    constexpr double least = 4;  // minimum distance of as many points on a grid, in units
    const double apart = panel.frame().width / std::sqrt(static_cast<double>(points.count()));
    if (apart < least) return;
    Disks dots{.radius = std::clamp(0.05 * apart, 0.6, 2.0), .colour = theme.ink};
    for (std::size_t i = 0; i < points.count(); ++i)
        dots.centres.push_back(panel.at(points[i][0], points[i][1]));
    drawing.add(std::move(dots));
}

LegendEntry legend_entry(const std::string& what, const std::optional<AnchoredBox>& box, Dash dash,
                         const Theme& theme) {
    return {.name = fmt::format("{}: {}", what, box ? text_of(*box, 4) : "in no box"),
            .colour = theme.ink,
            .dash = dash};
}

void draw_box(Drawing& drawing, const std::optional<AnchoredBox>& box, const Panel& panel,
              Dash dash, const Theme& theme) {
    if (!box) return;
    const auto [x, y] = box->corner;
    drawing.add(Line{.vertices = {panel.at(0, 0), panel.at(x, 0), panel.at(x, y), panel.at(0, y),
                                  panel.at(0, 0)},
                     .colour = theme.ink,
                     .width = 2,
                     .dash = dash});
}

/// Draws the colour bar, with "too many" and "too few" at its ends.
void draw_bar_of_discrepancy(Drawing& drawing, const Area& frame, double largest,
                             const Theme& theme) {
    const Area bar = bar_beside(frame);
    const Ticks ticks = linear_ticks(-largest, largest, 9);
    std::vector<Tick> shares;
    for (const auto& [value, text] : ticks.numbers)
        shares.push_back({(value / largest + 1) / 2, text});
    draw_colour_bar(
        drawing, bar, "too many", theme,
        [&](double share) { return colour_of_discrepancy(2 * share - 1, theme); }, shares);
    const auto put_below = [&](const std::string& text, double down) {
        drawing.add(
            Label{.text = text,
                  .at = {bar.left + 4, bar.bottom() + down},  // beside the last number of the axis
                  .size = number_size,
                  .colour = theme.ink});
    };
    put_below("too few", 17);
    if (ticks.exponent != 0) put_below(fmt::format("(×{})", power_of_ten(ticks.exponent)), 33);
}

}  // namespace

double WorstBoxes::star() const {
    return std::max(open ? -open->value : 0, closed ? closed->value : 0);
}

WorstBoxes worst_boxes_of(const PointSet& points, const RunContext& run) {
    if (points.dimension() != 2)
        fail_with_hint(
            ErrorKind::input, points.dimension() > 2 ? "--column selects two of them" : "",
            "the local discrepancy can be drawn for points of 2 coordinates; these have {}",
            points.dimension());
    if (points.count() == 0)
        fail(ErrorKind::input, "an empty set of points has no local discrepancy to draw");
    require_unit_cube(points);
    run.need_memory(static_cast<double>(2 * discrepancy::axis_bytes(true) + 32) *
                        static_cast<double>(points.count()),
                    "the search for the worst boxes");
    const discrepancy::BoxGrid grid =
        discrepancy::box_grid(points, discrepancy::Family::anchored, run);
    const auto worst = discrepancy::star::worst_of_sides_2d(grid, run);
    return {.open = box_of(worst.open, -1), .closed = box_of(worst.closed, 1)};
}

Grid local_discrepancy(const PointSet& points, std::size_t columns, std::size_t rows,
                       const RunContext& run) {
    constexpr std::size_t patience = 65536;
    run.need_memory(16 * static_cast<double>(columns) * static_cast<double>(rows), "the image");
    std::vector<std::uint32_t> inside(columns * rows);
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (i % patience == 0) run.tick(i, points.count());
        const std::size_t column = first_cell_above(points[i][0], columns);
        const std::size_t row = first_cell_above(points[i][1], rows);
        if (column < columns && row < rows) ++inside[row * columns + column];
    }
    const auto n = static_cast<double>(points.count());
    Grid grid{.rows = rows, .columns = columns, .values = std::vector<double>(columns * rows)};
    for (std::size_t row = 0; row < rows; ++row) {
        std::uint32_t in_row = 0;
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t at = row * columns + column;
            in_row += inside[at];
            inside[at] = in_row + (row > 0 ? inside[at - columns] : 0);
            grid.values[at] = static_cast<double>(inside[at]) / n -
                              middle_of_cell(column, columns) * middle_of_cell(row, rows);
        }
    }
    return grid;
}

std::string text_of(const AnchoredBox& box, int digits) {
    const char end = box.value < 0 ? ')' : ']';
    return fmt::format("[0, {}{} × [0, {}{}: {}", rounded(box.corner.x, digits), end,
                       rounded(box.corner.y, digits), end, rounded(box.value, 4));
}

Drawing draw_local_discrepancy(const PointSet& points, const WorstBoxes& worst,
                               const LocalDiscrepancyFrame& around, const PictureStyle& style,
                               const RunContext& run) {
    const Theme& theme = *style.theme;
    const auto names = coordinate_names(2, points.provenance);
    const Axis x{.name = names[0]};
    const Axis y{.name = names[1]};
    const std::vector<LegendEntry> legend = {
        legend_entry("too few", worst.open, Dash::dashed, theme),
        legend_entry("too many", worst.closed, Dash::none, theme)};
    auto [drawing, frame] = square_drawing(
        titled_drawing(
            around.title,
            fmt::format("star discrepancy {} · {}", rounded(worst.star(), 6), around.subtitle),
            style, 640),
        legend, x, y, around.bar, style);
    const Grid values =
        local_discrepancy(points, pixels_between(frame.left, frame.right(), around.resolution),
                          pixels_between(frame.top, frame.bottom(), around.resolution), run);
    drawing.add(image_of_discrepancy(values, frame, around.largest, theme));
    const Panel panel(frame, x, y);
    draw_dots(drawing, points, panel, theme);
    panel.draw_axes(drawing, theme, true);
    draw_box(drawing, worst.closed, panel, Dash::none, theme);
    draw_box(drawing, worst.open, panel, Dash::dashed, theme);
    if (around.bar) draw_bar_of_discrepancy(drawing, frame, around.largest, theme);
    return std::move(drawing);
}

}  // namespace stipple::plot
