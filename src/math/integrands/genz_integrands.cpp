// SPDX-License-Identifier: MIT
//
// The six families of test integrands of A. Genz on the unit cube, with their integrals.
//
//     oscillatory    cos(2 pi u_1 + sum a_i x_i)
//     product-peak   prod 1 / (a_i^-2 + (x_i - u_i)^2)
//     corner-peak    (1 + sum a_i x_i)^-(d + 1)
//     gaussian       exp(-sum a_i^2 (x_i - u_i)^2)
//     continuous     exp(-sum a_i |x_i - u_i|)
//     discontinuous  exp(sum a_i x_i), but 0 if x_1 > u_1 or x_2 > u_2
//
// with u_i and a_i drawn uniformly in [0, 1) from the seed, and the a_i scaled so that their sum is
// the difficulty.
//
// Shape   d coordinates; u_i and the ratios of the a_i do not depend on d. product-peak and
//         corner-peak allow d <= 100, because values would overflow or underflow beyond.
// Promise integrals within 1e-13 relative. All except the corner peak are products of integrals in
//         one variable. For the corner peak, 1 / s^(d + 1) = 1/d! int_0^inf t^d e^(-s t) dt gives
//
//             1/d! int_0^inf t^d e^-t prod (1 - e^(-a_i t)) / (a_i t) dt,
//
//         whose integrand is positive. Inclusion and exclusion over the corners,
//         1 / (d! prod a_i) sum_S (-1)^|S| / (1 + sum_S a_i), is equal but cancels: in 10
//         dimensions with difficulty 0.1 it has no correct digit, while the integral has 15.
// Source  A. Genz, "Testing multidimensional integration routines", in B. Ford, J. C. Rault,
//         F. Thomasset (eds.), Tools, Methods and Languages for Scientific and Engineering
//         Computation, North-Holland (1984) 81-94.

#include "math/integrands/integrands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/rng.hpp"
#include "math/functions/distributions.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/normal_distribution.hpp"
#include "math/functions/radians.hpp"

namespace stipple {
namespace {

constexpr Param<std::int64_t> peak_seed{
    .name = "seed", .fallback = 1, .low = 0, .help = "Seed of its random position and steepness"};

Param<double> difficulty(double fallback) {
    return {.name = "difficulty",
            .fallback = fallback,
            .low = 1e-100,
            .high = 10'000,
            .help = "Sum of the steepnesses a_i"};
}

/// Random parameters of an integrand: steepness a and position u on each axis.
struct Draw {
    std::vector<double> a;
    std::vector<double> u;
    [[nodiscard]] std::size_t dimension() const { return a.size(); }

    /// Product of f(a_i, u_i) over the axes.
    template <class F>
    [[nodiscard]] double product(const F& f) const {
        double product = 1;
        for (std::size_t i = 0; i < a.size(); ++i) product *= f(a[i], u[i]);
        return product;
    }

    /// Sum of f(a_i, u_i, x_i) over the axes.
    template <class F>
    [[nodiscard]] double sum(std::span<const double> x, const F& f) const {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += f(a[i], u[i], x[i]);
        return sum;
    }
};

Draw draw(std::size_t dimension, std::int64_t number, std::uint64_t family, double sum) {
    constexpr std::uint64_t stream = 0x67656e7a00;  // "genz"
    const Rng rng(static_cast<std::uint64_t>(number), stream + family);
    Draw drawn{std::vector<double>(dimension), std::vector<double>(dimension)};
    for (std::size_t i = 0; i < dimension; ++i) {
        drawn.u[i] = rng.uniform(2 * i);
        drawn.a[i] = std::max(rng.uniform(2 * i + 1), 0x1p-53);
    }
    const double scale = sum / std::accumulate(drawn.a.begin(), drawn.a.end(), 0.0);
    for (double& a : drawn.a) a *= scale;
    return drawn;
}

double along(double a, double, double x) { return a * x; }
double square(double x) { return x * x; }

Integrand oscillatory(Draw g) {
    const double shift = 2 * std::numbers::pi * g.u[0];
    const double middle = std::accumulate(g.a.begin(), g.a.end(), 0.0) / 2;
    const double exact = cos_sin_radians(shift + middle).cos * g.product([](double a, double) {
        return cos_sin_radians(a / 2).sin / (a / 2);
    });
    return {
        [g = std::move(g), shift](auto x) { return cos_sin_radians(shift + g.sum(x, along)).cos; },
        exact};
}

Integrand product_peak(Draw g) {
    const double exact = g.product([](double a, double u) {
        return a * (signed_angle(a * (1 - u), 1) + signed_angle(a * u, 1));
    });
    return {[g = std::move(g)](auto x) {
                double product = 1;
                for (std::size_t i = 0; i < g.dimension(); ++i)
                    product /= 1 / square(g.a[i]) + square(x[i] - g.u[i]);
                return product;
            },
            exact};
}

/// Integrates over t = e^y by the trapezoidal rule. Its error decreases exponentially, because the
/// integrand is analytic, has one maximum and decays at both ends.
double corner_peak_integral(const std::vector<double>& a) {
    const auto d = static_cast<double>(a.size());
    const auto term = [&](double y) {
        const double t = exponential(y);
        double log = (d + 1) * y - t - log_factorial(d);
        for (const double s : a) log += logarithm(-exp_minus_1(-s * t) / (s * t));
        return exponential(log);
    };
    const double step = std::min(0.125, 0.25 / std::sqrt(d + 1));
    const double top = logarithm((d + 1) / (1 + std::accumulate(a.begin(), a.end(), 0.0) / d));
    double sum = term(top);
    for (const double way : {-step, step}) {
        double before = 0;
        for (int k = 1;; ++k) {
            const double now = term(top + k * way);
            sum += now;
            if (now < before && now < 1e-20 * sum) break;
            if (now == 0 && before == 0 && k > 1) break;
            before = now;
        }
    }
    return step * sum;
}

Integrand corner_peak(Draw g) {
    const double exact = corner_peak_integral(g.a);
    const auto power = -static_cast<double>(g.dimension() + 1);
    return {[g = std::move(g), power](auto x) { return real_power(1 + g.sum(x, along), power); },
            exact};
}

Integrand gaussian(Draw g) {
    const double exact = g.product([](double a, double u) {
        return (error_function(a * (1 - u)) + error_function(a * u)) /
               (2 * std::numbers::inv_sqrtpi * a);
    });
    return {[g = std::move(g)](auto x) {
                return exponential(
                    -g.sum(x, [](double a, double u, double t) { return square(a * (t - u)); }));
            },
            exact};
}

Integrand continuous(Draw g) {
    const double exact = g.product(
        [](double a, double u) { return -(exp_minus_1(-a * u) + exp_minus_1(-a * (1 - u))) / a; });
    return {[g = std::move(g)](auto x) {
                return exponential(
                    -g.sum(x, [](double a, double u, double t) { return a * std::abs(t - u); }));
            },
            exact};
}

/// exp(x) - 1, infinite if it would overflow.
double grown(double x) {
    return x > 709 ? std::numeric_limits<double>::infinity() : exp_minus_1(x);
}

Integrand discontinuous(Draw g) {
    const std::size_t cut = std::min<std::size_t>(2, g.dimension());
    for (std::size_t i = cut; i < g.dimension(); ++i) g.u[i] = 1;
    const double exact = g.product([](double a, double u) { return grown(a * u) / a; });
    return {[g = std::move(g), cut](auto x) {
                for (std::size_t i = 0; i < cut; ++i)
                    if (x[i] > g.u[i]) return 0.0;
                return 1 + grown(g.sum(x, along));
            },
            exact};
}

IntegrandKind family(const std::string& name, std::string summary, std::uint64_t number, double sum,
                     std::size_t max_dimension, Integrand (*make)(Draw)) {
    const Param<double> steep = difficulty(sum);
    return {.name = name,
            .summary = std::move(summary),
            .max_dimension = max_dimension,
            .options = Schema(peak_seed, steep),
            .make = [=](std::size_t d, const Values& values) {
                Integrand made = make(draw(d, values[peak_seed], number, values[steep]));
                if (number > 0) require_normal(made.exact, name, d);  // a cosine's may be near 0
                return made;
            }};
}

}  // namespace

std::vector<IntegrandKind> genz_integrands() {
    return {
        family("genz-oscillatory", "cosine of a sum", 0, 9, 10'000, oscillatory),
        family("genz-product-peak", "a product of a peak on each axis", 1, 7.25, 100, product_peak),
        family("genz-corner-peak", "a peak at the origin", 2, 1.85, 100, corner_peak),
        family("genz-gaussian", "a Gaussian peak", 3, 7.03, 10'000, gaussian),
        family("genz-continuous", "a peak with kinks", 4, 20.4, 10'000, continuous),
        family("genz-discontinuous", "an exponential, cut off on two axes", 5, 4.3, 10'000,
               discontinuous),
    };
}

}  // namespace stipple
