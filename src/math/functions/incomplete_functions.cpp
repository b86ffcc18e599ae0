// SPDX-License-Identifier: MIT
#include "math/functions/incomplete_functions.hpp"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>

#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/normal_distribution.hpp"
#include "math/functions/portable_double.hpp"

namespace stipple {
namespace {

using Number = PortableDouble;
constexpr detail::NoErrors no_errors;

/// Below this, both integrals are x^a over a constant, up to 1e-18 of themselves.
constexpr double tiny = 1e-24;

double near_0(double a, double p, Number constant) { return real_power(p * constant.value, 1 / a); }

/// Of a density in proportion to x^(a - 1), `level` for a = 1.
double density_at_0(double a, double level) {
    if (a == 1) return level;
    return a < 1 ? std::numeric_limits<double>::infinity() : 0;
}

/// A probability, and how it rises.
struct Rise {
    double value;
    double slope;
};

/// The t at which a probability that rises with t is p. In log x and log(x / (1 - x)), densities of
/// gamma and beta distributions are log-concave, so that the logarithm of the probability is
/// concave, for which Newton's steps close in from below, wherever they begin; where numbers end,
/// the interval is halved.
template <class Function>
double solve(const Function& probability, double p, double t) {
    double low = -745;
    double high = 745;
    for (int step = 0; step < 200; ++step) {
        const auto [value, slope] = probability(t);
        (value < p ? low : high) = t;
        const bool ends = !(value > 0 && slope > 0);
        const double next = ends ? low : t + value / slope * logarithm(p / value);
        if (std::abs(next - t) < 1e-9 && !ends) return next;
        t = next > low && next < high ? next : 0.5 * (low + high);
    }
    return t;
}

/// The cube of a normal variable, nearly: Wilson and Hilferty's.
double gamma_start(double a, double z) {
    const double root = std::max(1 - 1 / (9 * a) + z / (3 * std::sqrt(a)), 0.05);
    return a * root * root * root;
}

}  // namespace

double log_gamma(double x) { return boost::math::lgamma(Number(x), no_errors).value; }

double gamma_ratio(double x, double delta) {
    return 1 / boost::math::tgamma_delta_ratio(Number(x), Number(delta), no_errors).value;
}

double gamma_below(double a, double x) {
    return boost::math::gamma_p(Number(a), Number(x), no_errors).value;
}
double gamma_above(double a, double x) {
    return boost::math::gamma_q(Number(a), Number(x), no_errors).value;
}
double gamma_density(double a, double x) {
    if (x <= 0) return density_at_0(a, 1);
    return boost::math::gamma_p_derivative(Number(a), Number(x), no_errors).value;
}

double gamma_quantile(double a, double p) {
    if (p > 0.5) return gamma_upper_quantile(a, 1 - p);
    double start = gamma_start(a, normal_quantile(p));
    if (a < 170) {
        const double near = near_0(a, p, boost::math::tgamma(Number(a) + 1, no_errors));
        if (near < tiny) return near;
        if (a < 1 || near > start) start = near;
    }
    const auto below = [a](double t) {
        const double x = exponential(t);
        return Rise{gamma_below(a, x), x * gamma_density(a, x)};
    };
    return exponential(solve(below, p, logarithm(start)));
}

double gamma_upper_quantile(double a, double q) {
    if (q > 0.5) return gamma_quantile(a, 1 - q);
    const double log = -logarithm(q);
    const double most = a + std::sqrt(2 * a * log) + log;  // the quantile is not above this
    const double start = std::min(most, gamma_start(a, -normal_quantile(q)));
    const auto above = [a](double t) {
        const double x = exponential(-t);
        return Rise{gamma_above(a, x), x * gamma_density(a, x)};
    };
    return exponential(-solve(above, q, -logarithm(start)));
}

double beta_below(double a, double b, double x) {
    return boost::math::ibeta(Number(a), Number(b), Number(x), no_errors).value;
}
double beta_above(double a, double b, double x) {
    return boost::math::ibetac(Number(a), Number(b), Number(x), no_errors).value;
}
double beta_density(double a, double b, double x) {
    if (x <= 0) return density_at_0(a, b);
    return boost::math::ibeta_derivative(Number(a), Number(b), Number(x), no_errors).value;
}

namespace {

/// x and 1 - x for log(x / (1 - x)).
Shares shares_of(double t) {
    const double odds = exponential(-std::abs(t));
    const double small = odds / (1 + odds);
    return t < 0 ? Shares{small, 1 / (1 + odds)} : Shares{1 / (1 + odds), small};
}

}  // namespace

Shares beta_quantile(double a, double b, double p) {
    if (p > 0.5) {
        const auto [rest, x] = beta_quantile(b, a, 1 - p);
        return {x, rest};
    }
    const double near = near_0(a, p, a * boost::math::beta(Number(a), Number(b), no_errors));
    if (near < tiny) return {near, 1};
    const auto below = [=](double t) {
        const auto [x, rest] = shares_of(t);
        return x < 0.5 ? Rise{beta_below(a, b, x), x * rest * beta_density(a, b, x)}
                       : Rise{beta_above(b, a, rest), x * rest * beta_density(b, a, rest)};
    };
    const double middle = logarithm(a / b) + normal_quantile(p) * std::sqrt(1 / a + 1 / b);
    const double start = a < 1 && near < 0.5 ? logarithm(near) : middle;
    return shares_of(solve(below, p, std::clamp(start, -700.0, 700.0)));
}

}  // namespace stipple
