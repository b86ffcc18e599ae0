// SPDX-License-Identifier: MIT
#include "page/content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "plot/drawing/ticks.hpp"
#include "report/document.hpp"

namespace stipple::page {

using plot::rounded;

namespace {

constexpr std::array keys = {
    Key{"star-discrepancy.value", "Star discrepancy", "Discrepancy"},
    Key{"extreme-discrepancy.value", "Extreme discrepancy", "Discrepancy"},
    Key{"periodic-discrepancy.value", "Periodic discrepancy", "Discrepancy"},
    Key{"l2-discrepancy.star.value", "L2 star", "L2 discrepancy"},
    Key{"l2-discrepancy.extreme.value", "L2 extreme", "L2 discrepancy"},
    Key{"l2-discrepancy.periodic.value", "L2 periodic", "L2 discrepancy"},
    Key{"l2-discrepancy.centered.value", "L2 centered", "L2 discrepancy"},
    Key{"l2-discrepancy.wraparound.value", "L2 wraparound", "L2 discrepancy"},
    Key{"l2-discrepancy.mixture.value", "L2 mixture", "L2 discrepancy"},
    Key{"l2-discrepancy.modified.value", "L2 modified", "L2 discrepancy"},
    Key{"l2-discrepancy.diaphony.value", "Diaphony", "L2 discrepancy"},
    Key{"dispersion.value", "Dispersion: largest empty box", "Gaps"},
    Key{"t-value.t", "t-value in base 2", "Gaps", Better::lower, false},
    Key{"nearest-neighbor.minimum", "Smallest distance", "Distances", Better::higher, false},
    Key{"nearest-neighbor.mean", "Mean nearest distance", "Distances", Better::higher, false},
    Key{"nearest-neighbor.relative_radius", "Relative radius", "Distances", Better::higher, true},
    Key{"nearest-neighbor.duplicates", "Duplicates", "Distances", Better::lower, true},
    Key{"periodogram.effective_nyquist", "Effective Nyquist frequency", "Spectrum", Better::higher,
        false},
    Key{"periodogram.relative_nyquist", "Relative Nyquist frequency", "Spectrum", Better::higher,
        true},
    Key{"periodogram.oscillation", "Oscillation", "Spectrum", Better::lower, true},
    Key{"integration.genz-gaussian.error", "Error of a smooth integrand", "Integration",
        Better::lower, false, true},
    Key{"integration.genz-continuous.error", "Error of an integrand with a kink", "Integration",
        Better::lower, false, true},
    Key{"integration.genz-discontinuous.error", "Error of an integrand with a jump", "Integration",
        Better::lower, false, true},
    Key{"chi-square.p_value", "χ² p‑value", "Uniformity", Better::neither, true},
    Key{"kolmogorov-smirnov.combined_p_value", "Kolmogorov–Smirnov p‑value", "Uniformity",
        Better::neither, true}};

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

std::string chi_square_words(const Report& found) {
    const std::string& verdict = found.text("verdict");
    const std::string numbers = fmt::format(
        "χ² = {} with {} degrees of freedom, {}", rounded(found.number("statistic")),
        rounded(found.number("degrees_of_freedom"), 12), probability(found.number("p_value")));
    if (verdict == "uniform")
        return fmt::format("The numbers of points in the cells are as expected by chance ({}).",
                           numbers);
    if (verdict == "stratified")
        return fmt::format(
            "The cells are filled more evenly than by independent points ({}): good for "
            "low-discrepancy and stratified sets.",
            numbers);
    return fmt::format("The points do not follow their domain's density ({}).", numbers);
}

std::string kolmogorov_words(const Report& found) {
    const std::string& verdict = found.text("verdict");
    const auto& statistic = found.curve("statistic");
    const auto worst = std::ranges::max_element(statistic);
    const std::string numbers =
        fmt::format("largest distance {}, on axis {}; {} over all axes", rounded(*worst),
                    worst - statistic.begin() + 1, probability(found.number("combined_p_value")));
    if (verdict == "uniform")
        return fmt::format("Each axis by itself looks like independent uniform numbers ({}).",
                           numbers);
    if (verdict == "stratified")
        return fmt::format("At least one axis is covered more evenly than by chance ({}).",
                           numbers);
    return fmt::format("At least one axis has a wrong density ({}).", numbers);
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

std::span<const Key> compared_keys() { return keys; }

namespace {

/// The number under a path of a measure's results, with its bounds; nullopt if there is none.
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
    std::vector<Known> all;
    const auto take = [&](const Report* found) {
        const auto known = known_in(found, whole.substr(dot + 1), key.magnitude);
        if (known) all.push_back(*known);
        return known.has_value();
    };
    if (!take(set.results(measure))) return std::nullopt;
    if (set.replications.empty() || key.better == Better::neither) return all[0];
    for (const Report& results : set.replications)
        if (!take(std::get_if<Report>(results.find(measure)))) return std::nullopt;
    return mean_of(all, key.magnitude);
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
    for (const Key& key : keys) {
        Row row{.key = key};
        for (const Set& set : sets) row.values.push_back(known_under(set, key));
        if (std::ranges::none_of(row.values, [](const auto& v) { return v.has_value(); })) continue;
        const bool fair = one_domain && (one_count || key.any_count);
        row.best = best_of(row.values, fair ? key.better : Better::neither);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string verdict_in_words(const Measure& measure) {
    if (!measure.results) return {};
    if (measure.name == "chi-square") return chi_square_words(*measure.results);
    if (measure.name == "kolmogorov-smirnov") return kolmogorov_words(*measure.results);
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
