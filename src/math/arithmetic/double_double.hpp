// SPDX-License-Identifier: MIT
//
// Numbers of twice the digits of a double: unevaluated sums of two doubles.
//
// Errors  A sum of numbers of one sign, and a product, are off by at most 2^-100 of themselves. No
//         result may leave the doubles' range, nor come within 2^106 of its lower end.
// Promise the same bits on every machine with IEEE 754 arithmetic.
// Source  T. J. Dekker, Numer. Math. 18 (1971) 224-242, doi:10.1007/BF01397083.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace stipple {

/// high + low, low at most half a unit in the last place of high.
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

/// The same for |a| >= |b| or a = 0, with half of the additions.
inline DoubleDouble ordered_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

/// Product of two doubles, exact. Quick where the processor has fused multiply-adds.
inline DoubleDouble exact_product(double a, double b) {
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
}

/// The same without a fused multiply-add, for loops that are compiled for all processors.
inline DoubleDouble split_product(double a, double b) {
    constexpr std::uint64_t upper = ~0x7ffffffULL;  // 26 bits: products of two are exact
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

}  // namespace stipple
