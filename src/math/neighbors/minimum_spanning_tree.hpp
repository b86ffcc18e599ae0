// SPDX-License-Identifier: MIT
//
// Minimum spanning tree of n points: the n - 1 edges that connect them with the smallest total
// length. Ties may affect which edges it has, but not their lengths.
//
//     near_spanning_tree     every component takes the shortest edge to another, by a k-d tree
//                            that skips points of the same component (Boruvka).
//     plain_spanning_tree    one component takes the nearest outside point, n - 1 times (Prim).
//
// Shape   1 <= n < 2^32 points. `sides` are those of the torus, as for KdTree; empty for no torus.
//         Duplicates are joined by edges of length 0.
// Cost    near: O(n log^2 n) in few dimensions, 4.2 s for 10^6 points in the plane on one core, 72
//         bytes per point without the tree; in many dimensions up to log n times the cost of plain.
//         plain: O(n^2 d) and n doubles.
// Promise squared lengths as computed by KdTree, in increasing order. The same for any number of
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

/// Squared edge lengths by Boruvka's method. @throws Error(limit, cancelled)
std::vector<double> near_spanning_tree(std::span<const double> rows, std::size_t dimension,
                                       const std::vector<double>& sides, const RunContext& run,
                                       Norm norm = Norm::euclidean);

/// Squared edge lengths by Prim's method. @throws Error(cancelled)
std::vector<double> plain_spanning_tree(std::span<const double> rows, std::size_t dimension,
                                        const std::vector<double>& sides, const RunContext& run,
                                        Norm norm = Norm::euclidean);

/// Squared edge lengths by the faster method. @throws Error(limit, cancelled)
std::vector<double> minimum_spanning_tree(std::span<const double> rows, std::size_t dimension,
                                          const std::vector<double>& sides, const RunContext& run,
                                          Norm norm = Norm::euclidean);

}  // namespace stipple
