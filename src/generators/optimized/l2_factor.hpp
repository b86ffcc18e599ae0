// SPDX-License-Identifier: MIT
//
// Factor of an L2 kernel on one axis, in double precision.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "math/l2/axis_factor.hpp"

namespace stipple::optimized {

/// The function a[0] + a[1] x + a[2] x^2 + a[3] |x - 1/2|.
struct Curve {
    std::array<double, 4> a{};

    explicit Curve(const l2::AxisFactor::Curve& of) {
        for (std::size_t i = 0; i < a.size(); ++i) a[i] = static_cast<double>(of[i]);
    }
    [[nodiscard]] double at(double x) const {
        return a[0] + (a[1] + a[2] * x) * x + a[3] * std::abs(x - 0.5);
    }
    [[nodiscard]] double slope(double x) const {
        return a[1] + 2 * a[2] * x + (x < 0.5 ? -a[3] : a[3]);
    }
};

/// The factor own(x) + own(y) + product x y + distance |x - y|.
struct Factor {
    explicit Factor(const l2::AxisFactor& of)
        : own(of.own),
          mean(of.mean),
          product(static_cast<double>(of.product)),
          distance(static_cast<double>(of.distance)),
          total(static_cast<double>(of.total)) {}

    [[nodiscard]] double at(double x, double y) const {
        return (own.at(x) + own.at(y)) + product * (x * y) + distance * std::abs(x - y);
    }

    Curve own;
    Curve mean;
    double product;
    double distance;
    double total;
};

/// Factors of all axes.
inline std::vector<Factor> factors_of(l2::Kind kind, const l2::AxisWeights& weights,
                                      std::size_t dimension) {
    const bool alone = l2::is_kernel_alone(kind, weights);
    std::vector<Factor> factors;
    for (std::size_t j = 0; j < dimension; ++j)
        factors.emplace_back(l2::AxisFactor(kind, alone, l2::weight_of(weights, j)));
    return factors;
}

}  // namespace stipple::optimized
