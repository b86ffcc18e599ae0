// SPDX-License-Identifier: MIT
#include "analyzers/sensitivity/effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/domain.hpp"
#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "math/functions/distributions.hpp"

namespace stipple::analyzers::sensitivity {

double Centred::variance() const {
    double sum = 0;
    for (const double value : z) sum += value * value;
    return sum / static_cast<double>(z.size());
}

bool is_constant(std::span<const double> y) {
    if (y.empty()) return true;
    const auto [low, high] = std::ranges::minmax(y);
    constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
    return high / 2 - low / 2 <= rounding * std::max(std::abs(low), std::abs(high)) / 2;
}

Centred centred(std::span<const double> y) {
    const auto [low, high] = std::ranges::minmax(y);
    const double largest = std::max(std::abs(low), std::abs(high));
    if (!(largest > 0)) return {.z = {y.begin(), y.end()}};
    // Sums of differences from the middle are exact to the last bits of these, not of the numbers.
    const double middle = low / 2 + high / 2;
    const double reach = std::max(high / 2 - low / 2, std::numeric_limits<double>::min());
    Centred out{.z = {y.begin(), y.end()}, .unit = reach};
    double mean = 0;
    for (double& value : out.z) {
        value = (value / 2 - middle / 2) / (reach / 2);
        mean += value / static_cast<double>(y.size());
    }
    double most = 0;
    for (double& value : out.z) {
        value -= mean;
        most = std::max(most, std::abs(value));
    }
    if (!(most > 0)) return out;
    for (double& value : out.z) value /= most;
    out.mean = middle + mean * reach;
    out.unit = reach * most;
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

std::string too_few_for_intervals(std::size_t count, std::size_t least, const char* of_what) {
    if (count >= least) return {};
    return fmt::format("{} {}; intervals need {}", count, of_what, least);
}

double interval_quantile(double level, std::size_t freedom) {
    return student_quantile((1 - level) / 2, static_cast<double>(freedom));
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

std::vector<double> ranks_of(const PointSet& points) {
    std::vector<double> ranks(points.flat().size());
    for (std::size_t j = 0; j < points.dimension(); ++j) put_ranks(points, j, ranks);
    return ranks;
}

bool distributions_are_known(const Inputs& inputs) {
    const Provenance& told = inputs.values.provenance;
    return (!told.generator.empty() || told.domain.starts_with("box")) && box_of(inputs);
}

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
    std::vector<double> ranked = ranks_of(inputs.values);
    constexpr double critical = 1.63;  // of Kolmogorov and Smirnov's statistic, at 1 %
    const double most = critical / std::sqrt(static_cast<double>(inputs.runs()));
    const bool uniform = std::ranges::equal(
        out.u, ranked, [most](double u, double rank) { return std::abs(u - rank) <= most; });
    return known && uniform ? out : UnitInputs{.u = std::move(ranked), .scale = "ranks"};
}

}  // namespace stipple::analyzers::sensitivity
