// SPDX-License-Identifier: MIT
//
// Quotients of double-double numbers, with a relative error of at most 2^-98.
#pragma once

#include "math/arithmetic/double_double.hpp"

namespace stipple {

inline DoubleDouble quotient(const DoubleDouble& a, const DoubleDouble& b) {
    const double q = a.high / b.high;
    const DoubleDouble back = DoubleDouble{q, 0} * b;
    return exact_sum(q, ((a.high - back.high) + (a.low - back.low)) / b.high);
}

}  // namespace stipple
