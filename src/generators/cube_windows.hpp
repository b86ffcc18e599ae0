// SPDX-License-Identifier: MIT
//
// Windows in space, whose 4 x 4 x 4 parts are the bits of one word: x + 4 y + 16 z.
//
// A disk about p covers a part if it covers the corner that is farthest from p, which for a row of
// parts is a sum of three squares, one for each direction, that all 64 parts share.
//
// Cost    some 60 instructions for each disk that covers a part, and 200 for a window.
// Promise what is not said to be open is covered by one disk alone, and not within float_slack of
//         its rim.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <vector>

#include "generators/disk_covers.hpp"
#include "generators/disk_window.hpp"
#include "generators/near_disks.hpp"

namespace stipple {

/// Parts of a window that no disk covers alone.
PartBits open_cube(const NearDisks<3, float>& near, const Raster<3, float>& window);

/// The smallest box of parts around the open ones.
struct CubeExtent {
    std::array<std::size_t, 3> low{};
    std::size_t longest = 0;

    explicit CubeExtent(PartBits open) {
        const auto take = [&](std::size_t k, PartBits folded, unsigned stride) {
            PartBits along = 0;
            for (unsigned i = 0; i < 4; ++i) along |= (folded >> (i * stride) & 1) << i;
            low[k] = static_cast<std::size_t>(std::countr_zero(along));
            longest = std::max(longest, static_cast<std::size_t>(std::bit_width(along)) - low[k]);
        };
        const PartBits no_z = (open | open >> 32) | (open | open >> 32) >> 16;
        const PartBits only_x = (no_z | no_z >> 8) | (no_z | no_z >> 8) >> 4;
        const PartBits only_y = (no_z | no_z >> 2) | (no_z | no_z >> 2) >> 1;
        const PartBits no_y = (open | open >> 8) | (open | open >> 8) >> 4;
        const PartBits only_z = (no_y | no_y >> 2) | (no_y | no_y >> 2) >> 1;
        take(0, only_x, 1);
        take(1, only_y, 4);
        take(2, only_z, 16);
    }
};

/// The eight halves of a window in which something is open.
inline void split_cube(const Window<3>& window, PartBits open, std::vector<Window<3>>& out) {
    constexpr PartBits first = 0x330033;
    Window<3> smaller = window;
    ++smaller.level;
    const double side = smaller.side();
    for (unsigned child = 0; child < 8; ++child) {
        const unsigned shift = 2 * (child & 1) + 8 * (child >> 1 & 1) + 32 * (child >> 2);
        if ((open >> shift & first) == 0) continue;
        for (std::size_t k = 0; k < 3; ++k)
            smaller.corner[k] = window.corner[k] + side * static_cast<double>(child >> k & 1);
        out.push_back(smaller);
    }
}

/// As narrow (generators/disk_window.hpp); something is open.
inline void narrow_cube(const Window<3>& window, PartBits open, double darts,
                        std::vector<Window<3>>& out) {
    constexpr double enough = 1;
    const CubeExtent extent(open);
    if (extent.longest > 2) {
        if (darts < enough) return out.push_back(window);
        return split_cube(window, open, out);
    }
    Window<3> smaller = window;
    const std::size_t fit = extent.longest;  // 1 or 2, as sides of windows are
    smaller.level = static_cast<std::uint8_t>(smaller.level + 3 - fit);
    for (std::size_t k = 0; k < 3; ++k)
        smaller.corner[k] +=
            window.part() * static_cast<double>(std::min(extent.low[k], std::size_t{4} - fit));
    out.push_back(smaller);
}

}  // namespace stipple
