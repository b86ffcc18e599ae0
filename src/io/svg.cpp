// SPDX-License-Identifier: MIT
//
// A picture: every point a disk on a light ground, y upward, the longer side 1000 units. A disk's
// radius is 0.15 of the mean distance sqrt(area / n), between 0.5 and 10 units.
//
// Shape   one set of 2-D points; extras are left out. Write only.
// Beware  a tenth of a unit is what a point's place is cut to: for eyes, not for numbers.
// Source  W3C, Scalable Vector Graphics 1.1.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/decimal.hpp"
#include "io/format.hpp"

namespace stipple::io {
namespace {

constexpr double margin = 20;
constexpr double longer_side = 1000;

/// Where the points stand, and how they are scaled.
struct Frame {
    Box box;
    double scale;
    double width;
    double height;
    double radius;
};

Frame frame_of(const Layout& layout) {
    Box box{{0, 0}, {1, 1}};
    if (!layout.provenance.bounds.empty()) box = parse_box(layout.provenance.bounds, 2);
    if (layout.extent) box = *layout.extent;
    const double side = std::max(box.extent(0), box.extent(1));
    const double scale = longer_side / (side > 0 ? side : 1);
    const double width = box.extent(0) * scale;
    const double height = box.extent(1) * scale;
    const auto n = static_cast<double>(std::max<std::uint64_t>(layout.counts.at(0), 1));
    return {box, scale, width, height, std::clamp(0.15 * std::sqrt(width * height / n), 0.5, 10.0)};
}

/// What a picture is called: letters that mean something to XML are left out.
std::string title_of(const Layout& layout) {
    std::string title = fmt::format("{} points", layout.counts.at(0));
    if (!layout.provenance.generator.empty()) title = layout.provenance.generator + ", " + title;
    for (const std::string& warp : layout.provenance.warps) title += ", " + warp;
    std::erase_if(title, [](char c) { return c == '<' || c == '&' || (c >= 0 && c < 0x20); });
    return title;
}

void head(const Layout& layout, std::string& out) {
    const Frame frame = frame_of(layout);
    const double width = frame.width + 2 * margin;
    const double height = frame.height + 2 * margin;
    out += fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.6g}\" height=\"{1:.6g}\" "
        "viewBox=\"0 0 {0:.6g} {1:.6g}\">\n"
        "<title>{2}</title>\n"
        "<rect width=\"{0:.6g}\" height=\"{1:.6g}\" fill=\"#fcfcfa\"/>\n"
        "<rect x=\"{3}\" y=\"{3}\" width=\"{4:.6g}\" height=\"{5:.6g}\" fill=\"#fff\" "
        "stroke=\"#c8c8c4\"/>\n"
        "<g fill=\"#1d4f91\">\n",
        width, height, title_of(layout), margin, frame.width, frame.height);
}

void rows(const Layout& layout, std::size_t, std::uint64_t, std::span<const double> numbers,
          std::string& out) {
    const Frame frame = frame_of(layout);
    std::string close = "\" r=\"";
    append_number(close, frame.radius, 2);
    close += "\"/>\n";
    for (std::size_t i = 0; i < numbers.size(); i += layout.width()) {
        out += "<circle cx=\"";
        append_number(out, margin + (numbers[i] - frame.box.low[0]) * frame.scale, 1);
        out += "\" cy=\"";
        append_number(out, margin + (frame.box.high[1] - numbers[i + 1]) * frame.scale, 1);
        out += close;
    }
}

void tail(const Layout&, std::string& out) { out += "</g>\n</svg>\n"; }

}  // namespace

Format svg() {
    return {.name = "svg",
            .summary = "A picture of 2-D points; write only",
            .source = "W3C, Scalable Vector Graphics 1.1",
            .extensions = {".svg"},
            .traits = {.many_sets = false,
                       .counts_first = true,
                       .max_dimension = 2,
                       .min_dimension = 2},
            .head = head,
            .rows = rows,
            .tail = tail};
}

}  // namespace stipple::io
