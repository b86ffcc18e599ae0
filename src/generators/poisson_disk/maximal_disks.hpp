// SPDX-License-Identifier: MIT
//
// Maximal Poisson-disk sets: points of a box thrown at random, none nearer than a radius r to
// another, until no further point fits. The process is dart throwing, to its end.
//
// Darts are a Poisson process in space and time. One stays if it keeps the distance from all that
// came before it and stayed. Where a disk covers a part of the box no dart can stay, so that none
// need be thrown there: darts are thrown only at uncovered space, more densely as it shrinks, and
// what stays is what would have stayed without that. Uncovered space is known as cells, then as
// sub-cells of cells that no disk covers by itself, and in the end as gaps that are cut down to
// such sub-cells again and again (generators/poisson_disk/gaps.hpp). A gap without one is covered
// for certain, and with the last gap the set is maximal.
//
// Darts are thrown in rounds, at all tiles of the box (generators/poisson_disk/tile_rounds.hpp).
// Boxes of five cells or more along each direction have samplers of their own in the plane and in
// space (plane/, space/); box_sampler.cpp takes all others.
//
// Shape   d = 2 ... 6; any box; r up to its diagonal.
// Cost    O(n) time for fixed d: on one core 0.4 us a point (d = 2), 2 us (3), 0.4 ms (4), 2 ms
//         (5), 30 ms (6). Memory: 75 bytes a point (d = 2), 230 (3).
// Promise squared_distance (math/neighbors/spaced_points.hpp) of the numbers that come out is at
//         least r^2 for every pair. Every place of the box is nearer than r to a point, but for
//         gaps so narrow that float64 hardly tells them from none: below 2^-48 of the largest
//         coordinate. Points are in [low, high).
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

/// About how many points there will be.
double expected_disks(const BoxSpace& space, double radius);

/// The points, in no order that means anything, but always in the same.
/// @param cell_radius of the grid, at most `radius`: with the same one, sets for radii that hardly
/// differ hardly differ themselves. @throws Error(limit, cancelled)
Rows maximal_disks(const BoxSpace& space, double radius, double cell_radius, std::uint64_t seed,
                   const RunContext& run);

}  // namespace stipple::poisson_disk
