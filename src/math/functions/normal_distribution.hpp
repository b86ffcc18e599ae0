// SPDX-License-Identifier: MIT
//
// The standard normal distribution. Its distribution function avoids the C library's erfc, whose
// results differ between machines:
//
//     Phi(z) = erfc(-z / sqrt(2)) / 2,    x = |z| / sqrt(2):
//
//     x <= 15/32    Phi(z) = 1/2 + z A(x^2) / sqrt(8)
//     x <= 4        erfc(x) = exp(-x^2) C(x)
//     beyond        erfc(x) = exp(-x^2) (1 / sqrt(pi) - P(x^-2) / x^2) / x
//
// with rational functions A, C and P. exp(-x^2) is exp(-z^2 / 2), whose exponent is computed to
// twice the working precision. Quantiles, the x with Phi(x) = p, use other rational functions B, D
// and E. With q = p - 1/2 and r = sqrt(-log min(p, 1 - p)),
//
//     x = q B(0.180625 - q^2)   if |q| <= 0.425,
//     x = sign(q) D(r - 1.6)    else, if r <= 5,        x = sign(q) E(r - 5)   beyond.
//
// Shape   any z that is not NaN, also infinite; p from 1e-300 up to 1 - 2^-53, the largest double
//         below 1; 1 - p is exact above 1/2.
// Cost    a quantile has no branches or tables, so that compilers vectorise loops over it.
// Promise within 8 units in the last place: Phi(z) down to Phi(-37.5) = 4.6e-308, and 0 below;
//         quantiles in the tails, too. 1 - Phi(z) is Phi(-z) up to rounding; x(1 - p) = -x(p) where
//         1 - p is a double. The same bits on every machine with IEEE 754 arithmetic, compiled
//         without contraction into fused multiply-adds.
// Source  W. J. Cody, "Rational Chebyshev approximations for the error function", Mathematics of
//         Computation 23 (1969) 631-637, doi:10.1090/S0025-5718-1969-0247736-4; M. J. Wichura,
//         "Algorithm AS 241: the percentage points of the normal distribution", Applied Statistics
//         37 (1988) 477-484, doi:10.2307/2347330: PPND16.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "math/functions/logarithm.hpp"

namespace stipple {

/// Phi(z), also accurate in the lower tail.
double normal_distribution(double z);

/// erf(x), also accurate near 0; within 4 units in the last place.
double error_function(double x);

namespace detail {

/// Quotient of two polynomials of degree 7; coefficients from the constant term on.
struct Rational {
    std::array<double, 8> above;
    std::array<double, 8> below;

    double operator()(double r) const {
        double p = above[7];
        double q = below[7];
        for (std::size_t i = 7; i-- > 0;) {
            p = p * r + above[i];
            q = q * r + below[i];
        }
        return p / q;
    }
};

constexpr Rational quantile_middle{
    {3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
     1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
     3.3430575583588128105e4, 2.5090809287301226727e3},
    {1.0, 4.2313330701600911252e1, 6.8718700749205790830e2, 5.3941960214247511077e3,
     2.1213794301586595867e4, 3.9307895800092710610e4, 2.8729085735721942674e4,
     5.2264952788528545610e3}};

constexpr Rational quantile_tail{
    {1.42343711074968357734e0, 4.63033784615654529590e0, 5.76949722146069140550e0,
     3.64784832476320460504e0, 1.27045825245236838258e0, 2.41780725177450611770e-1,
     2.27238449892691845833e-2, 7.74545014278341407640e-4},
    {1.0, 2.05319162663775882187e0, 1.67638483018380384940e0, 6.89767334985100004550e-1,
     1.48103976427480074590e-1, 1.51986665636164571966e-2, 5.47593808499534494600e-4,
     1.05075007164441684324e-9}};

constexpr Rational quantile_far_tail{
    {6.65790464350110377720e0, 5.46378491116411436990e0, 1.78482653991729133580e0,
     2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
     2.71155556874348757815e-5, 2.01033439929228813265e-7},
    {1.0, 5.99832206555887937690e-1, 1.36929880922735805310e-1, 1.48753612908506148525e-2,
     7.86869131145613259100e-4, 1.84631831751005468180e-5, 1.42151175831644588870e-7,
     2.04426310338993978564e-15}};

/// Quantile of p = 1/2 + q, with m = min(p, 1 - p).
inline double normal_quantile(double q, double m) {
    const double middle = q * quantile_middle(0.180625 - q * q);
    const double r = std::sqrt(-logarithm(m));
    const double near = quantile_tail(r - 1.6);
    const double far = quantile_far_tail(r - 5);
    const double tail = std::copysign(r <= 5 ? near : far, q);
    return std::abs(q) <= 0.425 ? middle : tail;
}

/// Quantile of p = 1/2 + q without the far tail, for m = min(p, 1 - p) >= exp(-25) = 1.39e-11.
[[gnu::always_inline]] inline double near_normal_quantile(double q, double m) {
    const double middle = q * quantile_middle(0.180625 - q * q);
    const double tail = std::copysign(quantile_tail(std::sqrt(-logarithm(m)) - 1.6), q);
    return std::abs(q) <= 0.425 ? middle : tail;
}

/// min(p, 1 - p), at least 1e-300; 2^-54 for p = 0, 2^-55 for p = 1.
inline double bounded_tail(double p) {
    const double m = std::min(p, 1 - p);
    const double least = p < 0.5 ? 0x1p-54 : 0x1p-55;
    return m > 0 ? std::max(m, 1e-300) : least;
}

}  // namespace detail

/// The x with Phi(x) = p, for p in (0, 1).
inline double normal_quantile(double p) {
    return detail::normal_quantile(p - 0.5, std::min(p, 1 - p));
}

/// The x with Phi(x) = p, for p in [0, 1]. A positive p below 1e-300 is raised to 1e-300. p = 0 is
/// replaced by 2^-54, the middle of the lowest step of random numbers: x = -8.2924. p = 1, which
/// random numbers never reach, is replaced by 1 - 2^-55: x = 8.3744.
inline double bounded_normal_quantile(double p) {
    return detail::normal_quantile(p - 0.5, detail::bounded_tail(p));
}

/// Applies bounded_normal_quantile to many p in place; batches with far tails are slower.
void bounded_normal_quantiles(std::span<double> p);

}  // namespace stipple
