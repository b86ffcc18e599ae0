// SPDX-License-Identifier: MIT
//
// Polynomials by Horner's rule.
#pragma once

namespace stipple {

/// Returns (...(first x + second) x + ...) x + last. Has no loop, so callers' loops vectorise.
template <class... Coefficients>
[[gnu::always_inline]] constexpr double horner(double x, double first, Coefficients... rest) {
    double sum = first;
    ((sum = sum * x + rest), ...);
    return sum;
}

}  // namespace stipple
