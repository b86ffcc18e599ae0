// SPDX-License-Identifier: MIT
//
// Coordinates as whole multiples of 2^-63.
#pragma once

#include <cstdint>

namespace stipple::analyzers::l2 {

inline constexpr unsigned fraction_bits = 63;

/// The multiple of 2^-63 nearest to x in [0, 1].
inline std::uint64_t fixed(double x) {
    const double scaled = x * 0x1p63;
    const auto whole = static_cast<std::uint64_t>(scaled);
    return scaled < 0x1p52 ? static_cast<std::uint64_t>(scaled + 0.5) : whole;
}

}  // namespace stipple::analyzers::l2
