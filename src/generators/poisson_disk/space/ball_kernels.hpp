// SPDX-License-Identifier: MIT
//
// What balls leave open of gaps in space, whose 4 x 4 x 4 sub-cells are the bits of one word.
//
// A ball about p covers a sub-cell if it covers the corner that is farthest from p, which for a row
// of sub-cells is a sum of three squares, one for each direction, that all 64 share.
//
// Promise what is not said to be open is covered by one ball alone, and not within float_slack of
//         its rim.
#pragma once

#include <array>
#include <span>

#include "generators/poisson_disk/gaps.hpp"
#include "generators/poisson_disk/near_disks.hpp"

namespace stipple::poisson_disk {

/// Sub-cells that no ball covers alone, of each gap of a cell.
/// @param scales sides of a cell
void open_gaps(const NearDisks<3, float>& near, const std::array<float, 3>& scales,
               std::span<const Gap<3>> gaps, SubcellBits* out);

/// The same for some sub-cells of a cell, in the order of their bits.
void open_subcells(const NearDisks<3, float>& near, const std::array<float, 3>& scales,
                   SubcellBits some, SubcellBits* out);

}  // namespace stipple::poisson_disk
