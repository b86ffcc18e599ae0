// SPDX-License-Identifier: MIT
#include "plot/drawing/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace stipple::plot {
namespace {

/// Translates shapes of every kind.
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

std::size_t sheet_columns(std::size_t parts, double ratio) {
    if (ratio > 0) {
        const auto rows_of = [parts](std::size_t columns) {
            return (parts + columns - 1) / columns;
        };
        std::size_t best = 1;
        double largest = 0;
        for (std::size_t columns = 1; columns <= parts; ++columns) {
            const std::size_t rows = rows_of(columns);
            const double side =
                std::min(ratio / static_cast<double>(columns), 1 / static_cast<double>(rows));
            if (side > largest || (side == largest && rows < rows_of(best))) best = columns;
            largest = std::max(largest, side);
        }
        return best;
    }
    if (parts <= 3) return parts;
    return parts == 4 ? 2 : parts <= 9 ? 3 : 4;
}

void add_rows(Drawing& drawing, std::vector<Drawing> parts, std::size_t columns, double top) {
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
    drawing.height = down;
}

void fill_height(Drawing& drawing, double height) {
    const double more = height - drawing.height;
    if (!(more > 0)) return;
    for (Shape& shape : drawing.shapes) std::visit(Mover{0, std::floor(more / 2)}, shape);
    drawing.height = height;
}

}  // namespace stipple::plot
