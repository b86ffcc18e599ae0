// SPDX-License-Identifier: MIT
#include "experiments/sensitivity/methods.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/domain.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "math/combinatorics/order.hpp"
#include "math/functions/distributions.hpp"

namespace stipple::analyzers::sensitivity {

namespace {

PointSet by_domain(const Inputs& inputs) {
    PointSet u(inputs.runs(), inputs.size());
    std::vector<double> cube(inputs.domain->cube_dimension());
    for (std::size_t i = 0; i < inputs.runs(); ++i) {
        inputs.domain->to_cube(inputs.points[i], cube);
        for (std::size_t j = 0; j < inputs.size(); ++j) u[i][j] = cube[inputs.coordinates[j]];
    }
    return u;
}

/// Maps inputs without a known domain to [0, 1]: unchanged, or scaled by their extremes.
UnitInputs as_they_lie(const PointSet& values) {
    const Box box = bounding_box(values.flat(), values.dimension());
    if (std::ranges::min(box.low) >= 0 && std::ranges::max(box.high) <= 1) return {values, "cube"};
    PointSet u(values.count(), values.dimension());
    for (std::size_t i = 0; i < u.count(); ++i)
        for (std::size_t j = 0; j < u.dimension(); ++j) {
            // Uses halves, because the difference of two doubles may overflow.
            const double extent = box.high[j] / 2 - box.low[j] / 2;
            u[i][j] = extent > 0 ? (values[i][j] / 2 - box.low[j] / 2) / extent : 0.5;
        }
    return {std::move(u), "range"};
}

const char* scale_of(const Domain& domain) {
    const std::string spec = domain.spec();
    return spec == "unit-cube" ? "cube" : spec.starts_with("box") ? "box" : "distributions";
}

}  // namespace

double Centred::variance() const { return dot(z, z) / static_cast<double>(z.size()); }

double held(double variance) { return std::isnormal(variance) ? variance : none; }

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
    // Differences from the middle have smaller rounding errors than the numbers.
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

std::vector<std::size_t> complete_groups(const Response& response, std::size_t group,
                                         const char* what) {
    const std::span y = response.y;
    std::vector<std::size_t> complete;
    for (std::size_t g = 0; (g + 1) * group <= y.size(); ++g)
        if (std::ranges::none_of(y.subspan(g * group, group), [](double v) { return v != v; }))
            complete.push_back(g);
    if (complete.size() < 2)
        fail(ErrorKind::input, "the output {} has {} {} without failed runs; expected at least 2",
             response.name, complete.size(), what);
    return complete;
}

std::vector<double> joined(std::span<const double> y, std::size_t group,
                           std::span<const std::size_t> groups) {
    std::vector<double> all;
    all.reserve(groups.size() * group);
    for (const std::size_t g : groups)
        std::ranges::copy(y.subspan(g * group, group), std::back_inserter(all));
    return all;
}

bool mostly_equal(std::vector<double> y) {
    std::ranges::sort(y);
    const std::size_t half = (y.size() + 1) / 2;
    for (std::size_t i = 0; i + half <= y.size(); ++i)
        if (y[i] == y[i + half - 1]) return true;
    return false;
}

std::string too_few_for_intervals(std::size_t count, std::size_t least, const char* of_what) {
    if (count >= least) return {};
    return fmt::format("{} {}; intervals need {}", count, of_what, least);
}

double interval_quantile(double level, std::size_t freedom) {
    return student_quantile((1 - level) / 2, static_cast<double>(freedom));
}

std::vector<double> column_of(const PointSet& points, std::size_t j) {
    std::vector<double> column(points.count());
    for (std::size_t i = 0; i < column.size(); ++i) column[i] = points[i][j];
    return column;
}

double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

std::vector<double> ranks_of(std::span<const double> values) {
    const std::size_t n = values.size();
    const auto at = [&](std::size_t i) { return values[i]; };
    const auto order = order_by(n, at);
    std::vector<double> ranks(n);
    for (std::size_t first = 0, last = 0; first < n; first = last) {
        while (last < n && at(order[last]) == at(order[first])) ++last;
        const double middle = static_cast<double>(first + last) / 2 / static_cast<double>(n);
        for (std::size_t r = first; r < last; ++r) ranks[order[r]] = middle;
    }
    return ranks;
}

UnitInputs unit_inputs(const Inputs& inputs) {
    return inputs.domain ? UnitInputs{by_domain(inputs), scale_of(*inputs.domain)}
                         : as_they_lie(inputs.values);
}

}  // namespace stipple::analyzers::sensitivity
