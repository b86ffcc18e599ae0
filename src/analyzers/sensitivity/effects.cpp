// SPDX-License-Identifier: MIT
#include "analyzers/sensitivity/effects.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/domain.hpp"
#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "math/functions/normal_distribution.hpp"

namespace stipple::analyzers::sensitivity {

double Centred::variance() const {
    double sum = 0;
    for (const double value : z) sum += value * value;
    return sum / static_cast<double>(z.size());
}

Centred centred(std::span<const double> y, const std::string& name) {
    Centred out{.z = {y.begin(), y.end()}};
    for (const double value : y) out.mean += value / static_cast<double>(y.size());
    double largest = 0;
    for (double& value : out.z) {
        value -= out.mean;
        largest = std::max(largest, std::abs(value));
    }
    constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
    if (!(largest > rounding * std::abs(out.mean)))
        fail(ErrorKind::input, "the output {} is constant: {} in all runs; it has no variance",
             name, format_number(y.front()));
    for (double& value : out.z) value /= largest;
    out.unit = largest;
    return out;
}

std::vector<std::size_t> succeeded(std::span<const double> y) {
    std::vector<std::size_t> runs;
    for (std::size_t i = 0; i < y.size(); ++i)
        if (!std::isnan(y[i])) runs.push_back(i);
    return runs;
}

std::vector<double> picked(std::span<const double> y, std::span<const std::size_t> runs) {
    std::vector<double> values;
    values.reserve(runs.size());
    for (const std::size_t i : runs) values.push_back(y[i]);
    return values;
}

std::vector<std::size_t> complete_groups(std::span<const double> y, std::size_t group) {
    std::vector<std::size_t> complete;
    for (std::size_t g = 0; (g + 1) * group <= y.size(); ++g)
        if (std::ranges::none_of(y.subspan(g * group, group), [](double v) { return v != v; }))
            complete.push_back(g);
    return complete;
}

Index normal_interval(double value, double standard_error, double level) {
    const double reach = normal_quantile(0.5 + level / 2) * standard_error;
    return {value, value - reach, value + reach};
}

namespace {

/// The box that the provenance says the inputs lie in, if all do.
std::optional<Box> box_of(const Inputs& inputs) {
    const std::string& domain = inputs.values.provenance.domain;
    const std::size_t k = inputs.size();
    Box box{std::vector(k, 0.0), std::vector(k, 1.0)};
    if (domain.starts_with("box")) {
        const Spec spec = parse_spec(domain);
        if (spec.settings.empty()) return std::nullopt;
        box = parse_box(spec.settings[0].second, k);
    } else if (domain != "unit-cube" && !domain.empty()) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < inputs.runs(); ++i)
        for (std::size_t j = 0; j < k; ++j)
            if (const double x = inputs.values[i][j]; !(x >= box.low[j] && x <= box.high[j]))
                return std::nullopt;
    return box;
}

/// (rank - 1/2) / n of each value of column j; equal values have the mean of their ranks.
void put_ranks(const PointSet& values, std::size_t j, std::span<double> u) {
    const std::size_t n = values.count();
    const std::size_t k = values.dimension();
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto at = [&](std::size_t i) { return values.flat()[i * k + j]; };
    std::ranges::stable_sort(order, {}, at);
    for (std::size_t first = 0, last = 0; first < n; first = last) {
        while (last < n && at(order[last]) == at(order[first])) ++last;
        const double middle = static_cast<double>(first + last) / 2 / static_cast<double>(n);
        for (std::size_t r = first; r < last; ++r) u[order[r] * k + j] = middle;
    }
}

}  // namespace

UnitInputs unit_inputs(const Inputs& inputs, bool ranks) {
    const auto flat = inputs.values.flat();
    const std::size_t k = inputs.size();
    UnitInputs out{.u = {flat.begin(), flat.end()}, .scale = "range"};
    const auto known = box_of(inputs);
    if (known || !ranks) {
        const Box box = known ? *known : bounding_box(flat, k);
        const bool cube = known && !inputs.values.provenance.domain.starts_with("box");
        if (known) out.scale = cube ? "cube" : "box";
        for (std::size_t i = 0; i < out.u.size() && !cube; ++i)
            out.u[i] =
                box.extent(i % k) > 0 ? (out.u[i] - box.low[i % k]) / box.extent(i % k) : 0.5;
    }
    if (!ranks) return out;
    std::vector<double> ranked(out.u.size());
    for (std::size_t j = 0; j < k; ++j) put_ranks(inputs.values, j, ranked);
    constexpr double critical = 1.63;  // of Kolmogorov and Smirnov's statistic, at 1 %
    const double most = critical / std::sqrt(static_cast<double>(inputs.runs()));
    const bool uniform = std::ranges::equal(
        out.u, ranked, [most](double u, double rank) { return std::abs(u - rank) <= most; });
    return known && uniform ? out : UnitInputs{.u = std::move(ranked), .scale = "ranks"};
}

}  // namespace stipple::analyzers::sensitivity
