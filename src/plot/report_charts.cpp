// SPDX-License-Identifier: MIT
#include "plot/report_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <set>

#include "analyzers/analyzer.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "plot/drawing/ticks.hpp"
#include "study/statistics.hpp"

namespace stipple::plot {
namespace {

using Curve = Report::Curve;
using Measurements = std::span<const Measurement>;

constexpr double log_above = 12;    ///< radial power with higher peaks gets a logarithmic axis
constexpr double log_floor = 1e-4;  ///< lowest power on a logarithmic axis; less is rounding error

std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// "halton.csv", "halton.csv, set 3", "10 sets: halton.csv"
std::string name_of_input(const Measurement& m, bool whole_path = false) {
    std::string name = m.source == "-" ? "" : whole_path ? m.source : file_name(m.source);
    if (m.set) name += fmt::format("{}set {}", name.empty() ? "" : ", ", *m.set);
    if (m.sets > 1) name = fmt::format("{} sets{}{}", m.sets, name.empty() ? "" : ": ", name);
    return name;
}

/// Distinct names for the inputs: file names without folders if they suffice, else whole paths.
std::vector<std::string> names_of_inputs(Measurements ms) {
    std::vector<std::string> names;
    for (const Measurement& m : ms) names.push_back(name_of_input(m));
    if (std::set(names.begin(), names.end()).size() == ms.size()) return names;
    for (std::size_t i = 0; i < ms.size(); ++i) {
        names[i] = name_of_input(ms[i], true);
        if (names[i].empty()) names[i] = fmt::format("input {}", i + 1);
    }
    return names;
}

/// Whether all measurements have the same value of `property`, a member or a function of them.
template <class Property>
bool alike(Measurements ms, const Property& property) {
    return std::ranges::all_of(ms, [&](const Measurement& m) {
        return std::invoke(property, m) == std::invoke(property, ms[0]);
    });
}

Curve plus(const Curve& a, const Curve& b, double sign) {
    Curve sum = a;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) sum[i] += sign * b[i];
    return sum;
}

/// Key of another list in a curve's group: "radial.cells" for the curve "radial.power".
std::string beside(const CurveKey& curve, std::string_view name) {
    return std::string(curve.key.substr(0, curve.key.rfind('.') + 1)).append(name);
}

/// Sets the band of a series: its standard error if known, or the report's lower and upper bounds.
void add_band(Series& series, const Measurement& m, const CurveKey& curve) {
    if (m.standard_error) {
        const auto error = list_at(*m.standard_error, curve.key);
        if (error && error->size() == series.y.size()) {
            series.low = plus(series.y, *error, -1);
            series.high = plus(series.y, *error, 1);
            return;
        }
    }
    if (last_part(curve.key) != "value") return;
    const auto low = list_at(m.results, beside(curve, "lower"));
    const auto high = list_at(m.results, beside(curve, "upper"));
    if (!low || !high || low == high || low->size() != series.y.size()) return;
    series.low = *low;
    series.high = *high;
}

/// Series for each measurement that has this curve.
std::vector<Series> series_of(Measurements ms, const CurveKey& curve) {
    const auto names = names_of_inputs(ms);
    std::vector<Series> found;
    for (std::size_t i = 0; i < ms.size(); ++i) {
        const auto xs = list_at(ms[i].results, curve.over);
        const auto ys = list_at(ms[i].results, curve.key);
        if (!xs || !ys || xs->empty() || xs->size() != ys->size()) continue;
        Series series{.name = names[i], .x = *xs, .y = *ys};
        series.measurement = i;
        add_band(series, ms[i], curve);
        found.push_back(std::move(series));
    }
    return found;
}

/// "n = 1024, d = 2": the numbers that all measurements have in common.
std::string size_of(Measurements ms) {
    const Measurement& first = ms[0];
    std::string text;
    if (alike(ms, &Measurement::count)) text = fmt::format("n = {}", first.count);
    if (alike(ms, &Measurement::dimension))
        text += fmt::format("{}d = {}", text.empty() ? "" : ", ", first.dimension);
    return text;
}

/// A chart titled "Radial power of halton.csv", with the number of points.
Chart titled(const std::string& what, Measurements ms) {
    const std::string name = name_of_input(ms[0]);
    return {.title = ms.size() > 1 || name.empty() ? what : fmt::format("{} of {}", what, name),
            .subtitle = size_of(ms)};
}

std::string noted(const std::string& subtitle, const std::string& more) {
    return subtitle.empty() ? more : more.empty() ? subtitle : subtitle + " · " + more;
}

/// Minimum and maximum of the finite numbers of all curves; (inf, -inf) if no number is finite.
std::pair<double, double> range_of(const std::vector<Series>& all) {
    std::pair range{HUGE_VAL, -HUGE_VAL};
    for (const Series& series : all)
        for (const double y : series.y)
            if (std::isfinite(y)) range = {std::min(range.first, y), std::max(range.second, y)};
    return range;
}

/// The band of white noise; empty if it differs between the measurements.
std::vector<Series> noise_band(Measurements ms, const CurveKey& curve) {
    const std::string key = beside(curve, "cells");
    const auto cells = list_at(ms[0].results, key);
    const bool same = alike(ms, &Measurement::sets) &&
                      alike(ms, [&](const Measurement& m) { return list_at(m.results, key); });
    if (!same || !cells) return {};
    Series band{.name = "white noise, 95 %", .x = *list_at(ms[0].results, curve.over)};
    for (const double ring : *cells) {
        const auto [low, high] = white_noise_band(ring, static_cast<double>(ms[0].sets));
        band.low.push_back(low);
        band.high.push_back(high);
    }
    return {band};
}

/// The anisotropy of independent points in dB: -10 log10 s for s averaged sets; for pair
/// differences s is multiplied by the expected number of pairs per pixel. Empty if it differs
/// between the measurements.
std::vector<Guide> noise_anisotropy(Measurements ms) {
    const auto expected_of = [](const Measurement& m) {
        const double pairs = number_at(m.results, "expected_differences").value_or(1);
        return -10 * std::log10(pairs * static_cast<double>(m.sets)) + 0.0;
    };
    if (!alike(ms, expected_of)) return {};
    const double expected = expected_of(ms[0]);
    return {{.name = fmt::format("white noise: {} dB", rounded(expected, 3)), .y = {expected}}};
}

/// Turns values of at most -100 dB into gaps. Analyzers report -100 dB for rings without power or
/// pairs of points, whose anisotropy is undefined, and for rings of equal powers.
void make_gaps(std::vector<Series>& all) {
    constexpr double least = -100;
    for (Series& series : all) {
        series.low = series.high = {};
        if (std::ranges::all_of(series.y, [](double y) { return !(y > least); })) continue;
        for (double& y : series.y)
            if (y <= least) y = std::numeric_limits<double>::quiet_NaN();
    }
}

bool holds(const Report& report, std::string_view key) {
    const bool* flag = std::get_if<bool>(report.find(key));
    return flag != nullptr && *flag;
}

/// Effective Nyquist frequency and oscillation of a single measurement; without the oscillation if
/// too few frequencies were measured for it.
std::string summary_of_spectrum(Measurements ms) {
    if (ms.size() > 1) return {};
    std::string text;
    const auto nyquist = number_at(ms[0].results, "effective_nyquist");
    const auto oscillation = number_at(ms[0].results, "oscillation");
    if (nyquist && std::isfinite(*nyquist))
        text += fmt::format("effective Nyquist frequency {}", rounded(*nyquist));
    if (oscillation && std::isfinite(*oscillation) && holds(ms[0].results, "oscillation_complete"))
        text += fmt::format("{}oscillation {}", text.empty() ? "" : ", ", rounded(*oscillation));
    return text;
}

/// Main results of a spectrum, with its window and its weights.
std::string notes_of_spectrum(Measurements ms) {
    std::string notes = summary_of_spectrum(ms);
    if (const std::string window = option_of(ms[0].options, "window");
        !window.empty() && window != "none")
        notes = noted(notes, "window " + window);
    if (const std::string weights = option_of(ms[0].options, "weights"); !weights.empty())
        notes = noted(notes, "weights " + weights);
    return notes;
}

// ---------------------------------------------------------------- curves of any analyzer

/// The analyzer that made a report; nullptr if this program has no analyzer of that name.
const Analyzer* analyzer_of(const Measurement& m) {
    const auto& all = analyzers::all();
    const auto at = std::ranges::find(all, m.analyzer, &Analyzer::name);
    return at == all.end() ? nullptr : &*at;
}

bool rises(const Curve& curve) {
    return std::ranges::adjacent_find(curve, [](double a, double b) { return !(a < b); }) ==
           curve.end();
}

/// Curves of the analyzer's record that the report contains. If `key` names another list in the
/// group of a curve, that list is added.
std::vector<CurveKey> curves_in(const Measurement& m, std::string_view key = {}) {
    std::vector<CurveKey> found;
    const Analyzer* analyzer = analyzer_of(m);
    if (analyzer == nullptr) return found;
    const auto add = [&](const CurveKey& curve) {
        const auto x = list_at(m.results, curve.over);
        const auto y = list_at(m.results, curve.key);
        if (x && y && x->size() == y->size() && x->size() > 1 && rises(*x) &&
            std::ranges::find(found, curve.key, &CurveKey::key) == found.end())
            found.push_back(curve);
    };
    for (const CurveKey& curve : analyzer->curves) add(curve);
    for (const CurveKey& curve : analyzer->curves)
        if (key != curve.over && key == beside(curve, last_part(key)))
            add({.key = key, .over = curve.over, .over_title = curve.over_title, .log = curve.log});
    return found;
}

/// Whether a curve's group has a list `name` of the same length.
bool has(const Report& results, const CurveKey& curve, std::string_view name) {
    const auto other = list_at(results, beside(curve, name));
    return other && other->size() == list_at(results, curve.over)->size();
}

/// Whether a curve is a bound of another curve.
bool is_bound(const CurveKey& curve, const Report& results) {
    const auto name = last_part(curve.key);
    return (name == "lower" || name == "upper") && has(results, curve, "value");
}

/// Reference lines: the curve's values for independent points.
std::vector<Guide> references(Measurements ms, const CurveKey& curve) {
    if (last_part(curve.key) == "anisotropy_db") return noise_anisotropy(ms);
    if (curve.reference.empty()) return {};
    if (const auto number = parse_number(curve.reference))
        return {{.name = "independent points", .y = {*number}}};
    const auto values = list_at(ms[0].results, curve.reference);
    if (!values) return {};
    return {{.name = fmt::format("independent points: the {}", curve.reference),
             .x = *list_at(ms[0].results, curve.over),
             .y = *values,
             .reached = true}};
}

/// Turns a curve of frequencies of small integers into bars centred on these integers.
void make_bars(ChartPanel& panel) {
    for (Series& series : panel.series) {
        const auto filled = [](double y) { return y > 0; };
        const auto first = std::ranges::find_if(series.y, filled);
        const auto last = std::find_if(series.y.rbegin(), series.y.rend(), filled).base();
        if (first == series.y.end()) continue;
        Bars bars{.name = series.name, .heights = {first, last}};
        const auto from = series.x.begin() + (first - series.y.begin());
        for (auto x = from; x != from + (last - first); ++x) bars.edges.push_back(*x - 0.5);
        bars.edges.push_back(bars.edges.back() + 1);
        panel.bars.push_back(std::move(bars));
    }
    panel.series.clear();
    panel.from_zero = true;
    panel.whole_x = true;
    panel.log_x = panel.log_y = false;
}

/// Name of the x axis, such as "radius"; with the unit if it is normalized.
std::string abscissa_of(const Measurement& m, const CurveKey& curve) {
    if (!curve.over_title.empty()) return std::string(curve.over_title);
    const std::string x(last_part(curve.over));
    if (option_of(m.options, "normalize-" + x) != "true") return words_of(x);
    return x + (x == "frequency" ? " / n^(1/d)" : " / mean distance");
}

/// Sets up the panel of radial power: reference, band of white noise, axes.
void make_power(ChartPanel& panel, Measurements ms, const CurveKey& curve) {
    panel.bands = noise_band(ms, curve);
    panel.guides = {{.y = {1}}};
    panel.reach_y = 1.4;
    panel.least_y = log_floor;
    panel.share = 1.5;
    const double top = range_of(panel.series).second;
    if (!std::isfinite(top)) panel.series.clear();
    panel.log_y = top > log_above;
}

/// Sets up the panel of pair correlation. A single measurement gets a band: two standard
/// deviations of the mean over as many sets of uniform points.
void make_pair_correlation(ChartPanel& panel, Measurements ms, const CurveKey& curve) {
    panel.y_name = "pair correlation g";
    panel.guides = {{.name = ms.size() > 1 ? "uniform points" : "", .y = {1}}};
    panel.reach_y = 1.4;
    if (ms.size() > 1) return;
    const double width = 2 / std::sqrt(static_cast<double>(ms[0].sets));
    Series band{.name = "uniform points, ± 2 deviations", .x = *list_at(ms[0].results, curve.over)};
    const auto deviation = list_at(ms[0].results, beside(curve, "deviation"));
    for (const double s : *deviation) {
        band.low.push_back(std::max(0.0, 1 - width * s));
        band.high.push_back(1 + width * s);
    }
    panel.bands.push_back(std::move(band));
}

ChartPanel curve_panel(Measurements ms, const CurveKey& curve) {
    const std::string y(last_part(curve.key));
    const Report& results = ms[0].results;
    ChartPanel panel{.x_name = abscissa_of(ms[0], curve),
                     .y_name = !curve.title.empty() ? std::string(curve.title)
                               : y == "value"       ? words_of(ms[0].analyzer)
                                                    : words_of(y),
                     .series = series_of(ms, curve),
                     .guides = references(ms, curve)};
    if (y == "anisotropy_db") {
        make_gaps(panel.series);
        if (!std::isfinite(range_of(panel.series).second)) panel.series.clear();
    }
    panel.from_zero = parse_number(curve.reference).has_value();
    if (panel.from_zero) panel.reach_y = 1.2;
    const bool power = curve.key.starts_with("radial.") && has(results, curve, "power") &&
                       has(results, curve, "cells");
    if (power && y == "power") make_power(panel, ms, curve);
    const bool pairs = y == "density" && has(results, curve, "deviation");
    if (pairs) make_pair_correlation(panel, ms, curve);
    if (power || pairs) return panel;
    panel.log_x = curve.log;
    // On a linear axis, a range of more than a decade would be illegible.
    const auto [low, high] = range_of(panel.series);
    panel.log_y = panel.log_x && (!panel.from_zero || high > 10 * low) && low > 0;
    for (Series& series : panel.series) series.marks = series.x.size() <= 40;
    const bool whole = std::holds_alternative<Report::Integers>(*results.find(curve.over));
    if (whole && panel.log_y && !panel.series.empty())
        panel.guides = falling_guides(panel.series[0]);
    if (whole && !curve.log && !panel.series.empty()) make_bars(panel);
    return panel;
}

bool wanted(Measurements ms, const CurveKey& curve, const std::string& key) {
    // In one dimension anisotropy has no meaning: each ring has two opposite frequencies of equal
    // power.
    const bool line = std::ranges::all_of(ms, [](const auto& m) { return m.dimension == 1; });
    if (key.empty())
        return !is_bound(curve, ms[0].results) &&
               !(line && last_part(curve.key) == "anisotropy_db");
    return key == curve.key || key + "." == beside(curve, "");
}

std::optional<Chart> curves_chart(Measurements ms, const std::string& key) {
    constexpr std::size_t most_panels = 4;
    const bool spectrum = list_at(ms[0].results, "radial.power").has_value();
    Chart chart = titled(spectrum ? "Power spectrum" : capitalised(words_of(ms[0].analyzer)), ms);
    if (spectrum) chart.subtitle = noted(chart.subtitle, notes_of_spectrum(ms));
    for (const CurveKey& curve : curves_in(ms[0], key)) {
        if (!wanted(ms, curve, key) || chart.panels.size() == most_panels) continue;
        ChartPanel panel = curve_panel(ms, curve);
        if (panel.series.empty() && panel.bars.empty()) continue;
        chart.panels.push_back(std::move(panel));
    }
    if (chart.panels.empty()) return std::nullopt;
    // Stacked panels share one x axis.
    for (ChartPanel& panel : chart.panels) panel.log_x = chart.panels.back().log_x;
    return chart;
}

// ---------------------------------------------------------------- indices with intervals

/// Adds a group's numbers as bars with intervals to the panel of the same kind, or to a new one.
void add_bars(std::vector<ChartPanel>& panels, const std::string& output, const std::string& label,
              const Report& group, const std::string& kind) {
    ChartPanel* panel = nullptr;
    for (const auto& entry : group.entries()) {
        const std::string& name = entry.name;
        const auto number = number_at(group, name);
        if (!number || name.ends_with("_low") || name.ends_with("_high")) continue;
        if (!kind.empty() && name != kind) continue;
        if (panel == nullptr) {
            const auto same = std::ranges::find_if(
                panels, [&](const ChartPanel& p) { return p.series[0].name == words_of(name); });
            panel = same == panels.end()
                        ? &panels.emplace_back(ChartPanel{.x_name = "", .y_name = output})
                        : &*same;
            panel->categories.push_back(label);
            panel->from_zero = true;
        }
        auto at = std::ranges::find(panel->series, words_of(name), &Series::name);
        if (at == panel->series.end())
            at = panel->series.insert(at, Series{.name = words_of(name)});
        at->x.push_back(static_cast<double>(panel->categories.size()));
        at->y.push_back(*number);
        at->low.push_back(number_at(group, name + "_low").value_or(NAN));
        at->high.push_back(number_at(group, name + "_high").value_or(NAN));
    }
}

/// Keeps the 16 categories in which the last series is largest, in their order, and adds the number
/// of all categories to the x axis.
void keep_largest(ChartPanel& panel) {
    constexpr std::size_t most = 16;
    const std::size_t all = panel.categories.size();
    if (all <= most) return;
    std::vector<std::size_t> order(all);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const Curve& sizes = panel.series.back().y;
    std::ranges::stable_sort(order, std::greater(),
                             [&](std::size_t c) { return std::abs(sizes[c]); });
    order.resize(most);
    std::ranges::sort(order);
    const auto picked = [&](const auto& from) {
        auto kept = from;
        kept.clear();
        for (const std::size_t c : order) kept.push_back(from[c]);
        return kept;
    };
    for (Series& series : panel.series) {
        series.x.resize(most);  // keeps x = 1, 2, ...
        for (Curve* values : {&series.y, &series.low, &series.high}) *values = picked(*values);
    }
    panel.categories = picked(panel.categories);
    panel.x_name = fmt::format("the largest {} of {}", most, all);
}

/// Bars of the indices of inputs and of pairs of inputs, for each output. The key selects an
/// output, a kind of index, or both: "y", "total", "y.total".
Chart indices_chart(Measurements ms, const std::string& key) {
    constexpr std::size_t most_panels = 4;
    Chart chart = titled(capitalised(words_of(ms[0].analyzer)), ms);
    chart.subtitle = fmt::format("{} runs", ms[0].count);
    chart.own_x = true;
    for (const auto& [output, value, unit] : ms[0].results.entries()) {
        const auto* group = std::get_if<Report>(&value);
        if (group == nullptr) continue;
        const bool named = key == output || key.starts_with(output + ".");
        const std::string kind = !named ? key : key.substr(std::min(key.size(), output.size() + 1));
        std::vector<ChartPanel> panels;
        for (const auto& entry : group->entries())
            if (const auto* own = std::get_if<Report>(&entry.value))
                add_bars(panels, output, entry.name, *own, kind);
        for (ChartPanel& panel : panels) {
            if (panel.series.size() == 1) panel.y_name += ", " + panel.series[0].name;
            keep_largest(panel);
            if (chart.panels.size() < most_panels) chart.panels.push_back(std::move(panel));
        }
    }
    if (chart.panels.empty())
        fail_with_hint(ErrorKind::usage, "known: " + join(ms[0].results.keys(), ", "),
                       "--key: the report of {} has no output or index '{}'", ms[0].analyzer, key);
    return chart;
}

// ---------------------------------------------------------------- one number over many reports

/// Key of the result that represents a report: "value", or the first number.
std::string main_number(const Report& report) {
    if (number_at(report, "value")) return "value";
    for (const std::string& key : report.keys())
        if (number_at(report, key)) return key;
    return {};
}

/// Whether a word in a file name is a count or a seed: 64, n64, seed3.
bool is_counter(std::string_view word) {
    constexpr std::array<std::string_view, 8> known = {"",  "n",    "m",   "s",
                                                       "r", "seed", "set", "run"};
    const std::string_view letters = word.substr(0, word.find_first_of("0123456789"));
    return letters.size() < word.size() && std::ranges::find(known, letters) != known.end() &&
           word.find_first_not_of("0123456789", letters.size()) == std::string_view::npos;
}

/// Common name of a family of files, without counts and seeds: "pmj02_64.csv" with 64 points,
/// "pmj02_256_s3.csv" and "pmj02-16.csv" give "pmj02"; "random64.csv" with 64 points gives
/// "random".
std::string family_of(const Measurement& m) {
    std::string name = file_name(m.source);
    name.resize(std::min(name.find('.'), name.size()));
    const std::string count = std::to_string(m.count);
    std::string family;
    for (std::size_t at = 0; at < name.size();) {
        const std::size_t end = std::min(name.find_first_of("-_ ", at), name.size());
        std::string_view word = std::string_view(name).substr(at, end - at);
        const bool counter = is_counter(word);
        if (word.ends_with(count)) word.remove_suffix(count.size());
        if (!word.empty() && !counter) {
            if (!family.empty()) family += name[at - 1];
            family += word;
        }
        at = end + 1;
    }
    return family;
}

/// One value per set size: the mean with its standard error, or the root mean square if `errors`.
Series series_over_count(const std::string& name, bool errors,
                         const std::map<std::uint64_t, std::vector<double>>& at) {
    Series series{.name = name, .marks = true};
    for (const auto& [n, values] : at) {
        const SampleSummary sample = summarize(values);
        const double mean = errors ? root_mean_square(values) : sample.mean;
        const double spread = errors || sample.count < 2 ? 0 : sample.standard_error;
        series.x.push_back(static_cast<double>(n));
        series.y.push_back(mean);
        series.low.push_back(mean - spread);
        series.high.push_back(mean + spread);
    }
    if (series.low == series.high) series.low = series.high = {};
    return series;
}

Chart number_over_count(Measurements ms, const std::string& key) {
    const bool errors = key == "error" || key.ends_with(".error");
    std::vector<std::string> families;
    std::map<std::string, std::map<std::uint64_t, std::vector<double>>> found;
    for (const Measurement& m : ms) {
        const auto value = number_at(m.results, key);
        if (!value || !std::isfinite(*value)) continue;
        const std::string family = family_of(m);
        if (!found.contains(family)) families.push_back(family);
        found[family][m.count].push_back(*value);
    }
    ChartPanel panel{.x_name = "points n",
                     .y_name = key == "value" ? words_of(ms[0].analyzer) : words_of(key),
                     .log_x = true};
    if (errors) panel.y_name += ", root mean square";
    for (const std::string& family : families)
        panel.series.push_back(series_over_count(family, errors, found[family]));
    panel.log_y = range_of(panel.series).first > 0;
    if (panel.log_y) panel.guides = falling_guides(panel.series[0]);
    for (Series& series : panel.series) name_slope(series);
    Chart chart = titled(capitalised(words_of(ms[0].analyzer)), ms);
    chart.panels.push_back(std::move(panel));
    return chart;
}

Chart number_histogram(Measurements ms, const std::string& key, bool log) {
    ChartPanel panel{.x_name = key == "value" ? words_of(ms[0].analyzer) : words_of(key),
                     .y_name = "sets",
                     .log_x = log,
                     .from_zero = true};
    std::vector<std::vector<double>> all(1);
    std::vector<double>& values = all[0];
    for (const Measurement& m : ms)
        if (const auto value = number_at(m.results, key); value && std::isfinite(*value))
            values.push_back(*value);
    const std::size_t sets = values.size();
    double size = 0;
    for (const double value : values) size = std::max(size, std::abs(value));
    // Numbers that an axis would show as 0 are multiplied by 10^300.
    if (size > 0 && size < least_shown) {
        for (double& value : values) value /= least_shown;
        panel.x_name += fmt::format(" (×{})", power_of_ten(-300));
    }
    const auto [low, high] = std::ranges::minmax(values);
    require_shown(low, high);
    std::pair shown(low, high);
    if (log) shown = keep_positive(all, panel);
    panel.whole_x = are_whole(values);
    if (!log && !panel.whole_x) shown = visible_range(low, high);
    // Sturges' rule for the bin width, suitable for about ten to some thousand values.
    const auto bins =
        static_cast<std::size_t>(std::ceil(std::log2(static_cast<double>(values.size())))) + 3;
    Bars bars = (panel.whole_x ? whole_histogram : histogram_of)(values, shown.first, shown.second,
                                                                 bins, log);
    for (std::size_t i = 0; i < bars.heights.size(); ++i) {
        const double left = bars.edges[i];
        const double right = bars.edges[i + 1];
        bars.heights[i] = std::round(bars.heights[i] * static_cast<double>(values.size()) *
                                     (log ? std::log(right / left) : right - left));
    }
    Chart chart = titled(capitalised(words_of(ms[0].analyzer)), ms);
    chart.subtitle = noted(chart.subtitle, fmt::format("{} sets", sets));
    panel.bars.push_back(std::move(bars));
    if (values.size() <= 100) panel.rug = values;
    chart.panels.push_back(std::move(panel));
    return chart;
}

/// Keys of the results that can be drawn.
std::vector<std::string> drawable(Measurements ms) {
    std::vector<std::string> keys;
    for (const CurveKey& curve : curves_in(ms[0]))
        if (!is_bound(curve, ms[0].results)) keys.emplace_back(curve.key);
    if (ms.size() == 1) return keys;
    for (const std::string& key : ms[0].results.keys())
        if (number_at(ms[0].results, key)) keys.push_back(key);
    return keys;
}

[[noreturn]] void refuse(Measurements ms, const std::string& key) {
    const auto keys = drawable(ms);
    if (!key.empty() && !keys.empty())
        fail_with_hint(ErrorKind::usage, "known: " + join(keys, ", "),
                       "--key: the report of {} has no '{}' to draw", ms[0].analyzer, key);
    fail_with_hint(ErrorKind::input,
                   "curves can be drawn (periodogram, pair-correlation, star-discrepancy --every), "
                   "and one number over several reports",
                   "a single report of {} has only numbers, nothing to draw", ms[0].analyzer);
}

}  // namespace

std::string option_of(const std::vector<std::pair<std::string, std::string>>& options,
                      std::string_view name) {
    const auto at = std::ranges::find(options, name, &std::pair<std::string, std::string>::first);
    return at == options.end() ? "" : at->second;
}

std::pair<double, double> white_noise_band(double cells, double sets) {
    const double spread = 2 / (9 * std::max(1.0, cells * sets));
    const auto point = [spread](double z) {
        const double root = std::max(0.0, 1 - spread + z * std::sqrt(spread));
        return root * root * root;
    };
    return {point(-1.96), point(1.96)};
}

Chart chart_of(Measurements ms, const std::string& key, bool log_x) {
    for (const Measurement& m : ms)
        if (m.analyzer != ms[0].analyzer)
            fail(ErrorKind::input,
                 "reports of different analyzers, {} and {}, cannot be drawn in one picture",
                 ms[0].analyzer, m.analyzer);
    if (auto chart = curves_chart(ms, key)) return *std::move(chart);
    const Analyzer* analyzer = analyzer_of(ms[0]);
    const bool indices =
        analyzer != nullptr && std::ranges::any_of(analyzer->results, [](const ResultKey& result) {
            return free_parts(result) == 2;
        });
    if (ms.size() == 1 && indices) return indices_chart(ms, key);
    if (ms.size() == 1) refuse(ms, key);
    const std::string number = key.empty() ? main_number(ms[0].results) : key;
    const auto has_number = [&](const Measurement& m) {
        const auto value = number_at(m.results, number);
        return value && std::isfinite(*value);
    };
    if (std::ranges::count_if(ms, has_number) < 2) refuse(ms, key);
    return alike(ms, &Measurement::count) ? number_histogram(ms, number, log_x)
                                          : number_over_count(ms, number);
}

}  // namespace stipple::plot
