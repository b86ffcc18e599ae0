// SPDX-License-Identifier: MIT
#include "report/typical.hpp"

#include <fmt/format.h>

#include "core/text.hpp"

namespace stipple {

namespace tables {
const char* typical_csv();  // analyzer,key,random,jittered,best,generator
}

namespace {

std::string typical_in_words(std::string_view analyzer, std::string_view key, Better better) {
    for (const auto line : split(tables::typical_csv(), '\n')) {
        const auto cells = split(line, ',');
        if (cells.size() != 6 || cells[0] != analyzer || cells[1] != key) continue;
        std::string words =
            fmt::format("1024 points in the plane: random {}, jittered {}", cells[2], cells[3]);
        if (better == Better::neither) return words;
        return fmt::format("{} is better; {}, best {} ({})", word_of(better), words, cells[4],
                           cells[5]);
    }
    return {};
}

}  // namespace

std::vector<std::string> meaning_of(const Analyzer& analyzer, std::string_view key,
                                    std::size_t dimension) {
    std::vector<std::string> sentences;
    const ResultKey* result = find_result(analyzer, key);
    if (result == nullptr) return sentences;
    sentences.push_back(result->help);
    auto words = typical_in_words(analyzer.name, key, result->better);
    if (dimension == 2 && !words.empty()) sentences.push_back(std::move(words));
    return sentences;
}

}  // namespace stipple
