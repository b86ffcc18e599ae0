// SPDX-License-Identifier: MIT
//
// Eigenvalues and eigenvectors of a small symmetric matrix, by Jacobi's rotations.
//
// Shape   A symmetric, d x d, row after row, with entries of about 1, as correlations are: rotations
//         end when none of the entries off the diagonal is above 1e-15.
// Cost    about six sweeps, each about 10 d^3 multiplications and additions.
// Promise the same bits on every machine: only + - * / and square roots are used.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace stipple {

struct Eigen {
    std::vector<double> values;
    std::vector<double> vectors;  ///< d x d, an eigenvector in each column
};

inline Eigen jacobi_eigen(std::vector<double> a, std::size_t d) {
    Eigen out{.values = std::vector<double>(d), .vectors = std::vector<double>(d * d)};
    auto& v = out.vectors;
    for (std::size_t i = 0; i < d; ++i) v[i * d + i] = 1;
    for (int sweep = 0; sweep < 60; ++sweep) {
        double off = 0;
        for (std::size_t p = 0; p < d; ++p)
            for (std::size_t q = p + 1; q < d; ++q) {
                const double pq = a[p * d + q];
                off = std::max(off, std::abs(pq));
                if (std::abs(pq) < 1e-300) continue;
                const double theta = (a[q * d + q] - a[p * d + p]) / (2 * pq);
                const double t =
                    std::copysign(1, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
                const double c = 1 / std::sqrt(t * t + 1);
                const double s = t * c;
                const auto turn = [&](double& x, double& y) {
                    const double old = x;
                    x = c * old - s * y;
                    y = s * old + c * y;
                };
                for (std::size_t k = 0; k < d; ++k) turn(a[k * d + p], a[k * d + q]);
                for (std::size_t k = 0; k < d; ++k) turn(a[p * d + k], a[q * d + k]);
                for (std::size_t k = 0; k < d; ++k) turn(v[k * d + p], v[k * d + q]);
            }
        if (off < 1e-15) break;
    }
    for (std::size_t i = 0; i < d; ++i) out.values[i] = a[i * d + i];
    return out;
}

}  // namespace stipple
