// SPDX-License-Identifier: MIT
//
// A short name for bytes, to tell whether they changed: 64 bits,
//
//     h_0 = 14695981039346656037,    h_i = (h_{i-1} xor byte_i) * 1099511628211  (mod 2^64).
//
// Beware  no protection from somebody who changes them on purpose.
// Source  G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, The FNV non-cryptographic hash algorithm
//         (FNV-1a).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace stipple {

/// @param before the fingerprint of the bytes before these; none: that of no bytes
std::uint64_t fingerprint(std::string_view bytes, std::optional<std::uint64_t> before = {});

/// Of the numbers as little-endian float64.
std::uint64_t fingerprint(std::span<const double> numbers);

/// As 16 hexadecimal digits.
std::string format_fingerprint(std::uint64_t value);

}  // namespace stipple
