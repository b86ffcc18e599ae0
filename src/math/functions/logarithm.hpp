// SPDX-License-Identifier: MIT
//
// Natural logarithm from additions, multiplications, one division and the bits of a double, because
// the C library's log differs between machines.
//
//     x = 2^k (1 + f),  sqrt(1/2) <= 1 + f < sqrt(2);    s = f / (2 + f)
//     log(1 + f) = 2 artanh(s) = 2 s + (2/3) s^3 + (2/5) s^5 + ...
//                = f - f^2/2 + s (f^2/2 + (2/3) s^2 + (2/5) s^4 + ...)
//
// Shape   logarithm(x): finite x > 0; log_1p(x) = log(1 + x): finite x > -1.
// Cost    no branches or tables, so that compilers vectorise loops over it.
// Promise within 1 unit in the last place, log_1p also near 0; log(1) = 0 = log_1p(0); the same
//         bits on every machine with IEEE 754 arithmetic, compiled without contraction into fused
//         multiply-adds. logarithm_parts is log(x) to 63 bits.
// Source  The form with f - f^2/2 is that of FDLIBM's e_log.c (Sun Microsystems, 1993).
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "math/arithmetic/double_double.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/horner.hpp"

namespace stipple {

namespace detail {

constexpr double log_2_head = 0x1.62e42fee00000p-1;  // ln 2, 33 low bits cleared: k * head is exact
constexpr double log_2_tail = 0x1.a39ef35793c76p-33;

/// x = 2^k (1 + f) with 1 + f in [sqrt(1/2), sqrt(2)).
struct Fraction {
    double k;
    double f;
};

inline Fraction fraction_of(double x) {
    constexpr double least = 0x1p-1022;
    constexpr std::uint64_t one = 0x3ff0000000000000;
    constexpr std::uint64_t root_half = 0x3fe6a09e667f3bcd;
    const bool tiny = x < least;
    const auto bits = std::bit_cast<std::uint64_t>(tiny ? x * 0x1p54 : x);
    const std::uint64_t biased = (bits + (one - root_half)) >> 52;
    const auto mantissa = std::bit_cast<double>(bits - (biased << 52) + one);
    // 2^52 + biased, built from bits, because vectors cannot convert 64-bit integers.
    const double k = std::bit_cast<double>(0x4330000000000000 | biased) - (0x1p52 + 1023);
    return {tiny ? k - 54 : k, mantissa - 1};
}

/// log(x (1 + rest)) for |rest| of at most a unit in the last place. Always inlined: a call would
/// keep loops from being vectorised.
[[gnu::always_inline]] inline double log_near(double x, double rest) {
    const auto [k, f] = fraction_of(x);
    const double s = f / (2 + f);
    const double z = s * s;
    const double r = horner(z, 2 / 21.0, 2 / 19.0, 2 / 17.0, 2 / 15.0, 2 / 13.0, 2 / 11.0, 2 / 9.0,
                            2 / 7.0, 2 / 5.0, 2 / 3.0);
    const double half = 0.5 * f * f;
    return k * log_2_head - ((half - (s * (half + z * r) + (k * log_2_tail + rest))) - f);
}

}  // namespace detail

/// log(x) for finite x > 0.
[[gnu::always_inline]] inline double logarithm(double x) { return detail::log_near(x, 0); }

/// log(1 + x) for finite x > -1, accurate even if 1 + x is rounded.
[[gnu::always_inline]] inline double log_1p(double x) {
    const double sum = 1 + x;
    const double part = sum - 1;
    const double lost = (1 - (sum - part)) + (x - part);
    return detail::log_near(sum, lost / sum);
}

/// log(x) for finite x > 0, with a relative error of at most 2^-63.
[[gnu::always_inline]] inline DoubleDouble logarithm_parts(double x) {
    const auto [k, f] = detail::fraction_of(x);
    const double below = 2 + f;
    const double below_rest = f - (below - 2);
    const double s = f / below;
    const auto [back, back_rest] = split_product(s, below);
    const double s_rest = (((f - back) - back_rest) - s * below_rest) / below;
    const auto [z, z_rest] = split_product(s, s);

    // The terms z (2/5 + (2/7) z + ...) need only one double.
    const double r = horner(z, 2 / 23.0, 2 / 21.0, 2 / 19.0, 2 / 17.0, 2 / 15.0, 2 / 13.0, 2 / 11.0,
                            2 / 9.0, 2 / 7.0, 2 / 5.0);

    constexpr double third = 2 / 3.0;
    constexpr double third_rest = 0x1.5555555555555p-55;  // 2/3 - third
    const auto [factor, lost] = ordered_sum(third, z * r);
    const double factor_rest = lost + (third_rest + z_rest * r);

    const auto [cube, cube_lost] = split_product(s, z);
    const double cube_rest = cube_lost + (s * (z_rest + 2 * s * s_rest) + s_rest * z);
    const auto [c, c_lost] = split_product(cube, factor);
    const double c_rest = c_lost + (cube_rest * factor + cube * factor_rest);

    const auto [first, first_rest] = ordered_sum(2 * s, c);
    const auto [all, all_rest] = ordered_sum(k * detail::log_2_head, first);
    const double rest = all_rest + (first_rest + ((k * detail::log_2_tail + 2 * s_rest) + c_rest));
    return ordered_sum(all, rest);
}

// Powers with real exponents, without the C library's pow, whose results differ between machines:
//
//     x^y = exp(y log x),    log x to 63 bits, so that y log x keeps its last bits.
//
// Shape   x >= 0 and finite, any finite y; results below exp(-708) = 3.3e-308 are 0, above exp(709)
//         = 8.2e307 infinite.
// Cost    no branches or tables, so that compilers vectorise loops over it.
// Promise within 2 units in the last place; x^0 = 1 = 1^y; 0^y is 0 for y > 0, 1 for y = 0 and
//         infinite for y < 0; the same bits on every machine with IEEE 754 arithmetic, compiled
//         without contraction into fused multiply-adds.

/// x^y for finite x >= 0 and finite y.
[[gnu::always_inline]] inline double real_power(double x, double y) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    constexpr double most = 709;
    constexpr double large = 0x1p63;  // for larger |y|, x^y is 0, 1 or infinite
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
