// SPDX-License-Identifier: MIT
//
// d-th roots of doubles, without the C library's pow, whose results differ from machine to machine.
//
// Promise the same bits on every machine with IEEE 754 arithmetic; within 4 units in the last
// place.
#pragma once

#include <cmath>
#include <cstddef>

namespace stipple {

/// value^(1/degree) for a finite value > 0 and a degree in [1, 64].
inline double nth_root(double value, std::size_t degree) {
    if (degree == 1) return value;
    if (degree == 2) return std::sqrt(value);
    const auto d = static_cast<int>(degree);
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent);  // in [1/2, 1)
    const int whole = (exponent >= 0 ? exponent : exponent - d + 1) / d;
    const double rest = std::ldexp(fraction, exponent - whole * d);  // in [1/2, 2^(d-1))
    // Newton's steps fall from any start that is not below the root, until rounding stops them.
    double root = 2;
    for (double last = 3; root < last;) {
        last = root;
        double power = 1;
        for (int i = 1; i < d; ++i) power *= root;
        root -= (root - rest / power) / d;
    }
    return std::ldexp(root, whole);
}

}  // namespace stipple
