// SPDX-License-Identifier: MIT
//
// Nearest other point of every point, by a grid: for sets that fill their box about evenly.
//
// Shape    2 <= n < 2^32 points, d = 1, 2, 3; all in the box, including its upper faces.
// Cost     O(n), searching cells with two points on average. If points are crowded into few cells,
//          returns nullopt after sorting them; a KdTree is faster then.
// Promise  the result of KdTree::all_nearest, to the last bit: of equally near points, the one with
//          the lowest index.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "math/neighbors/kd_tree.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Returns nullopt for d > 3, too many points, extreme sides, or points crowded into few cells.
/// @throws Error(cancelled)
std::optional<std::vector<Neighbor>> all_nearest_by_grid(std::span<const double> rows,
                                                         const Box& box, bool torus,
                                                         const RunContext& run);

}  // namespace stipple
