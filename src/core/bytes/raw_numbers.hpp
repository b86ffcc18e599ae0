// SPDX-License-Identifier: MIT
//
// Conversion of numbers from and to the types in which binary files store them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace stipple {

/// Binary type of a stored number.
struct RawType {
    enum Kind { floating, integer, natural };
    Kind kind = floating;
    std::size_t size = 8;  ///< bytes per number: 4 or 8; for integers also 1 or 2
    bool big_endian = false;
};

/// Converts the numbers at the front of `bytes` until `numbers` is full.
void take_raw(std::string_view bytes, const RawType& type, std::span<double> numbers);

/// Appends numbers as little-endian float64, or as float32 rounded by to_single().
void append_raw(std::string& out, std::span<const double> numbers, bool single);

/// Rounds `value` to float32 toward zero, so that values below 1 stay below 1.
float to_single(double value);

}  // namespace stipple
