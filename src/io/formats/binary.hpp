// SPDX-License-Identifier: MIT
//
// Numbers as they stand in binary files: the common part of bin, npy and ply.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/bytes/raw_numbers.hpp"

namespace stipple::io {

/// Appends little-endian float64, or float32 cut toward zero.
void append_raw(std::string& out, std::span<const double> numbers, bool single);

/// Where numbers came from, for messages.
struct RawPlace {
    std::string source;
    std::size_t row = 0;     ///< numbers of a point; 0 where they do not stand together
    std::size_t size = 8;    ///< bytes of a number
    std::size_t offset = 0;  ///< byte at which the first of all stands
    std::size_t before = 0;  ///< numbers before these
};

/// @throws Error(input) naming the first number that is not finite, its byte and its point.
void check_finite(std::span<const double> numbers, const RawPlace& place);

}  // namespace stipple::io
