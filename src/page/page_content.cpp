// SPDX-License-Identifier: MIT
#include "page/page_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "plot/report_charts.hpp"
#include "plot/ticks.hpp"

namespace stipple {
namespace {

constexpr std::array keys = {
    PageKey{"star-discrepancy.value", "Star discrepancy", "Discrepancy"},
    PageKey{"extreme-discrepancy.value", "Extreme discrepancy", "Discrepancy"},
    PageKey{"periodic-discrepancy.value", "Periodic discrepancy", "Discrepancy"},
    PageKey{"l2-discrepancy.star.value", "L2 star", "L2 discrepancy"},
    PageKey{"l2-discrepancy.extreme.value", "L2 extreme", "L2 discrepancy"},
    PageKey{"l2-discrepancy.periodic.value", "L2 periodic", "L2 discrepancy"},
    PageKey{"l2-discrepancy.centered.value", "L2 centered", "L2 discrepancy"},
    PageKey{"l2-discrepancy.wraparound.value", "L2 wraparound", "L2 discrepancy"},
    PageKey{"l2-discrepancy.mixture.value", "L2 mixture", "L2 discrepancy"},
    PageKey{"l2-discrepancy.modified.value", "L2 modified", "L2 discrepancy"},
    PageKey{"l2-discrepancy.diaphony.value", "Diaphony", "L2 discrepancy"},
    PageKey{"dispersion.value", "Dispersion: largest empty box", "Gaps"},
    PageKey{"t-value.t", "t-value in base 2", "Gaps", Better::lower, false},
    PageKey{"nearest-neighbor.minimum", "Smallest distance", "Distances", Better::higher, false},
    PageKey{"nearest-neighbor.mean", "Mean nearest distance", "Distances", Better::higher, false},
    PageKey{"nearest-neighbor.relative_radius", "Relative radius", "Distances", Better::higher,
            true},
    PageKey{"nearest-neighbor.duplicates", "Duplicates", "Distances", Better::lower, true},
    PageKey{"periodogram.effective_nyquist", "Effective Nyquist frequency", "Spectrum",
            Better::higher, false},
    PageKey{"periodogram.relative_nyquist", "Relative Nyquist frequency", "Spectrum",
            Better::higher, true},
    PageKey{"periodogram.oscillation", "Oscillation", "Spectrum", Better::lower, true},
    PageKey{"chi-square.p_value", "χ² p-value", "Uniformity", Better::neither, true},
    PageKey{"kolmogorov-smirnov.combined_p_value", "Kolmogorov–Smirnov p-value", "Uniformity",
            Better::neither, true}};

std::string word_at(const Report& report, std::string_view key) {
    const Report::Item* item = report.find(key);
    const auto* word = item == nullptr ? nullptr : std::get_if<std::string>(item);
    return word == nullptr ? "" : *word;
}

/// The p-value of the tail that decided.
std::string probability(double p) {
    return p < 1e-300 ? "p below 10⁻³⁰⁰" : fmt::format("p = {}", rounded(p, 2));
}

std::string chi_square_words(const Report& found) {
    const std::string verdict = word_at(found, "verdict");
    const std::string numbers =
        fmt::format("χ² = {} with {} degrees of freedom, {}",
                    rounded(number_at(found, "statistic").value_or(0)),
                    rounded(number_at(found, "degrees_of_freedom").value_or(0), 12),
                    probability(number_at(found, "p_value").value_or(1)));
    if (verdict == "uniform")
        return fmt::format("Cells hold as many points as chance would put there ({}).", numbers);
    if (verdict == "stratified")
        return fmt::format(
            "Cells are filled more evenly than independent points fill them ({}): good news for "
            "low-discrepancy and stratified sets.",
            numbers);
    return fmt::format("The points do not follow their domain's density ({}).", numbers);
}

std::string kolmogorov_words(const Report& found) {
    const std::string verdict = word_at(found, "verdict");
    const auto& statistic = found.curve("statistic");
    const auto worst = std::ranges::max_element(statistic) - statistic.begin();
    const std::string numbers =
        fmt::format("largest distance {}, on axis {}; {} over all axes",
                    rounded(statistic.empty() ? 0 : statistic[static_cast<std::size_t>(worst)]),
                    worst + 1, probability(number_at(found, "combined_p_value").value_or(1)));
    if (verdict == "uniform")
        return fmt::format("Each axis on its own looks like independent uniform numbers ({}).",
                           numbers);
    if (verdict == "stratified")
        return fmt::format("At least one axis is covered more evenly than by chance ({}).",
                           numbers);
    return fmt::format("At least one axis has a wrong density ({}).", numbers);
}

/// What may be said for sure, in the sense that larger is better.
struct Rank {
    double least;
    double most;
};

Rank rank_of(const Known& known, Better better) {
    if (better == Better::lower) return {-known.upper, -known.lower};
    return {known.lower, known.upper};
}

}  // namespace

const Report* PageSet::results(std::string_view measure) const {
    const auto it = std::ranges::find(measures, measure, &PageMeasure::name);
    return it == measures.end() || !it->results ? nullptr : &*it->results;
}

Report PageSet::all_results() const {
    Report all;
    for (const PageMeasure& measure : measures)
        if (measure.results) all.add(measure.name, *measure.results);
    return all;
}

std::span<const PageKey> page_keys() { return keys; }

std::optional<Known> known_under(const PageSet& set, std::string_view key) {
    const auto dot = key.find('.');
    const Report* found = set.results(key.substr(0, dot));
    if (found == nullptr || dot == std::string_view::npos) return std::nullopt;
    const std::string path(key.substr(dot + 1));
    const auto value = number_at(*found, path);
    if (!value || std::isnan(*value)) return std::nullopt;
    Known known{*value, *value, *value};
    if (path != "value") return known;
    known.lower = number_at(*found, "lower").value_or(*value);
    known.upper = number_at(*found, "upper").value_or(*value);
    return known;
}

std::vector<bool> best_of(std::span<const std::optional<Known>> values, Better better) {
    std::vector<bool> best(values.size(), false);
    if (better == Better::neither ||
        std::ranges::count_if(values, [](const auto& v) { return v.has_value(); }) < 2)
        return best;
    for (std::size_t i = 0; i < values.size(); ++i)
        best[i] = values[i] && std::ranges::all_of(values, [&](const auto& other) {
                      if (!other || &other == &values[i]) return true;
                      return rank_of(*values[i], better).least >= rank_of(*other, better).most;
                  });
    const auto differs = [&](std::size_t i) { return values[i] && !best[i]; };
    for (std::size_t i = 0; i < values.size(); ++i)
        if (differs(i)) return best;
    return std::vector<bool>(values.size(), false);
}

std::vector<PageRow> compare_sets(std::span<const PageSet> sets) {
    const bool one_count = std::ranges::all_of(
        sets, [&](const PageSet& set) { return set.count == sets.front().count; });
    const bool one_domain = std::ranges::all_of(
        sets, [&](const PageSet& set) { return set.domain == sets.front().domain; });
    std::vector<PageRow> rows;
    for (const PageKey& key : keys) {
        PageRow row{.key = key, .values = {}, .best = {}};
        for (const PageSet& set : sets) row.values.push_back(known_under(set, key.key));
        if (std::ranges::none_of(row.values, [](const auto& v) { return v.has_value(); })) continue;
        const bool fair = one_domain && (one_count || key.any_count);
        row.best = best_of(row.values, fair ? key.better : Better::neither);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string verdict_in_words(const PageMeasure& measure) {
    if (!measure.results) return {};
    if (measure.name == "chi-square") return chi_square_words(*measure.results);
    if (measure.name == "kolmogorov-smirnov") return kolmogorov_words(*measure.results);
    return {};
}

std::string shown_number(double value) {
    if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
    return rounded(value, 4);
}

std::string shown_known(const Known& known) {
    if (known.exact()) return shown_number(known.value);
    return fmt::format("{} to {}", shown_number(known.lower), shown_number(known.upper));
}

}  // namespace stipple
