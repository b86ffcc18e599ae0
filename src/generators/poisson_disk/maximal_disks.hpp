// SPDX-License-Identifier: MIT
//
// Points of a box thrown at random, none nearer than a radius r to another, until no place is left:
// the process of dart throwing, to its end.
//
// Darts fall as rain, a Poisson process in space and time. One stays if it keeps the distance from
// all that fell before it and stayed. Where a disk covers a part of the box no dart can stay, so
// that none need be thrown there: rain falls on what is left alone, the harder the less is left,
// and what stays is what would have stayed without that. What is left is known in two and three
// dimensions as the parts of cells that no disk covers by itself (generators/poisson_disk/disk_covers.hpp), and
// in the end, and in more dimensions from the start, as windows of cells that are cut down to such
// parts again and again (generators/poisson_disk/near_disks.hpp). A window without one is covered for certain,
// and with the last window the set is maximal.
//
// Rain falls in showers. Of a shower, darts that are too near to older points go first; of those
// that are left each stays unless an earlier one that is too near to it stays, which is asked from
// dart to dart. That has one answer, whatever the order of asking, so that threads do not matter.
// In the plane darts are asked at once as they fall, in order of time, but for those near the edges
// of tiles (generators/poisson_disk/plane_tiles.hpp). In space tiles know of points beyond their faces as well
// (generators/poisson_disk/space_tiles.hpp).
//
// Shape   d = 2 ... 6; any box; r up to its diagonal.
// Cost    O(n) time for fixed d: on one core 0.4 us a point (d = 2), 2 us (3), 0.5 ms (4), 2.5 ms
//         (5), 30 ms (6). Memory: 75 bytes a point (d = 2), 230 (3).
// Promise squared_distance (math/neighbors/spaced_points.hpp) of the numbers that come out is at least r^2
//         for every pair. Every place of the box is nearer than r to a point, but for gaps so
//         narrow that float64 hardly tells them from none: below 2^-48 of the largest coordinate.
//         Points are in [low, high).
// Source  the process is that of R. L. Cook, ACM Trans. Graph. 5 (1986) 51-72,
//         doi:10.1145/7529.8927; windows after M. S. Ebeida, S. A. Mitchell, A. Patney,
//         A. A. Davidson, J. D. Owens, Comput. Graph. Forum 31 (2012) 785-794,
//         doi:10.1111/j.1467-8659.2012.03059.x.
#pragma once

#include <cstdint>

#include "generators/box_space.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// About how many points there will be; a little more rather than less.
double expected_disks(const BoxSpace& space, double radius);

/// The points, in no order that means anything, but always in the same.
/// @param cell_radius of the grid, at most `radius`: with the same one, sets for radii that hardly
/// differ hardly differ themselves. @throws Error(limit, cancelled)
Rows maximal_disks(const BoxSpace& space, double radius, double cell_radius, std::uint64_t seed,
                   const RunContext& run);

}  // namespace stipple
