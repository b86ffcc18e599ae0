// SPDX-License-Identifier: MIT
//
// Colours of pictures. Series take M. Okabe and K. Ito's colours, which colour-blind readers can
// tell apart, in an order that differs in lightness as well, for print in grey.
#pragma once

#include <span>

#include "plot/drawing/drawing.hpp"

namespace stipple::plot {

struct Theme {
    Colour background;
    Colour ink;    ///< titles
    Colour text;   ///< numbers and names on axes
    Colour frame;  ///< axes
    Colour grid;   ///< lines behind the data
    Colour band;   ///< what chance allows
    Colour guide;  ///< lines to compare with
    std::span<const Colour> series;

    [[nodiscard]] Colour series_colour(std::size_t i) const { return series[i % series.size()]; }
};

inline constexpr Colour light_series[] = {{0, 114, 178},   {213, 94, 0},  {0, 158, 115},
                                          {204, 121, 167}, {230, 159, 0}, {86, 180, 233},
                                          {0, 0, 0}};
inline constexpr Colour dark_series[] = {{86, 180, 233},  {240, 128, 48}, {26, 188, 144},
                                         {222, 150, 190}, {240, 190, 60}, {110, 140, 255},
                                         {245, 245, 245}};

inline constexpr Theme light_theme{.background = {255, 255, 255},
                                   .ink = {26, 26, 26},
                                   .text = {64, 64, 64},
                                   .frame = {112, 112, 112},
                                   .grid = {230, 230, 230},
                                   .band = {222, 222, 222},
                                   .guide = {107, 107, 107},
                                   .series = light_series};

inline constexpr Theme dark_theme{.background = {22, 24, 28},
                                  .ink = {236, 236, 236},
                                  .text = {190, 193, 198},
                                  .frame = {128, 132, 140},
                                  .grid = {48, 51, 57},
                                  .band = {58, 62, 69},
                                  .guide = {150, 154, 162},
                                  .series = dark_series};

}  // namespace stipple::plot
