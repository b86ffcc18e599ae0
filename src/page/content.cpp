// SPDX-License-Identifier: MIT
#include "page/content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plot/drawing/ticks.hpp"
#include "report/document.hpp"
#include "study/study_summary.hpp"

namespace stipple::page {

using plot::rounded;

namespace {

constexpr double least_probability = 1e-16;  ///< smaller p-values are shown as "<"

/// Whether a key names a p-value: p_value, combined_p_upper[1]; but not p_method.
bool is_probability(std::string_view key) {
    key = key.substr(0, key.find('['));
    return key.ends_with("p_value") || key.ends_with("p_upper") || key.ends_with("p_lower");
}

/// A p-value in words.
std::string probability(double p) {
    return p < least_probability ? "p < 1e-16" : fmt::format("p = {}", rounded(p, 2));
}

/// Statistic of a test in words: chi-squared or, for a test of each axis, the largest distance.
std::string numbers_of_test(const Report& found) {
    if (const auto statistic = number_at(found, "statistic"))
        return fmt::format("χ² = {} with {} degrees of freedom, {}", rounded(*statistic),
                           rounded(found.number("degrees_of_freedom"), 12),
                           probability(found.number("p_value")));
    const auto& statistic = found.curve("statistic");
    const auto worst = std::ranges::max_element(statistic);
    return fmt::format("largest distance {}, on axis {}; {} over all axes", rounded(*worst),
                       worst - statistic.begin() + 1,
                       probability(found.number("combined_p_value")));
}

bool same_domain(std::span<const Set> sets) {
    return std::ranges::all_of(sets, [&](const Set& set) { return set.domain == sets[0].domain; });
}

}  // namespace

const Report* Set::results(std::string_view measure) const {
    const auto it = std::ranges::find(measures, measure, &Measure::name);
    return it == measures.end() || !it->results ? nullptr : &*it->results;
}

Report Set::all_results() const {
    Report all;
    for (const Measure& measure : measures)
        if (measure.results) all.add(measure.name, *measure.results);
    return all;
}

bool same_count(std::span<const Set> sets) {
    return std::ranges::all_of(sets, [&](const Set& set) { return set.count == sets[0].count; });
}

std::vector<std::string> notes_on(std::span<const Set> sets) {
    std::vector<std::string> notes;
    if (!same_count(sets))
        notes.emplace_back(
            "The sets have different numbers of points. Most measures depend on this number, so "
            "the best set is marked only for those that do not.");
    if (!same_domain(sets))
        notes.emplace_back("The sets are on different domains, so no set is marked as best.");
    for (std::size_t i = 0; i < sets.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (sets[i].fingerprint && sets[i].fingerprint == sets[j].fingerprint)
                notes.push_back(fmt::format("{} and {} are the same points in the same order.",
                                            sets[j].name, sets[i].name));
    return notes;
}

std::span<const Planned> planned_measures() {
    static const std::vector<Planned> all = [] {
        std::vector<Planned> found;
        for (const Analyzer& analyzer : analyzers::all())
            for (const PageMeasure& measure : analyzer.page)
                found.push_back(
                    {measure.name.empty() ? analyzer.name : measure.name, &analyzer, &measure});
        std::ranges::stable_sort(found, {}, [](const Planned& one) { return one.analyzer->part; });
        return found;
    }();
    return all;
}

const Planned* planned(std::string_view measure) {
    const auto at = std::ranges::find(planned_measures(), measure, &Planned::name);
    return at == planned_measures().end() ? nullptr : &*at;
}

std::span<const Key> compared_keys() {
    static constexpr std::string_view groups[] = {"Discrepancy", "L2 discrepancy", "Gaps",
                                                  "Distances",   "Spectrum",       "Correlation",
                                                  "Integration", "Uniformity"};
    static const std::vector<Key> keys = [] {
        std::vector<Key> found;
        for (const auto& [name, analyzer, measure] : planned_measures())
            for (const auto& [key, label] : measure->compared)
                if (const ResultKey& result = *find_result(*analyzer, key); result.words.empty())
                    found.push_back({fmt::format("{}.{}", name, key), label,
                                     groups[static_cast<std::size_t>(analyzer->part)],
                                     result.better, result.any_count});
        return found;
    }();
    return keys;
}

namespace {

/// The result under a path such as "value", with its bounds; nullopt if there is none.
std::optional<Known> known_in(const Report* found, std::string_view path, bool magnitude) {
    if (found == nullptr) return std::nullopt;
    const auto lower = path == "value" ? number_at(*found, "lower") : std::nullopt;
    const auto value = number_at(*found, path);
    auto known = value ? value : lower;
    if (!known || std::isnan(*known)) return std::nullopt;
    if (magnitude) known = std::abs(*known);
    if (!lower) return Known{*known, *known, *known};
    return Known{*known, *lower, number_at(*found, "upper").value_or(*known)};
}

/// Mean with its standard error; for magnitudes the root mean square.
Known mean_of(const std::vector<Known>& all, bool magnitude) {
    const auto n = static_cast<double>(all.size());
    // Sums differences from the first number, so that equal numbers give an error of exactly 0.
    const auto mean = [&](const auto& number) {
        double sum = 0;
        for (const Known& one : all) sum += number(one) - number(all[0]);
        return number(all[0]) + sum / n;
    };
    const auto error = [&](const auto& number) {
        const double middle = mean(number);
        double sum = 0;
        for (const Known& one : all) sum += std::pow(number(one) - middle, 2);
        return std::sqrt(sum / (n - 1) / n);
    };
    const auto value = [](const Known& one) { return one.value; };
    if (!magnitude)
        return {mean(value), mean([](const Known& one) { return one.lower; }),
                mean([](const Known& one) { return one.upper; }), error(value)};
    const auto square = [](const Known& one) { return one.value * one.value; };
    const double root = std::sqrt(mean(square));
    // Delta method: the error of the mean square divided by twice its root.
    return {root, root, root, root > 0 ? error(square) / (2 * root) : 0};
}

}  // namespace

std::optional<Known> known_under(const Set& set, const Key& key) {
    const std::string_view whole = key.key;
    const auto dot = whole.find('.');
    if (dot == std::string_view::npos) return std::nullopt;
    const std::string_view measure = whole.substr(0, dot);
    const bool magnitude = is_error_key(whole);
    std::vector<Known> all;
    const auto take = [&](const Report* found) {
        const auto known = known_in(found, whole.substr(dot + 1), magnitude);
        if (known) all.push_back(*known);
        return known.has_value();
    };
    if (!take(set.results(measure))) return std::nullopt;
    if (set.replications.empty() || key.better == Better::neither) return all[0];
    for (const Report& results : set.replications)
        if (!take(std::get_if<Report>(results.find(measure)))) return std::nullopt;
    return mean_of(all, magnitude);
}

std::vector<bool> best_of(std::span<const std::optional<Known>> values, Better better) {
    const std::vector<bool> none(values.size(), false);
    const auto there = std::ranges::count_if(values, [](const auto& v) { return v.has_value(); });
    if (better == Better::neither || there < 2) return none;
    const auto no_worse = [better](const Known& a, const Known& b) {
        return better == Better::lower ? a.most() <= b.least() : a.least() >= b.most();
    };
    std::vector<bool> best = none;
    for (std::size_t i = 0; i < values.size(); ++i)
        best[i] = values[i] && std::ranges::all_of(values, [&](const auto& other) {
                      return !other || &other == &values[i] || no_worse(*values[i], *other);
                  });
    return std::ranges::count(best, true) == there ? none : best;
}

std::vector<Row> compare_sets(std::span<const Set> sets) {
    const bool one_count = same_count(sets);
    const bool one_domain = same_domain(sets);
    std::vector<Row> rows;
    for (const Key& key : compared_keys()) {
        Row row{.key = key};
        for (const Set& set : sets) row.values.push_back(known_under(set, key));
        if (std::ranges::none_of(row.values, [](const auto& v) { return v.has_value(); })) continue;
        const bool fair = one_domain && (one_count || key.any_count);
        row.best = best_of(row.values, fair ? key.better : Better::neither);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string verdict_of(const Report& results) {
    const auto* word = std::get_if<std::string>(results.find("verdict"));
    return word == nullptr ? "" : *word;
}

std::string verdict_in_words(const Measure& measure) {
    const Planned* plan = planned(measure.name);
    if (plan == nullptr || !measure.results) return {};
    const ResultKey* result = find_result(*plan->analyzer, "verdict");
    if (result == nullptr) return {};
    for (const auto& [word, sentence] : result->sentences)
        if (word == verdict_of(*measure.results))
            return fmt::format(fmt::runtime(sentence), numbers_of_test(*measure.results));
    return {};
}

std::string shown_number(double value, std::string_view key) {
    if (value < least_probability && is_probability(key)) return "< 1e-16";
    if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
    return rounded(value, 4);
}

std::string shown_known(const Known& known, std::string_view key) {
    if (known.exact() && known.error > 0)
        return fmt::format("{} ±\u00a0{}", shown_number(known.value), rounded(known.error, 2));
    if (known.exact()) return shown_number(known.value, key);
    return fmt::format("{} to {}", shown_number(known.lower), shown_number(known.upper));
}

}  // namespace stipple::page
