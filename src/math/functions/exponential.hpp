// SPDX-License-Identifier: MIT
//
// exp(x) from additions, multiplications and the bits of a double, because the C library's exp
// differs between machines.
//
//     x = k ln 2 + r,  |r| <= ln 2 / 2,    exp(x) = 2^k (1 + r + r^2 q(r)),    q by Taylor series.
//
// Shape   x <= 709; exp(x) is exactly 0 below -708.
// Cost    no branches or tables, so that compilers vectorise loops over it.
// Promise within 1 unit in the last place, exp_minus_1(x) within 2, also near 0; exp(0) = 1; the
//         same bits on every machine with IEEE 754 arithmetic, compiled without contraction into
//         fused multiply-adds.
#pragma once

#include <bit>
#include <cstdint>

#include "math/functions/horner.hpp"

namespace stipple {

namespace detail {

/// exp(x) = power * (1 + r + square) with r = high - low, for x in [-708, 709].
struct Exponential {
    double power;
    double high;
    double low;
    double square;
};

[[gnu::always_inline]] inline Exponential exponential_parts(double x) {
    constexpr double per_log = 1.4426950408889634;  // 1 / ln 2
    constexpr double head = 0x1.62e42fee00000p-1;   // ln 2, 33 low bits cleared: k * head is exact
    constexpr double tail = 0x1.a39ef35793c76p-33;
    constexpr double round = 0x1.8p52;  // adding it puts the nearest integer into the low bits
    const double sum = x * per_log + round;
    const double k = sum - round;
    const double high = x - k * head;
    const double low = k * tail;
    const double r = high - low;

    // Coefficients 1/14!, 1/13!, ..., 1/2!.
    const double q = horner(r, 1 / 87178291200.0, 1 / 6227020800.0, 1 / 479001600.0, 1 / 39916800.0,
                            1 / 3628800.0, 1 / 362880.0, 1 / 40320.0, 1 / 5040.0, 1 / 720.0,
                            1 / 120.0, 1 / 24.0, 1 / 6.0, 0.5);
    return {std::bit_cast<double>((std::bit_cast<std::uint64_t>(sum) + 1023) << 52), high, low,
            r * r * q};
}

constexpr double least_exponent = -708;

}  // namespace detail

/// exp(x) for x <= 709.
[[gnu::always_inline]] inline double exponential(double x) {
    const bool inside = x >= detail::least_exponent;
    const auto [power, high, low, square] =
        detail::exponential_parts(inside ? x : detail::least_exponent);
    return inside ? (1 + ((high - low) + square)) * power : 0;
}

/// exp(x) - 1 for x <= 709.
[[gnu::always_inline]] inline double exp_minus_1(double x) {
    const bool inside = x >= detail::least_exponent;
    const auto [power, high, low, square] =
        detail::exponential_parts(inside ? x : detail::least_exponent);
    return power * (high + (square - low)) + (power - 1);
}

}  // namespace stipple
