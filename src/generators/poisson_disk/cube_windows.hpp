// SPDX-License-Identifier: MIT
//
// Windows in space, whose 4 x 4 x 4 parts are the bits of one word: x + 4 y + 16 z.
//
// A disk about p covers a part if it covers the corner that is farthest from p, which for a row of
// parts is a sum of three squares, one for each direction, that all 64 parts share.
//
// Promise what is not said to be open is covered by one disk alone, and not within float_slack of
//         its rim.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>
#include <vector>

#include "generators/poisson_disk/disk_covers.hpp"
#include "generators/poisson_disk/disk_window.hpp"
#include "generators/poisson_disk/near_disks.hpp"

namespace stipple {

/// Centres of balls of radius 1, with far ones behind the last.
struct NearBalls {
    static constexpr std::size_t lanes = 16;
    static constexpr std::size_t room = power(5, 3) + lanes + 3;
    alignas(64) std::array<std::array<float, room>, 3> at;
    std::size_t size = 0;

    void close() {
        for (auto& along : at)
            std::fill_n(along.begin() + static_cast<std::ptrdiff_t>(size), lanes, 1e9F);
    }
};

/// A window of a cell that is not small.
struct CubeWindow {
    std::array<std::uint16_t, 3> corner;  ///< the lowest, in 2^-16 of a cell
    std::uint16_t place;                  ///< the cell's number in its tile
    std::uint8_t level;                   ///< the side is 2^-level of the cell's
};

/// Parts that no disk covers alone, of each window.
/// @param scales sides of a cell
void open_cubes(const NearBalls& near, const std::array<float, 3>& scales,
                std::span<const CubeWindow> windows, PartBits* out);

/// A part of a cell, and those of its own 64 parts that no disk covers alone.
struct OpenPart {
    PartBits open;
    std::uint8_t part;
};

/// The same for some parts of a cell; returns how many have something open, which `out`, of 65,
/// begins with.
std::size_t open_parts(const NearBalls& near, const std::array<float, 3>& scales, PartBits some,
                       OpenPart* out);

/// Whether a disk covers the place, for each.
void find_hits(const NearBalls& near, std::span<const std::array<float, 3>> places, Hit* out);

/// Indices of the places that are nearer than that; returns how many.
/// @param along coordinates, with 16 more behind the last @param squared distance
std::size_t find_near(const std::array<const float*, 3>& along, std::size_t first, std::size_t last,
                      const std::array<float, 3>& place, float squared, std::uint16_t* out);

/// The smallest box of parts around the open ones.
struct CubeExtent {
    std::array<std::size_t, 3> low{};
    std::size_t longest = 0;

    explicit CubeExtent(PartBits open) {
        // Each fold has a bit for every layer across a direction; a product lines them up.
        const PartBits no_z = (open | open >> 32) | (open | open >> 32) >> 16;
        const PartBits x = (no_z | no_z >> 8) | (no_z | no_z >> 8) >> 4;
        const PartBits y = (no_z | no_z >> 2) | (no_z | no_z >> 2) >> 1;
        const PartBits no_y = (open | open >> 8) | (open | open >> 8) >> 4;
        const PartBits z = (no_y | no_y >> 2) | (no_y | no_y >> 2) >> 1;
        take(0, x & 15);
        take(1, (y & 0x1111) * 0x1248 >> 12 & 15);
        take(2, (z & 0x0001000100010001U) * 0x0001000200040008U >> 48 & 15);
    }

  private:
    void take(std::size_t k, PartBits layers) {
        constexpr std::array<std::uint8_t, 16> lowest{0, 0, 1, 0, 2, 0, 1, 0,
                                                      3, 0, 1, 0, 2, 0, 1, 0};
        constexpr std::array<std::uint8_t, 16> lengths{0, 1, 1, 2, 1, 3, 2, 3,
                                                       1, 4, 3, 4, 2, 4, 3, 4};
        low[k] = lowest[layers];
        longest = std::max(longest, std::size_t{lengths[layers]});
    }
};

/// The eight halves of a window in which something is open.
inline void split_cube(const CubeWindow& window, PartBits open, std::vector<CubeWindow>& out) {
    constexpr PartBits first = 0x330033;
    CubeWindow smaller = window;
    ++smaller.level;
    for (unsigned child = 0; child < 8; ++child) {
        const unsigned shift = 2 * (child & 1) + 8 * (child >> 1 & 1) + 32 * (child >> 2);
        if ((open >> shift & first) == 0) continue;
        for (std::size_t k = 0; k < 3; ++k)
            smaller.corner[k] = static_cast<std::uint16_t>(
                window.corner[k] + ((child >> k & 1) << (16 - smaller.level)));
        out.push_back(smaller);
    }
}

/// As narrow (generators/poisson_disk/disk_window.hpp); something is open.
inline void narrow_cube(const CubeWindow& window, PartBits open, double darts,
                        std::vector<CubeWindow>& out) {
    constexpr double enough = 1;
    const CubeExtent extent(open);
    if (extent.longest > 2) {
        if (darts < enough) return out.push_back(window);
        return split_cube(window, open, out);
    }
    CubeWindow smaller = window;
    const std::size_t fit = extent.longest;  // 1 or 2, as sides of windows are
    smaller.level = static_cast<std::uint8_t>(smaller.level + 3 - fit);
    for (std::size_t k = 0; k < 3; ++k)
        smaller.corner[k] = static_cast<std::uint16_t>(
            smaller.corner[k] +
            (std::min(extent.low[k], std::size_t{4} - fit) << (14 - window.level)));
    out.push_back(smaller);
}

}  // namespace stipple
