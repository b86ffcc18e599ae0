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

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "generators/poisson_disk/gaps.hpp"
#include "generators/poisson_disk/near_disks.hpp"

namespace stipple::poisson_disk {

/// Centres of balls of radius 1, with far ones behind the last.
struct NearBalls {
    static constexpr std::size_t lanes = 16;  ///< at most
    static constexpr std::size_t room = power(5, 3) + lanes + 3;
    alignas(64) std::array<std::array<float, room>, 3> at;
    std::size_t size = 0;

    void close() {
        for (auto& along : at)
            std::fill_n(along.begin() + static_cast<std::ptrdiff_t>(size), lanes, 1e9F);
    }
};

/// Sub-cells that no ball covers alone, of each gap of a cell.
/// @param scales sides of a cell
void open_gaps(const NearBalls& near, const std::array<float, 3>& scales,
               std::span<const Gap<3>> gaps, SubcellBits* out);

/// The same for some sub-cells of a cell, in the order of their bits.
void open_subcells(const NearBalls& near, const std::array<float, 3>& scales, SubcellBits some,
                   SubcellBits* out);

/// Whether a ball covers a place.
Hit find_hit(const NearBalls& near, const std::array<float, 3>& place);

}  // namespace stipple::poisson_disk
