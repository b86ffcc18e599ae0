// SPDX-License-Identifier: MIT
//
// The outline of a planar domain, traced with its membership test.
//
// Shape   any domain of two coordinates.
// Cost    about 60 000 membership tests.
// Beware  parts and holes narrower than 1/200 of the box may be missed.
// Source  marching squares: W. E. Lorensen, H. E. Cline, SIGGRAPH Comput. Graph. 21 (1987) 163-169,
//         doi:10.1145/37402.37422, in two dimensions.
#pragma once

#include <vector>

#include "core/domain.hpp"
#include "plot/drawing/drawing.hpp"

namespace stipple::plot {

/// Lines along the boundary, in the domain's coordinates; none where the domain has no inside (a circle)
/// or no end.
std::vector<std::vector<Position>> outline_of(const Domain& domain);

}  // namespace stipple::plot
