// SPDX-License-Identifier: MIT
//
// Several drawings on one, in rows.
#pragma once

#include <cstddef>
#include <vector>

#include "plot/drawing/drawing.hpp"

namespace stipple::plot {

/// Columns in which so many drawings stand: one row up to three, then two of two, three, or four.
std::size_t sheet_columns(std::size_t parts);

/// Puts parts in rows below `top`, from the left, and makes the drawing as large as they need.
void add_rows(Drawing& drawing, std::vector<Drawing> parts, double top);

}  // namespace stipple::plot
