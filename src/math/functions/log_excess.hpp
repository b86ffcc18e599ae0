// SPDX-License-Identifier: MIT
//
// Factorials of real numbers n >= 0, by Stirling's series for n >= 30 and by recurrence below.
//
// Promise absolute error 4e-15; for log_factorial 4e-15 n log n. The same bits on every machine.
#pragma once

#include <numbers>

#include "math/functions/logarithm.hpp"

namespace stipple {

/// ln(n! / (n^n e^-n)), approximately ln(2 pi n) / 2; 0 at n = 0.
inline double log_excess(double n) {
    if (n < 1e-300) return 0;
    double rise = 0;  // log_excess(n + 1) = log_excess(n) + 1 - n ln(1 + 1 / n)
    for (; n < 30; ++n) rise += 1 - n * log_1p(1 / n);
    // Stirling's series; the next term is below 1e-15.
    const double s = 1 / (n * n);
    const double series = 1.0 / 12 - s * (1.0 / 360 - s * (1.0 / 1260 - s * (1.0 / 1680)));
    return 0.5 * logarithm(2 * std::numbers::pi * n) + series / n - rise;
}

/// ln n!
inline double log_factorial(double n) { return n > 0 ? n * logarithm(n) - n + log_excess(n) : 0; }

}  // namespace stipple
