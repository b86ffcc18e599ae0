// SPDX-License-Identifier: MIT
//
// What points fill, told by themselves: the dimension of the curve, surface or body that they are
// on, and its measure.
//
// The balls about some of the points that hold k of n points have, on d dimensions of measure A,
// the volume V_d r_k^d = A k / n, nearly, however evenly the points lie; and r_4k / r_k = 4^(1/d).
// The median growth says d. Balls that reach beyond a rim are too large; the smaller ones say A,
// within some 6 % in the plane, and in space within 25 % (of 200 points) or 5 % (of 5000).
//
// Cost    O(65536) distances for each of 256 points.
// Promise the same on every machine: no more than roots and products.
#pragma once

#include <cstddef>
#include <span>

#include "stipple/run.hpp"

namespace stipple {

struct CrowdExtent {
    std::size_t dimension = 0;  ///< 0: the points are too few, or too many in one place
    double measure = 0;
};

/// @param rows points in so many directions, up to 6
/// @param dimension that they have, or 0 to look for it
CrowdExtent crowd_extent(std::span<const double> rows, std::size_t directions,
                         std::size_t dimension, const RunContext& run);

}  // namespace stipple
