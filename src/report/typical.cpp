// SPDX-License-Identifier: MIT
#include "report/typical.hpp"

#include <fmt/format.h>

#include "core/text.hpp"

namespace stipple {

namespace tables {
const char* typical_csv();  // analyzer,key,better,random,jittered,best,generator
}

std::string typical_in_words(std::string_view analyzer, std::string_view key) {
    for (const auto line : split(tables::typical_csv(), '\n')) {
        const auto cells = split(line, ',');
        if (cells.size() != 7 || cells[0] != analyzer || cells[1] != key) continue;
        std::string words =
            fmt::format("1024 points in the plane: random {}, jittered {}", cells[3], cells[4]);
        if (cells[2] == "neither") return words;
        return fmt::format("{} is better; {}, best {} ({})", cells[2], words, cells[5], cells[6]);
    }
    return {};
}

}  // namespace stipple
