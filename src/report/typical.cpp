// SPDX-License-Identifier: MIT
#include "report/typical.hpp"

#include <fmt/format.h>

#include "core/text.hpp"

namespace stipple {

namespace tables {
const char* typical_csv();  // analyzer,key,better,random,jittered,best,generator
}

namespace {

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

}  // namespace

std::vector<std::string> meaning_of(const Analyzer& analyzer, std::string_view key,
                                    std::size_t dimension) {
    std::vector<std::string> sentences;
    if (const ResultKey* result = find_result(analyzer, key)) sentences.push_back(result->help);
    if (auto words = typical_in_words(analyzer.name, key); dimension == 2 && !words.empty())
        sentences.push_back(std::move(words));
    return sentences;
}

}  // namespace stipple
