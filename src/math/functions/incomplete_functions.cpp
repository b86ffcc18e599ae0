// SPDX-License-Identifier: MIT
#include "math/functions/incomplete_functions.hpp"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "math/arithmetic/quotient.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/log_excess.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/normal_distribution.hpp"
#include "math/functions/portable_double.hpp"

namespace stipple {
namespace {

using Number = PortableDouble;
constexpr detail::NoErrors no_errors;

/// Below this x, P(a, x) and I_x(a, b) equal x^a over a constant, with a relative error of 1e-18.
constexpr double tiny = 1e-24;
constexpr double log_tiny = -55;

constexpr double no_end = std::numeric_limits<double>::infinity();

double log_or_none(double x) { return x > 0 ? logarithm(x) : -no_end; }

double near_0(double a, double p, Number constant) { return real_power(p * constant.value, 1 / a); }

/// Density at 0 if it is proportional to x^(a - 1) there and equals `level` for a = 1.
double density_at_0(double a, double level) {
    if (a == 1) return level;
    return a < 1 ? no_end : 0;
}

/// Logarithm of a probability, and its derivative.
struct Rise {
    double log;
    double slope;
};

/// Returns the t at which the logarithm of an increasing probability is log_p. As functions of log
/// x and of log(x / (1 - x)), gamma and beta densities are log-concave, and so are their
/// probabilities. So Newton steps from any start converge from below. Steps that leave the known
/// bounds or are not finite are replaced by bisection.
template <class Function>
double solve(const Function& probability, double log_p, double t) {
    double low = -745;
    double high = 745;
    for (int step = 0; step < 200; ++step) {
        const auto [log, slope] = probability(t);
        (log < log_p ? low : high) = t;
        const bool ends = !(std::isfinite(log) && slope > 0);
        const double next = ends ? low : t + (log_p - log) / slope;
        if (std::abs(next - t) < 1e-9 && !ends) return next;
        t = next > low && next < high ? next : 0.5 * (low + high);
    }
    return t;
}

/// Detects that the factors of a continued fraction have reached 1, up to rounding.
class Convergence {
  public:
    bool reached(double factor) {
        const double off = std::abs(factor - 1);
        const bool end = !(off > 1e-16) || (off < 1e-15 && off >= last_);
        last_ = off;
        return end;
    }

  private:
    double last_ = no_end;
};

DoubleDouble log_of(const DoubleDouble& x) {
    return logarithm_parts(x.high) + DoubleDouble{x.low / x.high, 0};
}

/// exp(x), accurate down to the smallest doubles.
double exp_of(const DoubleDouble& x) {
    const double power = x.high > 709 ? no_end : exponential(x.high < -700 ? x.high + 100 : x.high);
    return (power + power * x.low) * (x.high < -700 ? exponential(-100) : 1);
}

/// Approximate gamma quantile, the cube of a normal variable (Wilson and Hilferty).
double gamma_start(double a, double z) {
    const double root = std::max(1 - 1 / (9 * a) + z / (3 * std::sqrt(a)), 0.05);
    return a * root * root * root;
}

}  // namespace

double log_gamma(double x) { return boost::math::lgamma(Number(x), no_errors).value; }

double gamma_ratio(double x, double delta) {
    return 1 / boost::math::tgamma_delta_ratio(Number(x), Number(delta), no_errors).value;
}

DoubleDouble log_share(double a, const DoubleDouble& ratio) {
    return DoubleDouble{a, 0} * log_of(ratio);
}

namespace {

/// log(x^a exp(-x) / Gamma(a + 1)).
DoubleDouble gamma_log_power(double a, double x) {
    return log_share(a, quotient({x, 0}, {a, 0})) + exact_sum(a, -x) +
           DoubleDouble{-log_excess(a), 0};
}

/// True if a > 200 and x is far from a, where Boost's powers lose digits and Temme's expansion does
/// not apply.
bool far_out(double a, double x) {
    return a > 200 && x > 0 && (x - a) * (x - a) > 19 * a && x < no_end;
}

/// Returns Q by the continued fraction for x > a, and P by the power series for x < a.
double gamma_tail(double a, double x) {
    const double power = exp_of(gamma_log_power(a, x));
    double sum = 1;
    if (x < a) {
        double term = 1;
        for (double n = a + 1; term > 1e-17 * sum; ++n) sum += term *= x / n;
        return power * sum;
    }
    // Lentz's method for the continued fraction 1 / (x + 1 - a - 1 (1 - a) / (x + 3 - a - ...)).
    double b = x + 1 - a;
    double c = no_end;
    double d = 1 / b;
    sum = d;
    Convergence factors;
    for (double i = 1, step = 0; !factors.reached(step); ++i) {
        b += 2;
        d = 1 / (b - i * (i - a) * d);
        c = b - i * (i - a) / c;
        step = c * d;
        sum *= step;
    }
    return power * a * sum;
}

}  // namespace

double gamma_below(double a, double x) {
    if (far_out(a, x)) return x < a ? gamma_tail(a, x) : 1 - gamma_tail(a, x);
    return boost::math::gamma_p(Number(a), Number(x), no_errors).value;
}
double gamma_above(double a, double x) {
    if (far_out(a, x)) return x > a ? gamma_tail(a, x) : 1 - gamma_tail(a, x);
    return boost::math::gamma_q(Number(a), Number(x), no_errors).value;
}
double gamma_density(double a, double x) {
    if (x <= 0) return density_at_0(a, 1);
    if (a > 200) {
        const double power = exp_of(gamma_log_power(a, x));
        return power > 0 ? a / x * power : 0;  // a / x may be infinite, and x too
    }
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
        const double value = gamma_below(a, x);
        return Rise{log_or_none(value), x * gamma_density(a, x) / value};
    };
    return exponential(solve(below, logarithm(p), logarithm(start)));
}

double gamma_upper_quantile(double a, double q) {
    if (q > 0.5) return gamma_quantile(a, 1 - q);
    const double log = -logarithm(q);
    const double most = a + std::sqrt(2 * a * log) + log;  // upper bound of the quantile
    const double start = std::min(most, gamma_start(a, -normal_quantile(q)));
    const auto above = [a](double t) {
        const double x = exponential(-t);
        const double value = gamma_above(a, x);
        return Rise{log_or_none(value), x * gamma_density(a, x) / value};
    };
    return exponential(-solve(above, -log, -logarithm(start)));
}

namespace {

/// x and 1 - x, each to twice the precision of a double.
struct Parts {
    DoubleDouble x;
    DoubleDouble rest;
};

Parts parts_of(double x) { return {{x, 0}, exact_sum(1, -x)}; }

/// Extends x and 1 - x to twice the precision of a double; the smaller one determines both.
Parts parts_of(const Shares& at) {
    if (at.x < at.rest) return parts_of(at.x);
    const auto [x, rest] = parts_of(at.rest);
    return {rest, x};
}

/// I_x(a, b) for fixed a and b and many x.
class BetaFunction {
  public:
    BetaFunction(double a, double b)
        : a_(a),
          b_(b),
          sum_(exact_sum(a, b)),
          front_(log_excess(sum_.high) - log_excess(a) - log_excess(b)) {}

    /// log(x^a (1 - x)^b / B(a, b)), from logarithms that vanish at x = a / (a + b).
    DoubleDouble log_power(const Parts& at) const {
        return log_share(a_, quotient(sum_ * at.x, {a_, 0})) +
               log_share(b_, quotient(sum_ * at.rest, {b_, 0})) +
               DoubleDouble{front_ + logarithm(a_ * b_ / sum_.high), 0};
    }

    /// log(a B(a, b)): for small x, I_x = x^a / (a B(a, b)).
    double log_constant() const {
        const DoubleDouble log =
            log_share(a_, quotient({a_, 0}, sum_)) + log_share(b_, quotient({b_, 0}, sum_));
        return log.high + (log.low - (front_ + logarithm(b_ / sum_.high)));
    }

    /// True if I_x should be computed directly, false if from 1 - I_x.
    bool lower_first(const Parts& at) const { return at.x.high * (sum_.high + 0.6) <= a_ + 0.3; }

    double below(const Parts& at) const {
        return lower_first(at) ? exp_of(log_power(at)) / fraction(at)
                               : 1 - mirrored().below({at.rest, at.x});
    }
    double above(const Parts& at) const { return mirrored().below({at.rest, at.x}); }

    /// log I_x and its derivative in log(x / (1 - x)).
    Rise rise(const Parts& at) const {
        const DoubleDouble log = log_power(at);
        if (lower_first(at)) {
            const double under = fraction(at);
            return {log.high + (log.low - logarithm(under)), under};
        }
        const double value = below(at);
        return {log_or_none(value), exp_of(log) / value};
    }

  private:
    BetaFunction mirrored() const {
        BetaFunction other = *this;
        std::swap(other.a_, other.b_);
        return other;
    }

    /// x^a (1 - x)^b / (B(a, b) I_x), by the continued fraction evaluated from its first term.
    double fraction(const Parts& at) const {
        const double x = at.x.high;
        const double y = at.rest.high;
        const double sum = sum_.high;
        const DoubleDouble a_y = DoubleDouble{a_, 0} * at.rest;
        const DoubleDouble b_x = DoubleDouble{-b_, 0} * at.x;
        const double off = (a_y + b_x).high;  // 0 at x = a / (a + b)
        double value = a_ * (off + 1) / (a_ + 1);
        double c = value;
        double d = 0;
        Convergence factors;
        for (double m = 1, step = 0; !factors.reached(step); ++m) {
            const double odd = a_ + 2 * m - 1;
            const double top = (a_ + m - 1) / odd * ((sum + m - 1) / odd) * m * (b_ - m) * x * x;
            const double bottom =
                m + m * (b_ - m) * x / odd + (a_ + m) * (off + 1 + m * (1 + y)) / (odd + 2);
            d = 1 / (bottom + top * d);
            c = bottom + top / c;
            step = c * d;
            value *= step;
        }
        return value;
    }

    double a_;
    double b_;
    DoubleDouble sum_;
    double front_;
};

}  // namespace

double beta_below(double a, double b, double x) {
    if (x <= 0 || x >= 1) return x <= 0 ? 0 : 1;
    return BetaFunction(a, b).below(parts_of(x));
}
double beta_above(double a, double b, double x) {
    if (x <= 0 || x >= 1) return x <= 0 ? 1 : 0;
    return BetaFunction(a, b).above(parts_of(x));
}
double beta_density(double a, double b, double x) {
    if (x <= 0) return density_at_0(a, b);
    const Parts at = parts_of(x);
    const DoubleDouble log = BetaFunction(a, b).log_power(at);
    if (log.high > -700) return exp_of(log) / x / at.rest.high;
    const auto [high, low] = log_of(at.x);  // divides by x before the power underflows
    return exp_of(log + DoubleDouble{-high, -low}) / at.rest.high;
}

namespace {

/// x and 1 - x from t = log(x / (1 - x)).
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
    if (p <= 0) return {0, 1};
    if (p == 0.5 && a == b) return {0.5, 0.5};
    const BetaFunction function(a, b);
    const double log = logarithm(p);
    const double constant = function.log_constant();
    const double near = (log + constant) / a;
    if (near < log_tiny) return {real_power(p, 1 / a) * exponential(constant / a), 1};
    const auto below = [&](double t) { return function.rise(parts_of(shares_of(t))); };
    const double middle = logarithm(a / b) + normal_quantile(p) * std::sqrt(1 / a + 1 / b);
    const double start = a < 1 && near < -0.7 ? near : middle;
    return shares_of(solve(below, log, std::clamp(start, -700.0, 700.0)));
}

}  // namespace stipple
