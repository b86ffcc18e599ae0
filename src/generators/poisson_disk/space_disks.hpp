// SPDX-License-Identifier: MIT
//
// maximal_disks (generators/poisson_disk/maximal_disks.hpp) in space, in cells that are worked on tile by tile
// (generators/poisson_disk/space_tiles.hpp).
//
// First showers fall everywhere, until a third of the points are there; then on the parts of cells
// that no ball covers by itself (generators/poisson_disk/ball_lines.hpp). What is left open of such a part is
// mostly covered by several balls together, which shows when it is cut into 64 smaller ones; those
// that are not are windows (generators/poisson_disk/cube_windows.hpp), on which showers fall until none is left.
//
// A tile is changed by one thread alone. In each shower it first takes over what stayed of the last
// one, of its own darts and of those near its faces; then darts fall, of which those stay in doubt
// that are far enough from all points; and when all tiles have got so far, these are decided.
//
// Cost    O(n) time; on one core 2 us a point. Memory: 230 bytes a point.
#pragma once

#include <cstdint>

#include "generators/poisson_disk/disk_grid.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// The points.
/// @param grid which is fine().
/// @param slack of distances that doubles hold, in radii @param expected number of points
/// @throws Error(cancelled)
Rows space_disks(const DiskGrid<3>& grid, double slack, std::uint64_t expected, std::uint64_t seed,
                 const RunContext& run);

}  // namespace stipple
