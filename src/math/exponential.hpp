// SPDX-License-Identifier: MIT
//
// exp(x) by additions, multiplications and the bits of a double: the mathematics library's own
// differs between machines.
//
//     x = k ln 2 + r,  |r| <= ln 2 / 2,    exp(x) = 2^k (1 + r + r^2 q(r)),    q by Taylor's
//     series.
//
// Shape   x <= 709; exactly 0 below -708.
// Cost    no branch and no table, so that compilers vectorise loops of it.
// Promise within 1 unit in the last place; exp(0) = 1; the same bits on every machine with IEEE 754
//         arithmetic, compiled without contraction into fused multiply-adds.
#pragma once

#include <bit>
#include <cstdint>

namespace stipple {

inline double exponential(double x) {
    constexpr double least = -708;
    constexpr double per_log = 1.4426950408889634;  // 1 / ln 2
    constexpr double head = 0x1.62e42fee00000p-1;   // ln 2, its last 33 bits 0: k * head is exact
    constexpr double tail = 0x1.a39ef35793c76p-33;
    constexpr double round = 0x1.8p52;  // adding it leaves the nearest whole number in the low bits
    const double inside = x > least ? x : least;
    const double sum = inside * per_log + round;
    const double k = sum - round;
    const double r = (inside - k * head) - k * tail;

    double q = 1 / 87178291200.0;  // 1/14!, then 1/13!, ...
    q = q * r + 1 / 6227020800.0;
    q = q * r + 1 / 479001600.0;
    q = q * r + 1 / 39916800.0;
    q = q * r + 1 / 3628800.0;
    q = q * r + 1 / 362880.0;
    q = q * r + 1 / 40320.0;
    q = q * r + 1 / 5040.0;
    q = q * r + 1 / 720.0;
    q = q * r + 1 / 120.0;
    q = q * r + 1 / 24.0;
    q = q * r + 1 / 6.0;
    q = q * r + 0.5;
    const double mantissa = 1 + (r + r * r * q);
    const auto power = std::bit_cast<double>((std::bit_cast<std::uint64_t>(sum) + 1023) << 52);
    return x >= least ? mantissa * power : 0;
}

}  // namespace stipple
