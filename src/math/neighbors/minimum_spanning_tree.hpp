// SPDX-License-Identifier: MIT
//
// Minimum spanning tree of n points: of all ways to join them by n - 1 edges, the one of the least
// total length. Which edges it has may hang on ties; how long they are does not.
//
//     planar_spanning_tree   its edges are among those of Delaunay's triangles, on the torus too:
//     of
//                            two points that a third is nearer to than they are to each other, the
//                            edge is the longest of a triangle. The shortest edges first (Kruskal).
//     near_spanning_tree     every part grown so far takes the shortest edge to another, by a k-d
//                            tree that passes over what is of the own part (Boruvka).
//     plain_spanning_tree    one part takes the nearest point outside, n times (Prim).
//
// Shape   1 <= n < 2^32 points. `sides` as for KdTree: of the torus, whose points are in one box of
//         these sides; none for Euclidean distances. Duplicates are joined by edges of length 0.
// Cost    planar O(n log n) for points spread about evenly, 3.4 s for 10^6 on one core, 150 bytes a
//         point; near O(n log^2 n) in few dimensions for points of any kind, in many up to that of
//         plain, times log n; plain O(n^2 d) and n doubles.
// Promise squared lengths as KdTree computes them, in rising order. The same for any number of
//         threads.
// Source  J. B. Kruskal, Proc. AMS 7 (1956) 48-50, doi:10.1090/S0002-9939-1956-0078686-7; R. C.
//         Prim, Bell System Technical Journal 36 (1957) 1389-1401,
//         doi:10.1002/j.1538-7305.1957.tb01515.x; G. T. Toussaint, Pattern Recognition 12 (1980)
//         261-268, doi:10.1016/0031-3203(80)90066-7 (the edges are Delaunay's).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/run_context.hpp"

namespace stipple {

/// Points of the plane; those crowded into few places take the near way. @throws Error(limit,
/// cancelled)
std::vector<double> planar_spanning_tree(std::span<const double> rows,
                                         const std::vector<double>& low,
                                         const std::vector<double>& sides, const RunContext& run);

/// @throws Error(limit, cancelled)
std::vector<double> near_spanning_tree(std::span<const double> rows, std::size_t dimension,
                                       const std::vector<double>& sides, const RunContext& run);

/// @throws Error(cancelled)
std::vector<double> plain_spanning_tree(std::span<const double> rows, std::size_t dimension,
                                        const std::vector<double>& sides, const RunContext& run);

/// Whichever of them is fastest. `low` is the torus' low corner, if it is one.
std::vector<double> minimum_spanning_tree(std::span<const double> rows, std::size_t dimension,
                                          const std::vector<double>& low,
                                          const std::vector<double>& sides, const RunContext& run);

}  // namespace stipple
