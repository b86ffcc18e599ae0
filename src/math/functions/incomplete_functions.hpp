// SPDX-License-Identifier: MIT
//
// The incomplete gamma and beta functions, regularised, and their inverses:
//
//     P(a, x) = integral of t^(a-1) exp(-t) from 0 to x / Gamma(a),              Q = 1 - P,
//     I_x(a, b) = integral of t^(a-1) (1-t)^(b-1) from 0 to x / B(a, b).
//
// I_x is x^a (1-x)^b / B(a, b) over a continued fraction, from the tail that is thinner. With
// n = a + b, the power is
//
//     exp(s(n) - s(a) - s(b)) a b / n (n x / a)^a (n (1-x) / b)^b,    s = log_excess,
//
// whose logarithm is taken to twice the digits of a double, so that neither B(a, b) nor the powers
// underflow or lose digits. P and Q by Boost.Math over our own elementary functions
// (portable_double.hpp) and, for a above 200 and far from the mean, by a series and a continued
// fraction in the same way. Inverses by Newton's steps for the logarithm of the smaller of p and
// 1 - p.
//
// Shape   a, b in [0.05, 1e6]; probabilities in (0, 1), from 1e-300 on.
// Cost    1 to 5 us for an inverse on one core, 10 us for a of 1e6.
// Promise inverses within 1e-13 of themselves, where they are above 1e-300; probabilities and
//         densities within 1e-13 of themselves, or of what a change of x by 4 units in the last
//         place makes of them. The same bits on every machine, of P and Q for the same release of
//         Boost.
// Source  A. R. DiDonato, A. H. Morris, "Algorithm 708", ACM Trans. Math. Software 18 (1992)
//         360-373, doi:10.1145/131766.131776: the continued fraction, equation 9.
#pragma once

#include "math/arithmetic/double_double.hpp"

namespace stipple {

/// log Gamma(x), x > 0.
double log_gamma(double x);

/// Gamma(x + delta) / Gamma(x).
double gamma_ratio(double x, double delta);

/// a log(ratio), off by at most 2^-62 of itself.
DoubleDouble log_share(double a, const DoubleDouble& ratio);

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
