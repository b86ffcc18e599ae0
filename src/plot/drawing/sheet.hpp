// SPDX-License-Identifier: MIT
//
// Arrangement of several drawings in rows of one drawing.
#pragma once

#include <cstddef>
#include <vector>

#include "plot/drawing/drawing.hpp"

namespace stipple::plot {

/// Number of columns for `parts` drawings that are about square. If `ratio` is the sheet's width
/// over height, chooses the number that makes the drawings largest. If it is 0: one row for up to
/// three drawings, otherwise two, three or four columns.
std::size_t sheet_columns(std::size_t parts, double ratio = 0);

/// Adds parts in rows below `top`, from the left, and enlarges the drawing as needed.
void add_rows(Drawing& drawing, std::vector<Drawing> parts, std::size_t columns, double top);

/// Increases a drawing's height to `height`, centring its content; higher drawings are unchanged.
void fill_height(Drawing& drawing, double height);

}  // namespace stipple::plot
