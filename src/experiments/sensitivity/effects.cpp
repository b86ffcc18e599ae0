// SPDX-License-Identifier: MIT
#include "experiments/sensitivity/effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/domain.hpp"
#include "core/error.hpp"
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
    // Sums of differences from the middle have the rounding errors of the differences, which are
    // smaller than the rounding errors of the numbers.
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

/// Maps inputs to [0, 1] by the distributions of their domain.
std::vector<double> by_domain(const Inputs& inputs) {
    std::vector<double> u;
    u.reserve(inputs.runs() * inputs.size());
    std::vector<double> cube(inputs.domain->cube_dimension());
    for (std::size_t i = 0; i < inputs.runs(); ++i) {
        inputs.domain->to_cube(inputs.points[i], cube);
        for (const std::size_t c : inputs.coordinates) u.push_back(cube[c]);
    }
    return u;
}

/// Maps inputs without a known domain to [0, 1]: unchanged, or scaled by their extremes.
UnitInputs as_they_lie(const PointSet& values) {
    const auto flat = values.flat();
    UnitInputs out{.u = {flat.begin(), flat.end()}, .scale = "cube"};
    const Box box = bounding_box(flat, values.dimension());
    if (std::ranges::min(box.low) >= 0 && std::ranges::max(box.high) <= 1) return out;
    out.scale = "range";
    for (std::size_t i = 0; i < out.u.size(); ++i) {
        const std::size_t j = i % values.dimension();
        // Uses halves, because the difference of two doubles may overflow.
        const double extent = box.high[j] / 2 - box.low[j] / 2;
        out.u[i] = extent > 0 ? (out.u[i] / 2 - box.low[j] / 2) / extent : 0.5;
    }
    return out;
}

const char* scale_of(const Domain& domain) {
    const std::string spec = domain.spec();
    return spec == "unit-cube" ? "cube" : spec.starts_with("box") ? "box" : "distributions";
}

}  // namespace

std::vector<double> ranks_of(std::span<const double> values) {
    const std::size_t n = values.size();
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto at = [&](std::size_t i) { return values[i]; };
    std::ranges::stable_sort(order, {}, at);
    std::vector<double> ranks(n);
    for (std::size_t first = 0, last = 0; first < n; first = last) {
        while (last < n && at(order[last]) == at(order[first])) ++last;
        const double middle = static_cast<double>(first + last) / 2 / static_cast<double>(n);
        for (std::size_t r = first; r < last; ++r) ranks[order[r]] = middle;
    }
    return ranks;
}

std::vector<double> ranks_of(const PointSet& points) {
    std::vector<double> ranks(points.flat().size());
    std::vector<double> column(points.count());
    for (std::size_t j = 0; j < points.dimension(); ++j) {
        for (std::size_t i = 0; i < column.size(); ++i) column[i] = points[i][j];
        const auto own = ranks_of(column);
        for (std::size_t i = 0; i < own.size(); ++i) ranks[i * points.dimension() + j] = own[i];
    }
    return ranks;
}

UnitInputs unit_inputs(const Inputs& inputs) {
    return inputs.domain ? UnitInputs{by_domain(inputs), scale_of(*inputs.domain)}
                         : as_they_lie(inputs.values);
}

}  // namespace stipple::analyzers::sensitivity
