// SPDX-License-Identifier: MIT
//
// maximal_disks (generators/poisson_disk/maximal_disks.hpp) in the plane, for boxes of five cells or
// more along each direction.
//
// First darts are thrown at the sub-cells that no disk covers by itself; then at gaps, which are cut
// down to their open sub-cells round by round. Darts of a tile are sorted by time, and tried one
// after the other: one that keeps its distance is a point at once. Pending are only those within two
// cells of the tile's edge, which a dart of another tile may come before, and those too near to such
// a one.
//
// Cost    O(n) time; on one core 0.4 us a point. Memory: 75 bytes a point; more in boxes fewer
//         than 64 cells wide.
#pragma once

#include "generators/poisson_disk/tile_rounds.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple::poisson_disk {

/// The points. @throws Error(cancelled)
Rows plane_sample(const Task<2>& task, const RunContext& run);

/// Bytes that tiles take with so many cells along both directions, without points.
double plane_tile_memory(double columns, double rows);

}  // namespace stipple::poisson_disk
