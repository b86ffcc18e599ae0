// SPDX-License-Identifier: MIT
//
// Reads tables of words, such as fractions.txt: lines that begin with # are comments.
#pragma once

#include <charconv>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/text.hpp"

namespace stipple::generators {

inline std::vector<std::vector<std::string_view>> table_lines(std::string_view table) {
    std::vector<std::vector<std::string_view>> lines;
    for (const std::string_view line : split(table, '\n'))
        if (!line.empty() && line.front() != '#') lines.push_back(split(line, ' '));
    return lines;
}

inline std::uint64_t number_of(std::string_view digits, int base = 10) {
    std::uint64_t number = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number, base);
    return number;
}

}  // namespace stipple::generators
