// SPDX-License-Identifier: MIT
//
// maximal_disks (generators/poisson_disk/maximal_disks.hpp) in any dimension and any box: also in
// those of fewer than five cells along a direction.
//
// Tiles know the points that reach into them, and go through all of them for each cell. Gaps are
// cells in the beginning, and are cut down round by round (generators/poisson_disk/gaps.hpp).
//
// Shape   D = 2 ... 6.
// Cost    O(n) time; see maximal_disks.hpp. Beside plane_sampler.hpp and space_sampler.hpp for D = 2
//         and 3, which are 2.6 and 4.6 times as fast.
#pragma once

#include "generators/poisson_disk/tile_rounds.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple::poisson_disk {

/// Largest number of cells along a tile's side, as a power of two.
template <std::size_t D>
inline constexpr unsigned box_tile_bits = D == 2   ? 4
                                          : D <= 4 ? 3
                                                   : 2;

/// The points. @throws Error(cancelled)
template <std::size_t D>
Rows box_sample(const Task<D>& task, const RunContext& run);

}  // namespace stipple::poisson_disk
