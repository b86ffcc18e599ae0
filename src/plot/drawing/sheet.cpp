// SPDX-License-Identifier: MIT
#include "plot/drawing/sheet.hpp"

#include <algorithm>
#include <iterator>

namespace stipple::plot {
namespace {

/// Moves shapes of every kind.
struct Mover {
    double right;
    double down;

    void move(Position& position) const {
        position.x += right;
        position.y += down;
    }
    void move(Area& area) const {
        area.left += right;
        area.top += down;
    }
    void operator()(Line& line) const {
        for (Position& vertex : line.vertices) move(vertex);
    }
    void operator()(Patch& patch) const {
        for (Position& vertex : patch.vertices) move(vertex);
    }
    void operator()(Disks& disks) const {
        for (Position& centre : disks.centres) move(centre);
    }
    void operator()(Label& label) const { move(label.at); }
    void operator()(PixelImage& image) const { move(image.area); }
    void operator()(ClipWindow& window) const { move(window.area); }
    void operator()(SvgGroup&) const {}
};

void add_moved(Drawing& drawing, Drawing part, double right, double down) {
    for (Shape& shape : part.shapes) std::visit(Mover{right, down}, shape);
    std::ranges::move(part.shapes, std::back_inserter(drawing.shapes));
}

}  // namespace

std::size_t sheet_columns(std::size_t parts) {
    if (parts <= 3) return parts;
    return parts == 4 ? 2 : parts <= 9 ? 3 : 4;
}

void add_rows(Drawing& drawing, std::vector<Drawing> parts, double top) {
    const std::size_t columns = sheet_columns(parts.size());
    double down = top;
    for (std::size_t first = 0; first < parts.size(); first += columns) {
        double right = 0;
        double highest = 0;
        for (std::size_t i = first; i < std::min(first + columns, parts.size()); ++i) {
            const double width = parts[i].width;
            highest = std::max(highest, parts[i].height);
            add_moved(drawing, std::move(parts[i]), right, down);
            right += width;
        }
        drawing.width = std::max(drawing.width, right);
        down += highest;
    }
    drawing.height = std::max(drawing.height, down);
}

}  // namespace stipple::plot
