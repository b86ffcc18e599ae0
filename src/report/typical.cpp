// SPDX-License-Identifier: MIT
#include "report/typical.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/text.hpp"

namespace stipple {

namespace tables {
const char* typical_csv();  // columns analyzer,key,random,jittered,best,generator
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

/// Whether all given flags and choices have their default values.
bool has_default_choices(const Analyzer& analyzer, const GivenOptions& given) {
    return std::ranges::all_of(analyzer.options.options(), [&](const Option& option) {
        const auto it = std::ranges::find(given, option.name, &GivenOptions::value_type::first);
        if (it == given.end() || (option.type != "choice" && option.type != "flag")) return true;
        const auto* usual = std::get_if<std::string>(&option.fallback);
        return !option.optional && it->second == (usual ? *usual : "false");
    });
}

}  // namespace

std::vector<std::string> meaning_of(const Analyzer& analyzer, std::string_view key,
                                    std::size_t dimension, const GivenOptions& given) {
    std::vector<std::string> sentences;
    const ResultKey* result = find_result(analyzer, key);
    if (result == nullptr) return sentences;
    sentences.push_back(result->help);
    auto words = typical_in_words(analyzer.name, key, result->better);
    if (dimension == 2 && !words.empty() && has_default_choices(analyzer, given))
        sentences.push_back(std::move(words));
    return sentences;
}

}  // namespace stipple
