// SPDX-License-Identifier: MIT
#include "warps/parameters/linear_correlation.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/normal_distribution.hpp"

namespace stipple::parameters {
namespace {

constexpr std::size_t terms = 60;

/// a_1, a_2, ... by the trapezoidal rule in z, whose error vanishes exponentially for what is smooth.
std::array<double, terms> hermite_series(const Marginal& law) {
    constexpr double step = 1.0 / 256;
    constexpr int reach = 9 * 256;
    std::array<double, terms> series{};
    for (int i = -reach; i <= reach; ++i) {
        const double z = i * step;
        const double x = z < 0 ? law.quantile(normal_distribution(z), Tail::lower)
                               : law.quantile(normal_distribution(-z), Tail::upper);
        const double weight = x * step * exponential(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
        double before = 1;  // h_(k-1), h_k
        double h = z;
        for (std::size_t k = 1; k <= terms; ++k) {
            series[k - 1] += weight * h;
            const auto n = static_cast<double>(k);
            const double next = (z * h - std::sqrt(n) * before) / std::sqrt(n + 1);
            before = h;
            h = next;
        }
    }
    return series;
}

}  // namespace

double correlation_of_scores(const Marginal& a, const Marginal& b, double r) {
    const double size = std::sqrt(a.moments().variance * b.moments().variance);
    if (!std::isfinite(size) || !(size > 0))
        fail(ErrorKind::usage,
             "a parameter whose variance is 0 or infinite has no linear correlation");
    const auto x = hermite_series(a);
    const auto y = hermite_series(b);
    const auto correlation = [&](double rho) {
        double sum = 0;
        for (std::size_t k = terms; k-- > 0;) sum = rho * (sum + x[k] * y[k]);
        return sum / size;
    };
    double low = -1;
    double high = 1;
    if (!(r > correlation(low) && r < correlation(high)))
        fail(ErrorKind::usage,
             "{} is out of reach: these two have correlations in [{:.4f}, {:.4f}]", r,
             correlation(low), correlation(high));
    for (int step = 0; step < 60; ++step) {
        const double middle = (low + high) / 2;
        (correlation(middle) < r ? low : high) = middle;
    }
    return (low + high) / 2;
}

}  // namespace stipple::parameters
