// SPDX-License-Identifier: MIT
//
// Cholesky factor: the lower triangular L with positive diagonal and L L^T = A, row by row.
//
// Shape   A symmetric, d x d, row after row; its lower triangle is read.
// Cost    d^3 / 3 multiplications and additions.
// Promise the same bits on every machine: only + - * / and square roots are used.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace stipple {

struct Cholesky {
    std::vector<double> factor;  ///< d x d, row after row; complete if `failed` is 0
    /// Size of the first leading minor that is 0 up to rounding errors, or negative; 0 if none is.
    std::size_t failed = 0;
    double minor = 1;  ///< value of the failed minor, or the determinant if `failed` is 0
};

inline Cholesky cholesky(std::span<const double> a, std::size_t d) {
    Cholesky out{.factor = std::vector<double>(d * d)};
    auto& l = out.factor;
    for (std::size_t i = 0; i < d; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double rest = a[i * d + j];
            for (std::size_t k = 0; k < j; ++k) rest -= l[i * d + k] * l[j * d + k];
            if (j < i) {
                l[i * d + j] = rest / l[j * d + j];
                continue;
            }
            out.minor *= rest;
            const double rounding =
                4 * static_cast<double>(d) * std::numeric_limits<double>::epsilon() * a[i * d + i];
            if (!(rest > rounding)) {
                out.failed = i + 1;
                return out;
            }
            l[i * d + i] = std::sqrt(rest);
        }
    }
    return out;
}

}  // namespace stipple
