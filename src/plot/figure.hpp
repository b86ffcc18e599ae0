// SPDX-License-Identifier: MIT
//
// A figure of one or more frames, such as pictures of points and charts, in rows and columns, with
// letters if requested.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "plot/chart.hpp"
#include "plot/text_picture.hpp"

namespace stipple::plot {

struct Frame {
    std::string title;  ///< title of the frame in text output
    std::function<Drawing(const PictureStyle&, bool last_in_row)> draw;
    std::function<std::string(const TextRoom&)> write;
    std::size_t panels = 1;  ///< number of panels that can have a letter
    bool bar = false;        ///< the last frame in a row is wider, for a colour bar
};

/// Draws with smaller and smaller scales, which leave more room, until the picture has the
/// requested size, its texts are within it and, if possible, no text covers another. A picture of
/// automatic size becomes larger instead. Sets the style's scale, width and height.
/// @throws Error(usage) if letters would be too small
Drawing fitted(PictureStyle& style, const std::function<Drawing(const PictureStyle&)>& draw);

/// Draws the frames, fitted to the style's size. A single panel is not labelled "(a)".
Drawing draw_figure(std::span<const Frame> frames, PictureStyle& style);
std::string figure_as_text(std::span<const Frame> frames, PictureStyle style, const TextRoom& room);

}  // namespace stipple::plot
