// SPDX-License-Identifier: MIT
//
// Powers with real exponents, without the C library's pow, whose results differ from machine to
// machine:
//
//     x^y = exp(y log x),    log x to 63 bits, so that its product with y keeps its last bits.
//
// Shape   x >= 0 and finite, any finite y; results below exp(-708) = 3.3e-308 are 0, above exp(709)
//         = 8.2e307 infinite.
// Cost    no branch and no table, so that compilers vectorise loops of it.
// Promise within 2 units in the last place; x^0 = 1 = 1^y; 0^y is 0, 1 or infinite as y is above,
//         at or below 0; the same bits on every machine with IEEE 754 arithmetic, compiled without
//         contraction into fused multiply-adds.
#pragma once

#include <limits>

#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple {

/// x^y for finite x >= 0 and finite y.
[[gnu::always_inline]] inline double real_power(double x, double y) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    constexpr double most = 709;
    constexpr double large = 0x1p63;  // beyond, x = 1 alone has a finite power that is not 0
    const double bounded = y > large ? large : (y < -large ? -large : y);
    const auto [high, low] = logarithm_parts(x > 0 ? x : 0x1p-1022);
    const auto [exponent, rest] = split_product(high, bounded);
    const double inside = exponent < most ? exponent : most;
    const double power = exponential(inside);
    const double result = power + power * (rest + low * bounded);
    const double finite = exponent < most ? result : infinite;
    const double at_zero = y > 0 ? 0 : (y < 0 ? infinite : 1);
    return x > 0 ? finite : at_zero;
}

}  // namespace stipple
