// SPDX-License-Identifier: MIT
//
// Distribution function of the standard normal distribution, without the C library's erfc, whose
// results differ from machine to machine:
//
//     Phi(z) = erfc(-z / sqrt(2)) / 2,    x = |z| / sqrt(2):
//
//     x <= 15/32    Phi(z) = 1/2 + z A(x^2) / sqrt(8)
//     x <= 4        erfc(x) = exp(-x^2) C(x)
//     beyond        erfc(x) = exp(-x^2) (1 / sqrt(pi) - P(x^-2) / x^2) / x
//
// with rational functions A, C and P. exp(-x^2) is exp(-z^2 / 2), whose exponent is taken to twice
// the working precision.
//
// Shape   any z that is not NaN, also infinite.
// Promise within 8 units in the last place down to Phi(-37.5) = 4.6e-308, and 0 below; 1 - Phi(z)
//         is Phi(-z) up to rounding. The same bits on every machine with IEEE 754 arithmetic,
//         compiled without contraction into fused multiply-adds.
// Source  W. J. Cody, "Rational Chebyshev approximations for the error function", Mathematics of
//         Computation 23 (1969) 631-637, doi:10.1090/S0025-5718-1969-0247736-4.
#pragma once

namespace stipple {

/// Phi(z), accurate in the lower tail, too.
double normal_distribution(double z);

}  // namespace stipple
