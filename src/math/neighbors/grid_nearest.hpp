// SPDX-License-Identifier: MIT
//
// Nearest other point of every point, by a grid of their box: for sets that fill it about evenly.
//
// Shape    2 <= n < 2^32 points, d = 1, 2, 3; all in the box, its upper faces too.
// Cost     O(n): cells of two points on average are looked through. What is crowded into few cells
//          is left to a KdTree, after the time that the sorting takes.
// Promise  what KdTree::all_nearest finds, to the last bit: the nearest, and the one of lowest
//          index of those as near.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "math/neighbors/kd_tree.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Nothing where a grid does not fit: other dimensions, and points crowded into few cells.
/// @throws Error(cancelled)
std::optional<std::vector<Neighbor>> all_nearest_by_grid(std::span<const double> rows,
                                                         const Box& box, bool torus,
                                                         const RunContext& run);

}  // namespace stipple
