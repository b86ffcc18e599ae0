// SPDX-License-Identifier: MIT
//
// Maximal Poisson-disk sets: random points of a box, no two of them nearer than a radius r, by dart
// throwing until no further point fits.
//
// Darts are a Poisson process in space and time. A dart is kept if it keeps the distance from all
// darts kept before. A dart on a disk cannot be kept and need not be thrown. So darts are thrown
// only at uncovered space, more densely as it shrinks, with the same result. Uncovered space is
// represented by cells, then by those sub-cells of cells that no single disk covers, and in the end
// by gaps, which are cut down to such sub-cells again and again (generators/poisson_disk/gaps.hpp).
// A gap without such sub-cells is certainly covered, and after the last gap the set is maximal.
//
// Darts are thrown in rounds, at all tiles of the box (generators/poisson_disk/tile_rounds.hpp).
// Boxes of five cells or more along each direction have samplers of their own in the plane and in
// space (plane/, space/); box_sampler.cpp is for all others.
//
// Shape   d = 2 ... 6; any box; r up to its diagonal.
// Cost    O(n) time for fixed d: on one core 0.4 us a point (d = 2), 2 us (3), 0.4 ms (4), 2 ms
//         (5), 30 ms (6). Memory: 75 bytes a point (d = 2), 230 (3).
// Promise squared_distance (math/neighbors/spaced_points.hpp) of returned coordinates is at least
//         r^2 for every pair. Every position in the box is nearer than r to a point, except in
//         gaps that float64 can hardly resolve: below 2^-48 of the largest coordinate. Points are
//         in [low, high).
// Source  the process is that of R. L. Cook, ACM Trans. Graph. 5 (1986) 51-72,
//         doi:10.1145/7529.8927; gaps after M. S. Ebeida, S. A. Mitchell, A. Patney,
//         A. A. Davidson, J. D. Owens, Comput. Graph. Forum 31 (2012) 785-794,
//         doi:10.1111/j.1467-8659.2012.03059.x.
#pragma once

#include <cstdint>

#include "generators/box_space.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple::poisson_disk {

/// Approximate number of points of a maximal disk set.
double expected_disks(const BoxSpace& space, double radius);

/// Makes the points, in an arbitrary but reproducible order.
/// @param cell_radius radius that the grid's cells are made for, at most `radius`; with the same
/// cells, similar radii give similar sets
/// @throws Error(limit, cancelled)
Rows maximal_disks(const BoxSpace& space, double radius, double cell_radius, std::uint64_t seed,
                   const RunContext& run);

}  // namespace stipple::poisson_disk
