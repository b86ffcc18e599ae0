// SPDX-License-Identifier: MIT
//
// Several drawings on one, in rows.
#pragma once

#include <cstddef>
#include <vector>

#include "plot/drawing/drawing.hpp"

namespace stipple::plot {

/// Columns in which so many drawings stand that are about as wide as high: those that make them
/// largest on a sheet of that width over height. Without one (0): one row up to three, then two of
/// two, three, or four.
std::size_t sheet_columns(std::size_t parts, double ratio = 0);

/// Puts parts in rows below `top`, from the left, and makes the drawing as large as they need.
void add_rows(Drawing& drawing, std::vector<Drawing> parts, std::size_t columns, double top);

/// Makes a drawing as high as that, what it has in the middle; one that is as high stays.
void fill_height(Drawing& drawing, double height);

}  // namespace stipple::plot
