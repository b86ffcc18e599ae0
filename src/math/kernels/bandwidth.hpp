// SPDX-License-Identifier: MIT
//
// Length scales for points of which nobody said one.
//
// Source  the median heuristic: A. Gretton, K. M. Borgwardt, M. J. Rasch, B. Schoelkopf, A. Smola,
//         J. Mach. Learn. Res. 13 (2012) 723-773.
#pragma once

#include "math/kernels/kernel.hpp"

namespace stipple::kernels {

/// The median distance of two of the points and the others, put together, by their first
/// coordinates; of more than 1000 those at even steps stand for all.
double median_distance(const Columns& points, const Columns& others, std::size_t dimension);

/// The root mean square distance of two uniform points of the unit cube, sqrt(d / 6).
double uniform_distance(std::size_t dimension);

}  // namespace stipple::kernels
