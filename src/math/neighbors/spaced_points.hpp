// SPDX-License-Identifier: MIT
//
// Distances in a box; cells so small that each holds at most one of several points with a minimum
// distance; and dispatch from a dimension to code compiled for it.
//
//     distance^2 = sum_k d_k^2,    d_k = |p_k - q_k|,  on the torus min(d_k, side_k - d_k).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/domain.hpp"

namespace stipple {

/// Squared distance in a box with these sides; also across its faces if they are joined (torus).
template <std::size_t D>
double squared_distance(const double* p, const double* q, const std::array<double, D>& sides,
                        bool torus) {
    double sum = 0;
    for (std::size_t k = 0; k < D; ++k) {
        double d = std::abs(p[k] - q[k]);
        if (torus) d = std::min(d, sides[k] - d);
        sum += d * d;
    }
    return sum;
}

/// Number of cells along each direction of a box, with diagonals below `radius`; as doubles,
/// because integers might overflow.
inline std::vector<double> cells_along(const Box& box, double radius) {
    constexpr double safety = 1 + 1e-9;  // makes up for rounding errors
    std::vector<double> cells;
    for (std::size_t k = 0; k < box.dimension(); ++k) {
        const double most = radius / std::sqrt(static_cast<double>(box.dimension()));
        cells.push_back(std::floor(box.extent(k) / most * safety) + 1);
    }
    return cells;
}

/// Calls work.template operator()<D>() for D == dimension in First, ..., Last.
template <std::size_t Last, std::size_t First = 1, class Work>
auto with_dimension(std::size_t dimension, Work&& work) {
    if constexpr (First < Last)
        if (dimension > First) return with_dimension<Last, First + 1>(dimension, work);
    return work.template operator()<First>();
}

}  // namespace stipple
