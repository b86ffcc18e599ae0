// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace stipple {

/// The 64 bits from last to first: the radical inverse in base 2, as a fraction.
constexpr std::uint64_t reversed_bits(std::uint64_t x) {
    x = ((x >> 1) & 0x5555555555555555U) | ((x & 0x5555555555555555U) << 1);
    x = ((x >> 2) & 0x3333333333333333U) | ((x & 0x3333333333333333U) << 2);
    x = ((x >> 4) & 0x0f0f0f0f0f0f0f0fU) | ((x & 0x0f0f0f0f0f0f0f0fU) << 4);
    return __builtin_bswap64(x);
}

}  // namespace stipple
