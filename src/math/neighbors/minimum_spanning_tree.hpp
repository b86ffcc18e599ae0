// SPDX-License-Identifier: MIT
//
// Minimum spanning tree of n points: of all ways to join them by n - 1 edges, the one of the least
// total length. Which edges it has may hang on ties; how long they are does not.
//
//     near_spanning_tree     every part grown so far takes the shortest edge to another, by a k-d
//                            tree that passes over what is of the own part (Boruvka).
//     plain_spanning_tree    one part takes the nearest point outside, n times (Prim).
//
// Shape   1 <= n < 2^32 points. `sides` as for KdTree: of the torus, whose points are in one box of
//         these sides; none for straight distances. Duplicates are joined by edges of length 0.
// Cost    near O(n log^2 n) in few dimensions, 4.2 s for 10^6 points of the plane on one core, 72
//         bytes a point besides the tree; in many dimensions up to that of plain, times log n;
//         plain O(n^2 d) and n doubles.
// Promise squared lengths as KdTree computes them, in rising order. The same for any number of
//         threads.
// Source  O. Boruvka, Prace Moravske Prirodovedecke Spolecnosti 3 (1926) 37-58; R. C. Prim, Bell
//         System Technical Journal 36 (1957) 1389-1401, doi:10.1002/j.1538-7305.1957.tb01515.x.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "math/neighbors/kd_tree.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// @throws Error(limit, cancelled)
std::vector<double> near_spanning_tree(std::span<const double> rows, std::size_t dimension,
                                       const std::vector<double>& sides, const RunContext& run,
                                       Norm norm = Norm::euclidean);

/// @throws Error(cancelled)
std::vector<double> plain_spanning_tree(std::span<const double> rows, std::size_t dimension,
                                        const std::vector<double>& sides, const RunContext& run,
                                        Norm norm = Norm::euclidean);

/// Whichever of them is faster. @throws Error(limit, cancelled)
std::vector<double> minimum_spanning_tree(std::span<const double> rows, std::size_t dimension,
                                          const std::vector<double>& sides, const RunContext& run,
                                          Norm norm = Norm::euclidean);

}  // namespace stipple
