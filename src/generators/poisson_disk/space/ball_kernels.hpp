// SPDX-License-Identifier: MIT
//
// Open sub-cells of gaps in space. The 4 x 4 x 4 sub-cells of a gap are the bits of a word.
//
// A ball around p covers a sub-cell if it covers the corner farthest from p. The squared distance
// of that corner is a sum of three squares, one for each direction. Sub-cells with the same index
// along a direction share the square for that direction.
//
// Promise a sub-cell that is not open is covered by a single ball, and not within float_slack of
//         its rim.
#pragma once

#include <array>
#include <span>

#include "generators/poisson_disk/gaps.hpp"
#include "generators/poisson_disk/near_disks.hpp"

namespace stipple::poisson_disk {

/// Sub-cells that no single ball covers, for each gap of a cell.
/// @param scales sides of a cell, in radii
void open_gaps(const NearDisks<3, float>& near, const std::array<float, 3>& scales,
               std::span<const Gap<3>> gaps, SubcellBits* out);

/// open_gaps() for gaps that are sub-cells of a cell: the set bits of `some`, in their order.
void open_subcells(const NearDisks<3, float>& near, const std::array<float, 3>& scales,
                   SubcellBits some, SubcellBits* out);

}  // namespace stipple::poisson_disk
