// SPDX-License-Identifier: MIT
//
// An order of points in which the first m are well spread, for every m.
//
//     R_j = R_0 2^(-j / 4),   j = 0, 1, ...,   R_0 the largest distance in the space
//
// For each radius in turn, the remaining points are visited in their order; a point at least R_j
// from all chosen points is chosen next. So the points chosen up to radius R_j keep that distance,
// and every point is within 2^(1/4) R_j of one of them.
//
// Cost    O(n log(R_0 / r)) time for n points of minimum distance r.
#pragma once

#include <span>

#include "generators/box_space.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Rows in the order in which points are chosen; points chosen at the same radius keep their
/// relative order.
/// @param radius lower bound of the distances between points
Rows spread_out(std::span<const double> rows, const BoxSpace& space, double radius,
                const RunContext& run);

}  // namespace stipple
