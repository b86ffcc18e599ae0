// SPDX-License-Identifier: MIT
//
// maximal_disks (generators/poisson_disk/maximal_disks.hpp) in space, for boxes of five cells or
// more along each direction.
//
// First darts are thrown at the sub-cells that no ball covers by itself (space/ball_lines.hpp). What
// is left open of a sub-cell is mostly covered by several balls together, which shows when it is cut
// into 64 smaller ones; those that are not are gaps (space/ball_kernels.hpp), at which darts are
// thrown until none is left.
//
// Cost    O(n) time; on one core 2 us a point. Memory: 230 bytes a point.
#pragma once

#include "generators/poisson_disk/tile_rounds.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple::poisson_disk {

/// The points. @throws Error(cancelled)
Rows space_sample(const Task<3>& task, const RunContext& run);

/// Bytes that so many tiles take, without points.
double space_tile_memory(double tiles);

}  // namespace stipple::poisson_disk
