// SPDX-License-Identifier: MIT
#include "page/page_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "io/decimal.hpp"
#include "media/png_picture.hpp"
#include "plot/domain_outline.hpp"
#include "plot/html_text.hpp"
#include "plot/points_picture.hpp"
#include "plot/ticks.hpp"

namespace stipple {
namespace {

constexpr double rim = 16;  ///< around a picture, for its numbers

/// Two of a set's axes, or the plane in which three are seen.
struct Plane {
    std::vector<Spot> spots = {};  ///< of all points
    std::string pixels = {};       ///< a PNG picture in place of points
    Box box;                       ///< that is shown
    std::string x_name;
    std::string y_name;
    std::vector<std::vector<Spot>> lines = {};     ///< the domain's rim, or a box's edges
    std::vector<MarkedBox> boxes = {};             ///< of these two axes, in the unit square
    Box square = {.low = {0, 0}, .high = {1, 1}};  ///< where that is
    std::string alt;
    double size = 420;  ///< of the longer side
    bool framed = true;
};

std::string png_uri(const PngShape& shape, std::string_view bytes) {
    return "data:image/png;base64," + base64(encode_png(shape, bytes, {}));
}

/// From data to the picture.
class Place {
  public:
    explicit Place(const Plane& plane)
        : box_(plane.box),
          scale_(plane.size / std::max(plane.box.extent(0), plane.box.extent(1))) {}

    [[nodiscard]] double width() const { return scale_ * box_.extent(0); }
    [[nodiscard]] double height() const { return scale_ * box_.extent(1); }
    [[nodiscard]] double x(double value) const { return rim + scale_ * (value - box_.low[0]); }
    [[nodiscard]] double y(double value) const { return rim + scale_ * (box_.high[1] - value); }

  private:
    const Box& box_;
    double scale_;
};

/// Every point as a mark: a stroke without length has round ends.
std::string dots(const Plane& plane, const Place& place) {
    const auto n = static_cast<double>(plane.spots.size());
    const double mean = std::sqrt(place.width() * place.height() / n);
    std::string out = fmt::format("<path class=\"dots\" stroke-width=\"{:.1f}\" d=\"",
                                  std::clamp(0.36 * mean, 1.2, 7.0));
    for (const Spot& spot : plane.spots) {
        out += 'M';
        io::append_number(out, place.x(spot.x), 1);
        out += ' ';
        io::append_number(out, place.y(spot.y), 1);
        out += "h0";
    }
    return out + "\"/>\n";
}

/// Grey of a pixel with so many points, of which the mean one has `mean`: 16 shades, which pack
/// well.
std::uint8_t shade(std::uint32_t points, double mean) {
    const double c = points;
    const double ink = mean < 1 ? 1 - std::exp(-1.2 * c) : std::min(1.0, 0.5 * c / mean);
    return static_cast<std::uint8_t>(255 - 17 * std::lround(15 * ink));
}

std::string image(const char* kind, const Place& place, const std::string& uri) {
    return fmt::format(
        "<image class=\"{0}\" x=\"{1}\" y=\"{1}\" width=\"{2:.1f}\" height=\"{3:.1f}\" "
        "preserveAspectRatio=\"none\" href=\"{4}\"/>\n",
        kind, rim, place.width(), place.height(), uri);
}

/// Points as pixels.
std::string density(const Plane& plane, const Place& place) {
    const auto columns = static_cast<std::size_t>(std::max(1.0, std::round(place.width())));
    const auto rows = static_cast<std::size_t>(std::max(1.0, std::round(place.height())));
    std::vector<std::uint32_t> counts(columns * rows, 0);
    const auto index = [](double at, double length, std::size_t cells) {
        const double cell = (at - rim) / length * static_cast<double>(cells);
        return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(cells - 1)));
    };
    for (const Spot& spot : plane.spots)
        ++counts[index(place.y(spot.y), place.height(), rows) * columns +
                 index(place.x(spot.x), place.width(), columns)];
    const double mean =
        static_cast<double>(plane.spots.size()) / static_cast<double>(counts.size());
    std::string bytes;
    bytes.reserve(counts.size());
    for (const std::uint32_t count : counts) bytes += static_cast<char>(shade(count, mean));
    return image("density", place, png_uri({columns, rows, 8, false}, bytes));
}

std::string marked(const MarkedBox& box, const Box& square, const Place& place) {
    const auto x = [&](double share) { return place.x(square.low[0] + share * square.extent(0)); };
    const auto y = [&](double share) { return place.y(square.low[1] + share * square.extent(1)); };
    std::string out;
    for (const auto& [x0, x1] : parts_of_range(box.low[0], box.high[0]))
        for (const auto& [y0, y1] : parts_of_range(box.low[1], box.high[1]))
            out += fmt::format(
                "<rect class=\"box {}{}\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" "
                "height=\"{:.2f}\"/>\n",
                box.kind, box.closed ? "" : " open", x(x0), y(y1), x(x1) - x(x0), y(y0) - y(y1));
    return out;
}

std::string line_of(const std::vector<Spot>& line, const Place& place) {
    std::string out = "<path class=\"frame\" d=\"";
    for (std::size_t i = 0; i < line.size(); ++i)
        out += fmt::format("{}{:.1f} {:.1f}", i == 0 ? 'M' : 'L', place.x(line[i].x),
                           place.y(line[i].y));
    return out + "\"/>\n";
}

/// The ends of both axes, and their names between.
std::string axes(const Plane& plane, const Place& place) {
    const double bottom = rim + place.height();
    const double right = rim + place.width();
    const auto text = [](double x, double y, const char* anchor, const std::string& words) {
        return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y,
                           anchor, html_text(words));
    };
    std::string out = text(rim, bottom + 13, "start", rounded(plane.box.low[0], 3)) +
                      text(right, bottom + 13, "end", rounded(plane.box.high[0], 3)) +
                      text((rim + right) / 2, bottom + 13, "middle", plane.x_name);
    const auto upward = [&](double y, const char* anchor, const std::string& words) {
        return fmt::format(
            "<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" "
            "text-anchor=\"{}\">{}</text>\n",
            rim - 5, y, anchor, html_text(words));
    };
    out += upward(bottom, "start", rounded(plane.box.low[1], 3)) +
           upward(rim, "end", rounded(plane.box.high[1], 3)) +
           upward((rim + bottom) / 2, "middle", plane.y_name);
    return out;
}

std::string svg_of(const Plane& plane) {
    const Place place(plane);
    std::string out = fmt::format(
        "<svg class=\"points\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n",
        place.width() + 2 * rim, place.height() + 2 * rim, html_text(plane.alt));
    if (!plane.pixels.empty())
        out += image("spectrum", place, plane.pixels);
    else
        out += plane.spots.size() <= most_page_dots ? dots(plane, place) : density(plane, place);
    for (const auto& line : plane.lines) out += line_of(line, place);
    if (plane.framed)
        out += fmt::format(
                   "<rect class=\"frame\" x=\"{0}\" y=\"{0}\" width=\"{1:.1f}\" "
                   "height=\"{2:.1f}\"/>\n",
                   rim, place.width(), place.height()) +
               axes(plane, place);
    for (const MarkedBox& box : plane.boxes) out += marked(box, plane.square, place);
    return out + "</svg>\n";
}

std::vector<Spot> spots_of(const PointSet& points, std::size_t i, std::size_t j) {
    std::vector<Spot> spots;
    spots.reserve(points.count());
    for (std::size_t p = 0; p < points.count(); ++p) spots.push_back({points[p][i], points[p][j]});
    return spots;
}

/// A box's part in two of its axes.
MarkedBox projected(const MarkedBox& box, std::size_t i, std::size_t j) {
    MarkedBox flat = box;
    flat.low = {box.low[i], box.low[j]};
    flat.high = {box.high[i], box.high[j]};
    return flat;
}

std::string axis_name(std::size_t dimension, std::size_t k) {
    constexpr const char* letters[] = {"x", "y", "z"};
    return dimension <= 3 ? letters[k] : fmt::format("x{}", k + 1);
}

/// Labels that explain the boxes, each with a switch; shadows of them are not shown at first.
std::string box_legend(const std::vector<MarkedBox>& boxes, bool shadows) {
    if (boxes.empty()) return {};
    std::string out = "<ul class=\"boxes\">\n";
    for (const MarkedBox& box : boxes)
        out += fmt::format(
            "<li><label><input type=\"checkbox\" data-box=\"{0}\"{3}> <span class=\"key {0}{1}\">"
            "</span> {2}</label></li>\n",
            box.kind, box.closed ? "" : " open", html_text(box.label),
            !shadows && (box.kind == "star" || box.kind == "empty") ? " checked" : "");
    return out + "</ul>\n";
}

std::string figure(const std::string& kind, const std::string& body, const std::string& caption) {
    return fmt::format("<figure class=\"{}\">\n{}<figcaption>{}</figcaption>\n</figure>\n", kind,
                       body, caption);
}

std::string many(const PointSet& points) {
    return points.count() == 1 ? "1 point" : fmt::format("{} points", points.count());
}

std::string plane_figure(const PointSet& points, const PageSet& set) {
    const auto boxes = worst_boxes(set);
    Plane plane{.spots = spots_of(points, 0, 1),
                .box = shown_box(std::vector<const PointSet*>{&points}),
                .x_name = "x",
                .y_name = "y",
                .boxes = boxes,
                .alt = fmt::format("{} of {} in the plane", many(points), set.name)};
    if (set.domain != "unit-cube" && !set.domain.starts_with("box"))
        plane.lines = outline_of(*points.domain);
    if (!boxes.empty()) plane.square = points.domain->bounding_box();
    std::string caption = "Points";
    if (points.count() > most_page_dots) caption += ", darker where there are more";
    if (!boxes.empty()) caption += ", with the worst boxes";
    return figure("picture", svg_of(plane) + box_legend(boxes, false), caption + ".");
}

std::vector<std::vector<Spot>> edges_of(const Box& box) {
    const auto at = [&](unsigned corner) {
        std::vector<double> p(3);
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = (corner >> k & 1U) != 0 ? box.high[k] : box.low[k];
        const Seen seen = seen_at(box, p);
        return Spot{seen.right, seen.up};
    };
    std::vector<std::vector<Spot>> edges;
    for (unsigned corner = 0; corner < 8; ++corner)
        for (unsigned k = 0; k < 3; ++k)
            if ((corner >> k & 1U) == 0) edges.push_back({at(corner), at(corner | 1U << k)});
    return edges;
}

std::string space_figure(const PointSet& points, const PageSet& set) {
    const Box box = shown_box(std::vector<const PointSet*>{&points});
    Plane plane{.spots = {},
                .box = {.low = {1e300, 1e300}, .high = {-1e300, -1e300}},
                .x_name = {},
                .y_name = {},
                .lines = edges_of(box),
                .alt = fmt::format("{} of {} in space", many(points), set.name),
                .framed = false};
    for (const auto& edge : plane.lines)
        for (const Spot& end : edge) {
            plane.box.low = {std::min(plane.box.low[0], end.x), std::min(plane.box.low[1], end.y)};
            plane.box.high = {std::max(plane.box.high[0], end.x),
                              std::max(plane.box.high[1], end.y)};
        }
    for (std::size_t p = 0; p < points.count(); ++p) {
        const Seen seen = seen_at(box, points[p]);
        plane.spots.push_back({seen.right, seen.up});
    }
    return figure("picture", svg_of(plane), "Points in space, seen from a fixed place.");
}

/// Every pair of the first axes.
std::string pairs_figure(const PointSet& points, const PageSet& set) {
    const auto boxes = worst_boxes(set);
    const std::size_t d = points.dimension();
    const std::size_t shown = std::min(d, most_page_axes);
    const Box whole = shown_box(std::vector<const PointSet*>{&points});
    std::string body = fmt::format("<div class=\"pairs\" style=\"--columns:{}\">\n",
                                   std::min<std::size_t>(shown * (shown - 1) / 2, 5));
    for (std::size_t j = 1; j < shown; ++j)
        for (std::size_t i = 0; i < j; ++i) {
            Plane plane{.spots = spots_of(points, i, j),
                        .box = {.low = {whole.low[i], whole.low[j]},
                                .high = {whole.high[i], whole.high[j]}},
                        .x_name = axis_name(d, i),
                        .y_name = axis_name(d, j),
                        .boxes = {},
                        .alt = fmt::format("{} of {}: axes {} and {}", many(points), set.name,
                                           i + 1, j + 1),
                        .size = 150};
            if (!boxes.empty()) {
                const Box cube = points.domain->bounding_box();
                plane.square = {{cube.low[i], cube.low[j]}, {cube.high[i], cube.high[j]}};
            }
            for (const MarkedBox& box : boxes) plane.boxes.push_back(projected(box, i, j));
            body += svg_of(plane);
        }
    std::string caption = shown < d ? fmt::format("Pairs of the first {} of {} axes", shown, d)
                                    : std::string("Projections on every pair of axes");
    if (!boxes.empty())
        caption +=
            ". A worst box is drawn as its shadow: points in the shadow are in the box only if "
            "they are in all of its shadows";
    return figure("wide", body + "</div>\n" + box_legend(boxes, true), caption + ".");
}

/// Points of one coordinate: a histogram as a curve, and marks.
std::string line_figure(const PointSet& points, const PageSet& set) {
    const Box box = shown_box(std::vector<const PointSet*>{&points});
    std::string out = fmt::format(
        "<svg class=\"points\" viewBox=\"0 0 640 70\" role=\"img\" aria-label=\"{} of {} on a "
        "line\">\n<path class=\"ticks\" d=\"",
        many(points), html_text(set.name));
    constexpr std::size_t columns = 2400;  // marks nearer to each other are one
    std::vector<bool> seen(columns + 1, false);
    for (const double value : points.flat()) {
        const double share = (value - box.low[0]) / box.extent(0);
        const auto column = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * columns);
        if (!seen[column])
            out += fmt::format("M{:.2f} 10v40",
                               rim + (640 - 2 * rim) * static_cast<double>(column) / columns);
        seen[column] = true;
    }
    out += fmt::format(
        "\"/>\n<text x=\"{}\" y=\"64\">{}</text>\n<text x=\"{}\" y=\"64\" "
        "text-anchor=\"end\">{}</text>\n</svg>\n",
        rim, rounded(box.low[0], 3), 640 - rim, rounded(box.high[0], 3));
    return figure("wide", out, "Points on the line.");
}

/// Side of the blocks, odd, of which no more than `most` stand side by side.
std::size_t block_side(std::size_t rows, std::size_t most) {
    std::size_t block = 1;
    while ((rows + block - 1) / block > most) block += 2;
    return block;
}

/// Grey of a power, as P / (1 + P); 64 shades, which pack well.
std::uint8_t grey_of(double power) {
    const double share = power < 1e300 ? std::max(power, 0.0) / (1 + std::max(power, 0.0)) : 1;
    return static_cast<std::uint8_t>(4 * std::lround(63 * share));
}

}  // namespace

std::vector<MarkedBox> worst_boxes(const PageSet& set) {
    std::vector<MarkedBox> boxes;
    const auto add = [&](const char* measure, const char* kind, const char* title) {
        const Report* found = set.results(measure);
        if (found == nullptr || found->find("worst_box.corner") == nullptr) return;
        MarkedBox box{
            .kind = kind, .label = {}, .low = {}, .high = found->curve("worst_box.corner")};
        box.low.assign(box.high.size(), 0);
        if (found->find("worst_box.lower_corner") != nullptr)
            box.low = found->curve("worst_box.lower_corner");
        if (const auto* closed = std::get_if<bool>(found->find("worst_box.closed")))
            box.closed = *closed;
        const double share = found->number("worst_box.points") / static_cast<double>(set.count);
        box.label = fmt::format("{}: {} of the points in {} of the volume", title,
                                rounded(share, 4), rounded(found->number("worst_box.volume"), 4));
        boxes.push_back(std::move(box));
    };
    add("star-discrepancy", "star", "worst box from the origin");
    add("extreme-discrepancy", "extreme", "worst box of all");
    add("periodic-discrepancy", "periodic", "worst box on the torus");
    const Report* found = set.results("dispersion");
    if (found != nullptr && found->find("box.lower_corner") != nullptr)
        boxes.push_back({.kind = "empty",
                         .label = fmt::format("largest empty box: volume {}",
                                              rounded(found->number("lower"), 4)),
                         .low = found->curve("box.lower_corner"),
                         .high = found->curve("box.upper_corner")});
    return boxes;
}

std::vector<std::pair<double, double>> parts_of_range(double low, double high) {
    if (low <= high) return {{low, high}};
    return {{0, high}, {low, 1}};
}

std::vector<std::string> point_figures(const PointSet& points, const PageSet& set) {
    switch (points.dimension()) {
        case 1:
            return {line_figure(points, set)};
        case 2:
            return {plane_figure(points, set)};
        case 3:
            return {space_figure(points, set), pairs_figure(points, set)};
        default:
            return {pairs_figure(points, set)};
    }
}

Grid in_blocks(const Grid& grid, std::size_t most) {
    const std::size_t block = block_side(grid.rows, most);
    if (block == 1) return grid;
    // The centre stays the centre of its block; what does not fill a block at the rim is left out.
    const std::size_t half = (grid.rows / 2 - block / 2) / block;
    const std::size_t first = grid.rows / 2 - block / 2 - half * block;
    const std::size_t side = 2 * half + 1;
    Grid small{.rows = side, .columns = side, .values = std::vector<double>(side * side)};
    for (std::size_t row = 0; row < side * block; ++row)
        for (std::size_t column = 0; column < side * block; ++column)
            small.values[row / block * side + column / block] +=
                grid.values[(first + row) * grid.columns + first + column] /
                static_cast<double>(block * block);
    return small;
}

std::string spectrum_figure(const PageSet& set) {
    constexpr std::size_t most_pixels = 255;
    const Report* found = set.results("periodogram");
    if (found == nullptr || set.dimension != 2) return {};
    const auto* grid = std::get_if<Grid>(found->find("grid"));
    if (grid == nullptr || grid->rows != grid->columns || grid->rows % 2 == 0) return {};
    Grid centred = *grid;
    centred.values[centred.values.size() / 2] = 0;  // frequency zero, n, would outshine its block
    const Grid small = in_blocks(centred, most_pixels);
    std::string bytes;
    for (std::size_t row = small.rows; row-- > 0;)
        for (std::size_t column = 0; column < small.columns; ++column)
            bytes += static_cast<char>(grey_of(small.values[row * small.columns + column]));
    const std::size_t block = block_side(grid->rows, most_pixels);
    const auto last = static_cast<double>(small.rows * block / 2);
    const Plane plane{
        .pixels = png_uri({small.columns, small.rows, 8, false}, bytes),
        .box = {.low = {-last, -last}, .high = {last, last}},
        .x_name = "frequency along x",
        .y_name = "frequency along y",
        .alt = fmt::format("power spectrum of {}, frequency zero in the middle", set.name)};
    std::string caption = fmt::format(
        "Power at frequencies −{0} to {0}: black 0, grey 1 (white "
        "noise), white ∞",
        last);
    if (block > 1) caption += fmt::format("; a pixel is the mean of {0} × {0}", block);
    return figure("picture", svg_of(plane), caption + ".");
}

}  // namespace stipple
