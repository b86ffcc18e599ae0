// SPDX-License-Identifier: MIT
#include "report/average.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "math/functions/powers.hpp"

namespace stipple {
namespace {

using Curve = Report::Curve;
using Item = Report::Item;

/// The numbers in an item; nullopt for texts, flags and groups.
std::optional<Curve> numbers(const Item& item) {
    if (const auto* whole = std::get_if<std::int64_t>(&item))
        return Curve{static_cast<double>(*whole)};
    if (const auto* number = std::get_if<double>(&item)) return Curve{*number};
    if (const auto* list = std::get_if<Report::Integers>(&item))
        return Curve(list->begin(), list->end());
    if (const auto* curve = std::get_if<Curve>(&item)) return *curve;
    if (const auto* grid = std::get_if<Grid>(&item)) return grid->values;
    return std::nullopt;
}

/// Numbers as an item of the same type as `like`: a number, a curve or a grid.
Item shaped(Curve values, const Item& like) {
    if (const auto* grid = std::get_if<Grid>(&like))
        return Grid{grid->rows, grid->columns, std::move(values)};
    if (std::holds_alternative<Curve>(like) || std::holds_alternative<Report::Integers>(like))
        return values;
    return values.front();
}

/// Adds a product of steps to a sum of squares in units of `unit`, a power of two near the largest
/// value: squares of tiny and huge numbers leave float64.
void add_square(double& sum, double& unit, double value, double step, double rest) {
    const double own = value == 0 ? 0 : unit_for(std::abs(value));
    if (own > unit) {
        sum *= unit / own * (unit / own);
        unit = own;
    }
    if (step != 0) sum += step / unit * (rest / unit);
}

/// Merges an entry of the k-th report into its running mean; returns false to omit the entry.
bool merge(Item& mean, Item& squares, const Item& item, double k);

void merge_groups(Report& mean, Report& squares, const Report& report, double k) {
    auto& means = mean.entries();
    auto& sums = squares.entries();
    for (std::size_t i = 0; i < means.size();) {
        const Item* item = report.find(means[i].name);
        if (item && merge(means[i].value, sums[i].value, *item, k)) {
            ++i;
            continue;
        }
        means.erase(means.begin() + static_cast<std::ptrdiff_t>(i));
        sums.erase(sums.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

bool merge(Item& mean, Item& squares, const Item& item, double k) {
    if (auto* group = std::get_if<Report>(&mean)) {
        const auto* other = std::get_if<Report>(&item);
        if (other) merge_groups(*group, std::get<Report>(squares), *other, k);
        return other != nullptr;
    }
    const auto values = numbers(item);
    auto means = numbers(mean);
    if (!values || !means) return mean == item;
    if (values->size() != means->size()) return false;
    if (k == 1) squares = Curve(std::holds_alternative<Grid>(item) ? 0 : 2 * values->size());
    auto& sums = std::get<Curve>(squares);
    for (std::size_t i = 0; i < values->size(); ++i) {
        const double step = k == 1 ? 0 : (*values)[i] - (*means)[i];
        if (k > 1) (*means)[i] += step / k;
        if (sums.empty()) continue;
        add_square(sums[2 * i], sums[2 * i + 1], (*values)[i], step, (*values)[i] - (*means)[i]);
    }
    // Labels, such as the counts of prefixes, are not averaged.
    const bool label = std::holds_alternative<Report::Integers>(mean) && mean == item;
    if (!label) mean = shaped(std::move(*means), item);
    return true;
}

/// Whether a result has no meaningful standard error: exact values, errors and p-values, which are
/// not measured per set; and results that an analyzer recomputes from mean curves, so that their
/// error is not that of a mean. Examples are decibels, whose scatter does not decrease with the
/// number of sets, thresholds, which depend on the slope of a curve, and sums of deviations from 1,
/// which decrease with the number of sets.
bool is_no_mean(std::string_view name) {
    constexpr std::array names = {"exact",
                                  "standard_error",
                                  "exponent_standard_error",
                                  "combined_p_value",
                                  "p_value",
                                  "p_upper",
                                  "p_lower",
                                  "anisotropy_db",
                                  "expected_anisotropy_db",
                                  "effective_nyquist",
                                  "relative_nyquist",
                                  "oscillation",
                                  "total_variation",
                                  "low_frequency_exponent"};
    return std::ranges::find(names, name) != names.end();
}

/// Standard errors of the entries of `mean`: sqrt(`squares` / `divisor`), entry by entry.
Report errors_of(const Report& mean, const Report& squares, double divisor) {
    Report out;
    for (const auto& [name, value, unit] : squares.entries()) {
        const Item* item = mean.find(name);
        const bool label = item && std::holds_alternative<Report::Integers>(*item);
        if (item == nullptr || label || is_no_mean(name)) continue;
        const auto* group = std::get_if<Report>(&value);
        const auto* means = std::get_if<Report>(item);
        if (group && means) {
            Report part = errors_of(*means, *group, divisor);
            if (!part.entries().empty()) out.add(name, std::move(part));
        } else if (const auto* sums = std::get_if<Curve>(&value); sums && !sums->empty()) {
            Curve errors;
            for (std::size_t i = 0; i < sums->size(); i += 2)
                errors.push_back((*sums)[i + 1] * std::sqrt((*sums)[i] / divisor));
            out.entries().push_back({name, shaped(std::move(errors), *item), unit});
        }
    }
    return out;
}

}  // namespace

void ReportAverage::add(const Report& report) {
    if (++count_ == 1) mean_ = squares_ = report;
    merge_groups(mean_, squares_, report, static_cast<double>(count_));
}

Report ReportAverage::standard_error(const Report& mean) const {
    if (count_ < 2) return {};
    const auto k = static_cast<double>(count_);
    return errors_of(mean, squares_, k * (k - 1));
}

Report numbers_only(const Report& report) {
    Report out;
    for (const auto& entry : report.entries()) {
        const auto& [name, value, unit] = entry;
        if (const auto* group = std::get_if<Report>(&value))
            out.add(name, numbers_only(*group));
        else if (std::holds_alternative<double>(value) ||
                 std::holds_alternative<std::int64_t>(value))
            out.entries().push_back(entry);
    }
    return out;
}

}  // namespace stipple
