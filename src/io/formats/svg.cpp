// SPDX-License-Identifier: MIT
//
// A picture: every point is a disk on a light ground, with y upward; the longer side has 1000
// units. The radius of the disks is 0.15 times the mean distance sqrt(area / n), between 0.5 and 10
// units.
//
// With more than two coordinates, each pair i < j has a panel: column i, row j - 1 shows x_i to the
// right and x_j upward, with the ranges below the panel. All panels have the same scale if the
// points have a single domain other than the unit cube. Otherwise each coordinate is scaled to the
// panel: coordinates such as pixel, time and lens have different units.
//
// Shape   one set of points with 2 to 8 coordinates; extras are omitted. Write only.
// Beware  positions are cut to a tenth of a unit: for viewing, not for reading back. Each point of
//         d coordinates gives d (d - 1) / 2 disks.
// Source  W3C, Scalable Vector Graphics 1.1.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/carried_meta.hpp"
#include "io/decimal.hpp"
#include "io/format.hpp"

namespace stipple::io::svg {
namespace {

constexpr double margin = 20;
constexpr double longer_side = 1000;

/// Panel of two coordinates: its position on the sheet, and the scaling of points into it.
struct Panel {
    std::size_t i;
    std::size_t j;
    double left;
    double top;
    double width;
    double height;
    double room;  ///< width available to the caption below
    double low_x;
    double high_y;
    double scale_x;
    double scale_y;
};

/// All panels, and the size of a disk.
struct Sheet {
    std::vector<Panel> panels;
    double width = 0;
    double height = 0;
    double radius = 0;
};

/// Checks the lengths of the box's sides. @throws Error(input) if one is too long for float64
const Box& finite(const Box& box) {
    for (std::size_t k = 0; k < box.dimension(); ++k)
        if (!std::isfinite(box.extent(k)))
            fail(ErrorKind::input,
                 "svg: the box around the points is too wide for float64: x{} goes from {} to {}",
                 k + 1, format_number(box.low[k]), format_number(box.high[k]));
    return box;
}

Box box_of(const Layout& layout) {
    if (layout.extent) return finite(*layout.extent);
    const std::size_t d = layout.dimension;
    if (!layout.provenance.bounds.empty()) return parse_box(layout.provenance.bounds, d);
    return {std::vector<double>(d, 0.0), std::vector<double>(d, 1.0)};
}

/// Panel of coordinates i and j. @param alike whether all coordinates have the same scale
Panel panel_of(const Box& box, std::size_t i, std::size_t j, bool alike) {
    const auto columns = static_cast<double>(box.dimension() - 1);
    const double side = (longer_side - (columns - 1) * margin) / columns;
    double longest = 0;
    for (std::size_t k = 0; k < box.dimension(); ++k) longest = std::max(longest, box.extent(k));
    const auto scale = [&](std::size_t k) {
        const double length = alike ? longest : box.extent(k);
        return length > 0 ? side / length : 0;
    };
    return {.i = i,
            .j = j,
            .left = margin + static_cast<double>(i) * (side + margin),
            .top = margin + static_cast<double>(j - 1) * (side + margin),
            .width = alike ? box.extent(i) * scale(i) : side,
            .height = alike ? box.extent(j) * scale(j) : side,
            .room = side,
            .low_x = box.low[i],
            .high_y = box.high[j],
            .scale_x = scale(i),
            .scale_y = scale(j)};
}

Sheet sheet_of(const Layout& layout) {
    const Box box = box_of(layout);
    Sheet sheet;
    const std::string& domain = layout.provenance.domain;
    const bool one = !domain.empty() && domain.find(" x ") == std::string::npos;
    const bool alike = box.dimension() == 2 || (one && domain != "unit-cube");
    for (std::size_t j = 1; j < box.dimension(); ++j)
        for (std::size_t i = 0; i < j; ++i) sheet.panels.push_back(panel_of(box, i, j, alike));
    for (const Panel& panel : sheet.panels) {
        sheet.width = std::max(sheet.width, panel.left + panel.width + margin);
        sheet.height = std::max(sheet.height, panel.top + panel.height + margin);
    }
    const Panel& first = sheet.panels[0];
    sheet.radius = disk_radius(first.width * first.height, static_cast<double>(layout.counts[0]));
    return sheet;
}

/// Removes < and &, which are special in the text of XML, and control characters.
std::string without_markup(std::string text) {
    std::erase_if(
        text, [](char c) { return c == '<' || c == '&' || static_cast<unsigned char>(c) < 0x20; });
    return text;
}

std::string title_of(const Layout& layout) {
    std::string title = fmt::format("{} points", layout.counts[0]);
    if (!layout.provenance.generator.empty()) title = layout.provenance.generator + ", " + title;
    for (const std::string& warp : layout.provenance.warps) title += ", " + warp;
    return without_markup(title);
}

/// Caption below a panel: the names and ranges of its axes, in a font size that fits.
std::string caption_of(const Layout& layout, const Panel& panel) {
    const auto names = coordinate_names(layout.dimension, layout.provenance);
    const Box box = box_of(layout);
    const std::string words = without_markup(fmt::format(
        "{} right {:.4g} to {:.4g}, {} up {:.4g} to {:.4g}", names[panel.i], box.low[panel.i],
        box.high[panel.i], names[panel.j], box.low[panel.j], box.high[panel.j]));
    const double letters = 0.55 * static_cast<double>(words.size());
    const double size = std::clamp(panel.room / letters, 4.0, 14.0);
    return fmt::format(
        "<text x=\"{:.6g}\" y=\"{:.6g}\" font-size=\"{:.3g}\" fill=\"#555\">{}</text>\n",
        panel.left, panel.top + panel.height + 15, size, words);
}

void head(const Layout& layout, std::string& out) {
    const Sheet sheet = sheet_of(layout);
    out += fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.6g}\" height=\"{1:.6g}\" "
        "viewBox=\"0 0 {0:.6g} {1:.6g}\">\n"
        "<title>{2}</title>\n"
        "<rect width=\"{0:.6g}\" height=\"{1:.6g}\" fill=\"#fcfcfa\"/>\n",
        sheet.width, sheet.height, title_of(layout));
    if (layout.meta) out += svg_metadata(layout.provenance);
    for (const Panel& panel : sheet.panels) {
        out += fmt::format(
            "<rect x=\"{:.6g}\" y=\"{:.6g}\" width=\"{:.6g}\" height=\"{:.6g}\" fill=\"#fff\" "
            "stroke=\"#c8c8c4\"/>\n",
            panel.left, panel.top, panel.width, panel.height);
        if (sheet.panels.size() > 1) out += caption_of(layout, panel);
    }
    out += "<g fill=\"#1d4f91\">\n";
}

void rows(const Layout& layout, std::size_t, std::uint64_t, std::span<const double> numbers,
          std::string& out) {
    const Sheet sheet = sheet_of(layout);
    std::string close = "\" r=\"";
    append_number(close, sheet.radius, 2);
    close += "\"/>\n";
    for (std::size_t at = 0; at < numbers.size(); at += layout.width())
        for (const Panel& panel : sheet.panels) {
            const double x = numbers[at + panel.i] - panel.low_x;
            const double y = panel.high_y - numbers[at + panel.j];
            out += "<circle cx=\"";
            append_number(out, panel.left + x * panel.scale_x, 1);
            out += "\" cy=\"";
            append_number(out, panel.top + y * panel.scale_y, 1);
            out += close;
        }
}

void tail(const Layout&, std::string& out) { out += "</g>\n</svg>\n"; }

}  // namespace

Format unit() {
    return {.name = "svg",
            .summary = "A picture of the points, for every pair of coordinates",
            .source = "W3C, Scalable Vector Graphics 1.1",
            .extensions = {".svg"},
            .traits = {.many_sets = false,
                       .counts_first = true,
                       .max_dimension = 8,
                       .min_dimension = 2},
            .head = head,
            .rows = rows,
            .tail = tail};
}

}  // namespace stipple::io::svg
