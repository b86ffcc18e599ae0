// SPDX-License-Identifier: MIT
//
// Reads numbers from tables of hexadecimal digits.
#pragma once

#include <charconv>
#include <cstdint>
#include <string_view>

namespace stipple::generators {

inline std::uint64_t hex_number(std::string_view digits) {
    std::uint64_t number = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
    return number;
}

}  // namespace stipple::generators
