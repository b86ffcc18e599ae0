// SPDX-License-Identifier: MIT
//
// The incomplete gamma and beta functions, regularised, and their inverses:
//
//     P(a, x) = integral of t^(a-1) exp(-t) from 0 to x / Gamma(a),              Q = 1 - P,
//     I_x(a, b) = integral of t^(a-1) (1-t)^(b-1) from 0 to x / B(a, b).
//
// I_x is x^a (1-x)^b / B(a, b) divided by a continued fraction, computed for the thinner tail. With
// n = a + b, the dividend is
//
//     exp(s(n) - s(a) - s(b)) a b / n (n x / a)^a (n (1-x) / b)^b,    s = log_excess,
//
// whose logarithm is computed to twice the precision of a double, so that neither B(a, b) nor the
// powers underflow or lose digits. P and Q use Boost.Math over our own elementary functions
// (portable_double.hpp). For a above 200 and far from the mean they use a series and a continued
// fraction in the same way. Inverses use Newton steps on the logarithm of the smaller of p and 1 -
// p.
//
// Shape   a, b in [0.05, 1e6]; probabilities in [1e-300, 1).
// Cost    1 to 5 us for an inverse on one core, 10 us for a of 1e6.
// Promise relative error 1e-13 of inverses above 1e-300. Probabilities and densities have a
//         relative error of 1e-13, or the error from changing x by 4 units in the last place. The
//         same bits on every machine; for P and Q, with the same release of Boost.
// Source  A. R. DiDonato, A. H. Morris, "Algorithm 708", ACM Trans. Math. Software 18 (1992)
//         360-373, doi:10.1145/131766.131776: the continued fraction, equation 9.
#pragma once

#include "math/arithmetic/double_double.hpp"

namespace stipple {

/// log Gamma(x), x > 0.
double log_gamma(double x);

/// Gamma(x + delta) / Gamma(x).
double gamma_ratio(double x, double delta);

/// a log(ratio), with an error of at most 2^-62 of its value or 2^-105 a, whichever is larger.
DoubleDouble log_share(double a, const DoubleDouble& ratio);

double gamma_below(double a, double x);    ///< P(a, x)
double gamma_above(double a, double x);    ///< Q(a, x)
double gamma_density(double a, double x);  ///< dP(a, x) / dx

/// Returns the x with P(a, x) = p, or with Q(a, x) = q.
double gamma_quantile(double a, double p);
double gamma_upper_quantile(double a, double q);

double beta_below(double a, double b, double x);    ///< I_x(a, b)
double beta_above(double a, double b, double x);    ///< 1 - I_x(a, b)
double beta_density(double a, double b, double x);  ///< dI_x(a, b) / dx for x < 1

/// x and 1 - x, each accurate to its last digits.
struct Shares {
    double x;
    double rest;
};

/// Returns the x with I_x(a, b) = p.
Shares beta_quantile(double a, double b, double p);

}  // namespace stipple
