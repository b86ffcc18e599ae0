// SPDX-License-Identifier: MIT
//
// Numbers of twice the digits of a double: unevaluated sums of two doubles.
//
// Errors  A sum of numbers of one sign, and a product, are off by at most 2^-100 of themselves. No
//         result may leave the doubles' range, nor come within 2^106 of its lower end.
// Source  T. J. Dekker, Numer. Math. 18 (1971) 224-242, doi:10.1007/BF01397083.
#pragma once

#include <cmath>

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

/// Product of two doubles, exact.
inline DoubleDouble exact_product(double a, double b) {
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
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
