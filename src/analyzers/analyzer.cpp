// SPDX-License-Identifier: MIT
#include "analyzers/analyzer.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

/// Whether a part of a key is a placeholder for any name.
bool is_free(std::string_view part) {
    return std::ranges::all_of(part, [](char c) { return c >= 'A' && c <= 'Z'; });
}

}  // namespace

std::size_t free_parts(const ResultKey& result) {
    return static_cast<std::size_t>(std::ranges::count_if(split(result.key, '.'), is_free));
}

const ResultKey* find_result(const Analyzer& analyzer, std::string_view key) {
    const auto names = split(key, '.');
    const auto fits = [](std::string_view part, std::string_view name) {
        return is_free(part) || part == name;
    };
    const auto it = std::ranges::find_if(analyzer.results, [&](const ResultKey& result) {
        return std::ranges::equal(split(result.key, '.'), names, fits);
    });
    return it == analyzer.results.end() ? nullptr : &*it;
}

void check_dimension(const Analyzer& analyzer, std::size_t dimension) {
    const auto& traits = analyzer.traits;
    if (dimension >= traits.min_dimension && dimension <= traits.max_dimension) return;
    if (traits.min_dimension == traits.max_dimension)
        fail(ErrorKind::input, "{} requires points of dimension {}; these have {}", analyzer.name,
             traits.min_dimension, dimension);
    fail(ErrorKind::input, "{} requires points of dimension {} to {}; these have {}", analyzer.name,
         traits.min_dimension, traits.max_dimension, dimension);
}

bool alike(std::span<const Report> sets, std::string_view key) {
    const double first = sets[0].number(key);
    return std::ranges::all_of(
        sets, [&](const Report& set) { return std::abs(set.number(key) - first) <= 1e-9 * first; });
}

void drop(Report& report, std::initializer_list<std::string_view> names) {
    std::erase_if(report.entries(), [&](const auto& entry) {
        return std::ranges::find(names, entry.name) != names.end();
    });
}

std::uint64_t batch_grain(const Arrival& arrival, const Values& /*options*/) {
    return arrival_batch(arrival.dimension());
}

}  // namespace stipple
