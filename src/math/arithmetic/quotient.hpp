// SPDX-License-Identifier: MIT
//
// Quotients of numbers of twice the digits of a double, off by at most 2^-98 of themselves.
#pragma once

#include "math/arithmetic/double_double.hpp"

namespace stipple {

inline DoubleDouble quotient(const DoubleDouble& a, const DoubleDouble& b) {
    const double q = a.high / b.high;
    const DoubleDouble back = DoubleDouble{q, 0} * b;
    return exact_sum(q, ((a.high - back.high) + (a.low - back.low)) / b.high);
}

}  // namespace stipple
