// SPDX-License-Identifier: MIT
//
// The incomplete gamma and beta functions, regularised, and their inverses:
//
//     P(a, x) = integral of t^(a-1) exp(-t) from 0 to x / Gamma(a),              Q = 1 - P,
//     I_x(a, b) = integral of t^(a-1) (1-t)^(b-1) from 0 to x / B(a, b).
//
// The functions by Boost.Math over our own elementary functions (portable_double.hpp); their
// inverses by Newton's steps for the logarithm of the smaller of p and 1 - p.
//
// Shape   a, b in [0.05, 1e6]; probabilities in (0, 1), from 1e-300 on.
// Cost    1 to 5 us for an inverse on one core, more for parameters of 1e6.
// Promise inverses within 2e-13 of themselves, where they are above 1e-300; of I_x for a or b above
//         100, from probabilities of 1e-260 on. The same bits on every machine for the same release
//         of Boost.
#pragma once

namespace stipple {

/// log Gamma(x), x > 0.
double log_gamma(double x);

/// Gamma(x + delta) / Gamma(x).
double gamma_ratio(double x, double delta);

double gamma_below(double a, double x);    ///< P(a, x)
double gamma_above(double a, double x);    ///< Q(a, x)
double gamma_density(double a, double x);  ///< of P in x

/// The x with P(a, x) = p, and the one with Q(a, x) = q.
double gamma_quantile(double a, double p);
double gamma_upper_quantile(double a, double q);

double beta_below(double a, double b, double x);    ///< I_x(a, b)
double beta_above(double a, double b, double x);    ///< 1 - I_x(a, b)
double beta_density(double a, double b, double x);  ///< of I in x < 1

/// Parts of a whole: x and 1 - x, each to its last digits.
struct Shares {
    double x;
    double rest;
};

/// The x with I_x(a, b) = p.
Shares beta_quantile(double a, double b, double p);

}  // namespace stipple
