// SPDX-License-Identifier: MIT
//
// Numbers with twice the precision of a double: unevaluated sums of two doubles.
//
// Errors  The relative error of a product, and of a sum of numbers of one sign, is at most 2^-100.
//         No result may overflow or be within a factor of 2^106 of the smallest double.
// Promise the same bits on every machine with IEEE 754 arithmetic.
// Source  T. J. Dekker, Numer. Math. 18 (1971) 224-242, doi:10.1007/BF01397083.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace stipple {

/// The number high + low, with |low| at most half a unit in the last place of high.
struct DoubleDouble {
    double high = 0;
    double low = 0;
};

/// Sum of two doubles, exact.
inline DoubleDouble exact_sum(double a, double b) {
    const double sum = a + b;
    const double part = sum - a;
    return {sum, (a - (sum - part)) + (b - part)};
}

/// Exact sum for |a| >= |b| or a = 0, with half the additions.
inline DoubleDouble ordered_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

/// Product of two doubles, exact. Fast on processors with fused multiply-adds.
inline DoubleDouble exact_product(double a, double b) {
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
}

/// Product of two doubles with a relative error of at most 2^-104, without fused multiply-adds, for
/// loops on any processor.
inline DoubleDouble split_product(double a, double b) {
    constexpr std::uint64_t upper = ~0x7ffffffULL;  // keeps 26 bits; a_low * b_low may round
    const auto a_high = std::bit_cast<double>(std::bit_cast<std::uint64_t>(a) & upper);
    const auto b_high = std::bit_cast<double>(std::bit_cast<std::uint64_t>(b) & upper);
    const double a_low = a - a_high;
    const double b_low = b - b_high;
    const double product = a * b;
    const double rest =
        ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    return {product, rest};
}

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = exact_sum(a.high, b.high);
    return exact_sum(high.high, high.low + (a.low + b.low));
}

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = exact_product(a.high, b.high);
    return exact_sum(high.high, high.low + (a.high * b.low + a.low * b.high));
}

// Running sums with a second sum of all rounding errors, so that each result is rounded about once.
//
// Promise sums of numbers >= 0 never decrease, and do not change if a number is 0; relative error
//         at most 2^-53 + n 2^-106. The same bits on every machine.
// Source  A. Neumaier, Z. angew. Math. Mech. 54 (1974) 39-51, doi:10.1002/zamm.19740540106.

/// Returns x_1, x_1 + x_2, ... for numbers >= 0.
inline std::vector<double> running_sums(std::span<const double> numbers) {
    std::vector<double> sums;
    sums.reserve(numbers.size());
    double sum = 0;
    double lost = 0;
    double last = 0;
    for (const double x : numbers) {
        const double next = sum + x;
        lost += sum >= x ? (sum - next) + x : (x - next) + sum;
        sum = next;
        if (x > 0) last = std::max(last, sum + lost);  // rounding must not make sums decrease
        sums.push_back(last);
    }
    return sums;
}

}  // namespace stipple
