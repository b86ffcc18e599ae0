// SPDX-License-Identifier: MIT
//
// 64-bit fractions: numbers in [0, 1) whose first binary digit is the top bit.
#pragma once

#include <bit>
#include <cstdint>

namespace stipple {

/// Reverses the 64 bits: the base-2 radical inverse of x, as a fraction.
constexpr std::uint64_t reversed_bits(std::uint64_t x) {
    x = ((x >> 1) & 0x5555555555555555U) | ((x & 0x5555555555555555U) << 1);
    x = ((x >> 2) & 0x3333333333333333U) | ((x & 0x3333333333333333U) << 2);
    x = ((x >> 4) & 0x0f0f0f0f0f0f0f0fU) | ((x & 0x0f0f0f0f0f0f0f0fU) << 4);
    return __builtin_bswap64(x);
}

/// Returns the upper 53 bits of the fraction as a double in [0, 1), exactly. Vector instructions
/// cannot convert 64-bit integers to doubles, so two halves are placed in mantissas: a double in
/// [2^20, 2^21) holds the first 32 binary digits after the point, one in [1/2, 1) the next 21.
constexpr double fraction_to_unit(std::uint64_t fraction) {
    constexpr auto above = std::bit_cast<std::uint64_t>(0x1p20);
    constexpr auto below = std::bit_cast<std::uint64_t>(0.5);
    constexpr std::uint64_t mask = (std::uint64_t{1} << 21) - 1;
    const auto high = std::bit_cast<double>((fraction >> 32) | above);
    const auto low = std::bit_cast<double>(((fraction >> 11) & mask) | below);
    return (high - (0x1p20 + 0.5)) + low;
}

}  // namespace stipple
