// SPDX-License-Identifier: MIT
//
// Numbers as they stand in binary files.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace stipple {

/// How a number is stored.
struct RawType {
    enum Kind { floating, integer, natural };
    Kind kind = floating;
    std::size_t size = 8;  ///< bytes: 4 or 8; whole numbers also 1 or 2
    bool big_endian = false;
};

/// Converts numbers.size() numbers from the front of `bytes`.
void take_raw(std::string_view bytes, const RawType& type, std::span<double> numbers);

/// Appends little-endian float64, or float32 as to_single gives it.
void append_raw(std::string& out, std::span<const double> numbers, bool single);

/// `value` as float32, cut toward zero: what was below 1 stays below 1.
float to_single(double value);

}  // namespace stipple
