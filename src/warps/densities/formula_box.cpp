// SPDX-License-Identifier: MIT
#include "warps/densities/formula_box.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "math/densities/line_table.hpp"
#include "math/densities/quadrature.hpp"
#include "math/distributions/families.hpp"
#include "math/functions/powers.hpp"

namespace stipple::warps {
namespace {

// Quadrature is nested, one coordinate inside another; to limit the time, coordinates get fewer
// intervals in more dimensions. The initial intervals are numerous enough to detect narrow peaks.
Effort effort_for(std::size_t dimension) {
    if (dimension <= 1) return {1e-12, 5000, 1023};
    if (dimension == 2) return {1e-9, 150, 25};
    return {1e-5, 12, 5};
}

/// @param share upper limit for the cell's extent along an axis, as a fraction of the box's extent
Effort effort_in_cell(std::size_t dimension, double share) {
    if (dimension <= 1) return {1e-10, 200};
    if (dimension == 3) return {1e-4, 5};
    // The box's whole extent is first divided into 53 intervals of 17 values each.
    const auto first = 2 * static_cast<std::size_t>(26 * std::clamp(share, 0.0, 1.0)) + 1;
    return {1e-6, 80, std::max<std::size_t>(first, 3)};
}

/// Estimates the integral by the mean over an evenly distributed sequence of points. The error is
/// six times the standard error, from the means of consecutive batches.
Estimate mean_integral(const std::string& what, const Expression& f, const Box& box) {
    constexpr std::size_t stretches = 32;
    constexpr std::size_t places = 4096;  // points in each batch
    constexpr double steps[3][3] = {{0.6180339887498949},
                                    {0.7548776662466927, 0.5698402909980532},
                                    {0.8191725133961645, 0.6710436067037893, 0.5497004779019703}};
    const std::size_t d = box.dimension();
    std::vector<double> points(places * d);
    std::vector<double> values(places);
    std::array<double, stretches> means{};
    double top = 0;
    for (std::size_t s = 0; s < stretches; ++s) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double turns =
                0.25 + steps[d - 1][i % d] * static_cast<double>(s * places + i / d);
            points[i] = box.low[i % d] + (turns - std::floor(turns)) * box.extent(i % d);
        }
        f.evaluate(points, values);
        for (const double value : values) means[s] += value / double{places};
        top = std::max(top, std::ranges::max(values));
    }
    double mean = 0;
    for (const double one : means) mean += one / double{stretches};
    if (!(top > 0)) return {};
    require_integral(what, volume_of(box) * mean);
    double variance = 0;  // relative, so that no square overflows or underflows
    for (const double one : means)
        variance += (one / mean - 1) * (one / mean - 1) / double{stretches};
    return volume_of(box) * Estimate{mean, 6 * mean * std::sqrt(variance / stretches)};
}

Effort effort_for_moments(std::size_t dimension) {
    return dimension <= 1 ? effort_for(1) : Effort{1e-7, 60, 15};
}

}  // namespace

FormulaBox::FormulaBox(std::string spec, Expression f, Box box)
    : NamedDomain(std::move(spec), box.dimension(), box.dimension()),
      f_(std::move(f)),
      box_(std::move(box)),
      place_(box_domain(box_)) {
    for (std::size_t k = 0; k < dimension(); ++k)
        require_wide("--", "bounds", box_.low[k], box_.high[k]);
}

Estimate FormulaBox::integral() const {
    std::call_once(once_, [this] {
        const std::string what = "--density: " + f_.text();
        // If quadrature misses a narrow peak, its result is too far from that of mean_integral(),
        // and it is repeated with more intervals.
        constexpr int most_tries = 4;
        const Estimate mean = mean_integral(what, f_, box_);
        Effort effort = effort_for(dimension());
        for (int tries = 1;; ++tries, effort.first = 2 * effort.first + 1, effort.most *= 2) {
            integral_ = integrate_box(
                [&](std::span<const double> point) {
                    const double value = f_.at(point);
                    require_density(what, point, value);
                    return value;
                },
                box_, effort);
            const double room = integral_.error + mean.error + 1e-4 * mean.value;
            if (std::abs(integral_.value - mean.value) <= room) break;
            if (tries == most_tries)
                fail(ErrorKind::limit,
                     "{} has features too narrow to resolve: its integral over {} is {:.6g} by "
                     "quadrature, and {:.6g} by a mean of values",
                     what, format_box(box_), integral_.value, mean.value);
        }
        if (!(integral_.value > 0))
            fail(ErrorKind::usage, "{} is 0 at all points tried in {}", what, format_box(box_));
    });
    return integral_;
}

double FormulaBox::density(std::span<const double> point) const {
    return contains(point) ? f_.at(point) / integral().value : 0;
}

Estimate FormulaBox::probability(const Box& cell) const {
    Box part = box_;
    double widest = 0;
    for (std::size_t k = 0; k < dimension(); ++k) {
        widest = std::max(widest, cell.extent(k));
        part.low[k] = box_.low[k] + cell.low[k] * box_.extent(k);
        part.high[k] =
            cell.high[k] < 1 ? box_.low[k] + cell.high[k] * box_.extent(k) : box_.high[k];
    }
    const Estimate mass = integrate_box([&](std::span<const double> point) { return f_.at(point); },
                                        part, effort_in_cell(dimension(), widest));
    const Estimate whole = integral();
    const double share = mass.value / whole.value;
    return {share, (mass.error + share * whole.error) / whole.value};
}

/// Central moments about means found first, so that narrow peaks lose no digits; the third ones are
/// in units of the standard deviation.
std::optional<Moments> FormulaBox::moments() const {
    const std::size_t d = dimension();
    if (d > 2) return std::nullopt;
    const Estimate whole = integral();
    constexpr double within = 1e-6;
    constexpr double of_deviation = 1e-5;  // with powers of standard deviations as units
    Moments m{std::vector<double>(d), std::vector<double>(d * d), std::vector<double>(d)};
    std::vector<double> mean(d);
    // A coordinate less its mean, in units of half the box's extent.
    const auto off = [&](std::span<const double> x, std::size_t k) {
        return (x[k] - box_.low[k]) / (0.5 * box_.extent(k)) - 1 - mean[k];
    };
    const auto expect = [&](const auto& term) {
        const Estimate found =
            integrate_box([&](std::span<const double> x) { return f_.at(x) * term(x); }, box_,
                          effort_for_moments(d));
        return Estimate{found.value / whole.value, found.error / whole.value};
    };
    // A narrow peak that these intervals miss is missing in the mass.
    const Estimate mass = expect([](const auto&) { return 1.0; });
    bool fine = whole.error <= within * whole.value && std::abs(mass.value - 1) <= within;
    // Of a term that may cancel: with 1 added, tolerances are relative to the mass.
    const auto expect_odd = [&](const auto& term) {
        const Estimate found = expect([&](const auto& x) { return 1 + term(x); });
        return Estimate{found.value - mass.value, found.error};
    };
    std::vector<double> deviation(d);
    for (std::size_t k = 0; k < d && fine; ++k) {
        const double half = 0.5 * box_.extent(k);
        const Estimate first = expect_odd([&](const auto& x) { return off(x, k); });
        mean[k] = first.value;
        const Estimate second = expect([&](const auto& x) { return whole_power(off(x, k), 2); });
        deviation[k] = std::sqrt(second.value);
        const Estimate third =
            expect_odd([&](const auto& x) { return whole_power(off(x, k) / deviation[k], 3); });
        fine = first.error <= std::min(within, of_deviation * deviation[k]) &&
               second.error <= of_deviation * second.value && third.error <= of_deviation;
        m.mean[k] = box_.low[k] + half * (1 + mean[k]);
        m.covariance[k * d + k] = half * half * second.value;
        m.skewness[k] = third.value;
    }
    if (d == 2 && fine) {
        const double unit = deviation[0] * deviation[1];
        const Estimate both =
            expect_odd([&](const auto& x) { return off(x, 0) * off(x, 1) / unit; });
        fine = both.error <= of_deviation;
        m.covariance[1] = m.covariance[2] =
            0.25 * box_.extent(0) * box_.extent(1) * unit * both.value;
    }
    return fine ? std::optional(m) : std::nullopt;
}

Support FormulaBox::support() const {
    const std::size_t d = dimension();
    const std::size_t steps = d == 1 ? 256 : (d == 2 ? 16 : 4);
    std::vector<std::size_t> at(d, 0);
    Estimate positive;
    const auto cell = [&] {
        Box part = box_;
        for (std::size_t k = 0; k < d; ++k) {
            const double step = box_.extent(k) / static_cast<double>(steps);
            part.low[k] += static_cast<double>(at[k]) * step;
            part.high[k] = at[k] + 1 < steps ? part.low[k] + step : box_.high[k];
        }
        return part;
    };
    for (bool more = true; more;) {
        positive += integrate_box(
            [&](std::span<const double> point) { return f_.at(point) > 0 ? 1.0 : 0.0; }, cell(),
            {1e-7, 16});
        std::size_t k = 0;
        while (k < d && ++at[k] == steps) at[k++] = 0;
        more = k < d;
    }
    // Reports a gap if the measure is below the box's volume by more than rounding.
    const double whole = measure();
    if (positive.value >= (1 - 1e-9) * whole)
        return {.measure = Estimate{whole, 0}, .boxes = {box_}};
    return {.whole = false, .measure = positive, .boxes = {box_}};
}

Box formula_bounds(const std::string& text, std::size_t most) {
    const std::size_t ranges = split(text, ',').size();
    if (ranges > most)
        fail(ErrorKind::usage, "--bounds: {} ranges; expected at most {}", ranges, most);
    return parse_box(text, std::max<std::size_t>(ranges, 1));
}

}  // namespace stipple::warps
