// SPDX-License-Identifier: MIT
//
// maximal_disks (generators/poisson_disk/maximal_disks.hpp) in the plane, in cells that are worked on tile by
// tile (generators/poisson_disk/plane_tiles.hpp).
//
// First showers fall everywhere, until most of the box is covered; then on the parts of cells that
// no disk covers by itself, and last on windows of what is open of a cell, which are cut down to
// their open parts shower by shower. Darts of a tile are sorted by time, and tried one after the
// other.
//
// Cost    O(n) time; on one core 0.4 us a point. Memory: 75 bytes a point; more in boxes fewer
//         than 64 cells wide.
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
Rows plane_disks(const DiskGrid<2>& grid, double slack, std::uint64_t expected, std::uint64_t seed,
                 const RunContext& run);

}  // namespace stipple
