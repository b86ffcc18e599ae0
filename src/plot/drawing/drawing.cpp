// SPDX-License-Identifier: MIT
#include "plot/drawing/drawing.hpp"

#include <cmath>

namespace stipple::plot {

Colour mixed(Colour a, Colour b, double share) {
    const auto mix = [share](std::uint8_t from, std::uint8_t to) {
        return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
    };
    return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

void Drawing::line(Position from, Position to, Colour colour, double width_of_line) {
    add(Line{.vertices = {from, to}, .colour = colour, .width = width_of_line, .crisp = true});
}

void Drawing::rectangle(const Area& area, Colour colour) {
    add(Patch{.vertices = {{area.left, area.top},
                           {area.right(), area.top},
                           {area.right(), area.bottom()},
                           {area.left, area.bottom()}},
              .colour = colour});
}

}  // namespace stipple::plot
