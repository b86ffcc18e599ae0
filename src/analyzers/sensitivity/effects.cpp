// SPDX-License-Identifier: MIT
#include "analyzers/sensitivity/effects.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "core/domain.hpp"
#include "core/error.hpp"
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

/// As the domain's distributions say.
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

/// As far as there is no better knowledge.
UnitInputs as_they_lie(const PointSet& values) {
    const auto flat = values.flat();
    UnitInputs out{.u = {flat.begin(), flat.end()}, .scale = "cube"};
    const Box box = bounding_box(flat, values.dimension());
    if (std::ranges::min(box.low) >= 0 && std::ranges::max(box.high) <= 1) return out;
    out.scale = "range";
    for (std::size_t i = 0; i < out.u.size(); ++i) {
        const std::size_t j = i % values.dimension();
        // Halves, as the difference of two doubles may be none.
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

UnitInputs unit_inputs(const Inputs& inputs, bool ranks) {
    UnitInputs out = inputs.domain ? UnitInputs{by_domain(inputs), scale_of(*inputs.domain)}
                                   : as_they_lie(inputs.values);
    if (!ranks) return out;
    std::vector<double> ranked = ranks_of(inputs.values);
    constexpr double critical = 1.63;  // of Kolmogorov and Smirnov's statistic, at 1 %
    const double most = critical / std::sqrt(static_cast<double>(inputs.runs()));
    const bool uniform = std::ranges::equal(
        out.u, ranked, [most](double u, double rank) { return std::abs(u - rank) <= most; });
    const bool known = inputs.domain || std::string_view(out.scale) == "cube";
    return known && uniform ? out : UnitInputs{.u = std::move(ranked), .scale = "ranks"};
}

}  // namespace stipple::analyzers::sensitivity
