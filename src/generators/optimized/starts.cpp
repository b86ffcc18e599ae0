// SPDX-License-Identifier: MIT
#include "generators/optimized/starts.hpp"

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"

namespace stipple::optimized {
namespace {

/// The root above 1 of g^(m+1) = g + 1, by Newton's method.
double golden_root(std::size_t m) {
    double g = 2;
    for (int i = 0; i < 60; ++i) {
        double power = 1;
        for (std::size_t k = 0; k < m; ++k) power *= g;
        g -= (power * g - g - 1) / ((static_cast<double>(m) + 1) * power - 1);
    }
    return g;
}

}  // namespace

std::vector<double> kronecker_rows(std::size_t count, std::size_t dimension, bool stepped,
                                   SplitMix64& draws) {
    const double root = golden_root(stepped ? dimension - 1 : dimension);
    std::vector<double> rows(count * dimension);
    double step = 1;
    for (std::size_t j = 0; j < dimension; ++j) {
        const double shift = to_unit(draws.next());
        const bool even = stepped && j == 0;
        if (!even) step /= root;
        for (std::size_t i = 0; i < count; ++i) {
            const auto at = static_cast<double>(i);
            const double x = even ? (at + shift) / static_cast<double>(count) : at * step + shift;
            rows[i * dimension + j] = std::min(x - std::floor(x), one_minus_ulp);
        }
    }
    return rows;
}

}  // namespace stipple::optimized
