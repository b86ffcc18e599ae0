// SPDX-License-Identifier: MIT
//
// A bar beside a picture that says what its colours mean.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plot/drawing/drawing.hpp"
#include "plot/drawing/theme.hpp"
#include "plot/drawing/ticks.hpp"

namespace stipple::plot {

inline constexpr double colour_bar_room = 62;  ///< to the right of the picture, with its numbers

/// Colours from the bottom (0) to the top (1); values of the ticks are such shares.
void draw_colour_bar(Drawing& drawing, const Area& area, const std::string& name,
                     const Theme& theme, const std::function<Colour(double)>& colour,
                     const std::vector<Tick>& ticks);

}  // namespace stipple::plot
