// SPDX-License-Identifier: MIT
//
// An order of points in which the first m are well spread, for every m.
//
//     R_j = R_0 2^(-j / 4),   j = 0, 1, ...
//
// With each radius the points that are left are gone through; one that is at least R_j from all
// that came before comes next. So the first m points keep a distance of R_j, and nothing of the
// box that holds a point is farther than 2^(1/4) R_j from them.
//
// Cost    O(n log(R_0 / r)) time for n points of least distance r.
#pragma once

#include <span>

#include "generators/box_space.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Rows in that order; those of one radius stay in the order that they have.
/// @param radius that no two points are nearer than
Rows spread_out(std::span<const double> rows, const BoxSpace& space, double radius,
                const RunContext& run);

}  // namespace stipple
