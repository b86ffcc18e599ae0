// SPDX-License-Identifier: MIT
//
// Integers of 128 bits, and their halves of 64 bits.
#pragma once

#include <cstdint>

namespace stipple {

__extension__ using Int128 = __int128;
__extension__ using Uint128 = unsigned __int128;

inline std::uint64_t low_half(Uint128 value) { return static_cast<std::uint64_t>(value); }
inline std::uint64_t high_half(Uint128 value) { return static_cast<std::uint64_t>(value >> 64); }

inline Uint128 wide_product(std::uint64_t a, std::uint64_t b) {
    return static_cast<Uint128>(a) * b;
}

}  // namespace stipple
