// SPDX-License-Identifier: MIT
//
// Eight numbers at a time, for kernels behind STIPPLE_WIDE.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "generators/poisson_disk/disk_covers.hpp"

namespace stipple {

using Lanes = float __attribute__((vector_size(32)));
using LaneBits = std::int32_t __attribute__((vector_size(32)));

/// Bit x + 8 y where lane x of line y is not set.
[[gnu::always_inline]] inline PartBits unset(const std::array<LaneBits, 8>& lines) {
    constexpr LaneBits weights{1, 2, 4, 8, 16, 32, 64, 128};
    std::array<LaneBits, 2> halves{};
    for (std::size_t y = 0; y < 8; ++y)
        halves[y / 4] |= (lines[y] & weights) << static_cast<int>(8 * (y % 4));
    PartBits set = 0;
    for (std::size_t half = 0; half < 2; ++half) {
        std::int32_t all = 0;
        for (std::size_t lane = 0; lane < 8; ++lane) all |= halves[half][lane];
        set |= PartBits{static_cast<std::uint32_t>(all)} << (32 * half);
    }
    return ~set;
}

}  // namespace stipple
