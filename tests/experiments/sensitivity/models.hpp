// SPDX-License-Identifier: MIT
//
// Models whose indices have closed forms, and designs by simple loops.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/rng.hpp"
#include "support/units.hpp"

namespace stipple::testing::sensitivity {

using Model = std::function<double(std::span<const double>)>;

/// Ishigami's function of three numbers in [0, 1), with a = 7, b = 0.1. Its indices are worked out in
/// A. Saltelli et al., "Global Sensitivity Analysis. The Primer", Wiley 2008: with
/// V = a^2/8 + b pi^4/5 + b^2 pi^8/18 + 1/2, V_1 = (1 + b pi^4/5)^2 / 2, V_2 = a^2/8 and
/// V_13 = b^2 pi^8 8/225.
inline double ishigami(std::span<const double> u) {
    const double pi = std::numbers::pi;
    const auto x = [&](std::size_t i) { return pi * (2 * u[i] - 1); };
    const double s = std::sin(x(1));
    return std::sin(x(0)) + 7 * s * s + 0.1 * std::pow(x(2), 4) * std::sin(x(0));
}
inline const std::vector<double> ishigami_first = {0.31390519, 0.44241114, 0};
inline const std::vector<double> ishigami_total = {0.55758886, 0.44241114, 0.24368366};

/// Sobol's g-function: prod (|4 u_i - 2| + a_i) / (1 + a_i), where the factors have the variances
/// v_i = 1 / (3 (1 + a_i)^2) and the mean 1.
inline const std::vector<double> g_parameters = {0, 1, 4.5, 9};
inline double g_function(std::span<const double> u) {
    double product = 1;
    for (std::size_t i = 0; i < u.size(); ++i)
        product *= (std::abs(4 * u[i] - 2) + g_parameters[i]) / (1 + g_parameters[i]);
    return product;
}
inline double g_variance(std::size_t i) { return 1 / (3 * std::pow(1 + g_parameters[i], 2)); }
inline double g_all() {
    double product = 1;
    for (std::size_t i = 0; i < g_parameters.size(); ++i) product *= 1 + g_variance(i);
    return product - 1;
}
inline double g_first(std::size_t i) { return g_variance(i) / g_all(); }
inline double g_total(std::size_t i) {
    return g_variance(i) / (1 + g_variance(i)) * (1 + g_all()) / g_all();
}

/// 3 u_1 + 2 u_2 + u_3: S_i = c_i^2 / 14, exactly.
inline double linear(std::span<const double> u) { return 3 * u[0] + 2 * u[1] + u[2]; }

/// The rows, each followed by the model's value.
inline PointSet with_outputs(const std::vector<std::vector<double>>& rows, const Model& model) {
    std::vector<std::vector<double>> all = rows;
    for (std::size_t i = 0; i < rows.size(); ++i) all[i].push_back(model(rows[i]));
    return points_of(all);
}

using Rows = std::vector<std::vector<double>>;

inline Rows points_in(const PointSet& points) {
    Rows rows;
    for (std::size_t i = 0; i < points.count(); ++i)
        rows.emplace_back(points[i].begin(), points[i].end());
    return rows;
}

/// A, AB_1, ..., AB_k, [BA_1, ..., BA_k,] B for each point, whose halves are A and B.
inline Rows pick_freeze_rows(const PointSet& base, bool pairs) {
    const std::size_t k = base.dimension() / 2;
    Rows rows;
    for (std::size_t r = 0; r < base.count(); ++r) {
        const std::vector<double> a(base[r].begin(), base[r].begin() + static_cast<long>(k));
        const std::vector<double> b(base[r].begin() + static_cast<long>(k), base[r].end());
        const auto mixed = [&](std::vector<double> whole, const std::vector<double>& other,
                               std::size_t i) {
            whole[i] = other[i];
            return whole;
        };
        rows.push_back(a);
        for (std::size_t i = 0; i < k; ++i) rows.push_back(mixed(a, b, i));
        for (std::size_t i = 0; i < k && pairs; ++i) rows.push_back(mixed(b, a, i));
        rows.push_back(b);
    }
    return rows;
}

/// r trajectories on the levels 0, 1/3, 2/3, 1 with steps of 2/3, in random orders and directions.
inline Rows morris_rows(std::size_t r, std::size_t k, std::uint64_t seed) {
    Rows rows;
    for (std::size_t t = 0; t < r; ++t) {
        const Rng rng(seed, t);
        std::vector<double> x(k);
        std::vector<std::size_t> order(k);
        for (std::size_t i = 0; i < k; ++i) {
            x[i] = static_cast<double>(rng.below(i, 4)) / 3;
            order[i] = i;
        }
        for (std::size_t i = 0; i < k; ++i) std::swap(order[i], order[rng.below(k + i, k)]);
        rows.push_back(x);
        for (const std::size_t i : order) {
            x[i] += x[i] < 0.5 ? 2. / 3 : -2. / 3;
            rows.push_back(x);
        }
    }
    return rows;
}

/// Curves of extended FAST with M = 4, as in SALib's fast_sampler.
inline Rows fast_rows(std::size_t n, std::size_t k, std::uint64_t seed) {
    const double pi = std::numbers::pi;
    constexpr std::size_t harmonics = 4;
    const std::size_t high = (n - 1) / (2 * harmonics);
    const std::size_t most = high / (2 * harmonics);
    Rows rows;
    for (std::size_t i = 0; i < k; ++i) {
        const double phase = 2 * pi * Rng(seed, i).uniform(0);
        for (std::size_t s = 0; s < n; ++s) {
            std::vector<double> x;
            for (std::size_t j = 0, other = 0; j < k; ++j) {
                std::size_t w = high;
                if (j != i && k > 2 && most >= k - 1)
                    w = 1 + other * (most - 1) / (k - 2);
                else if (j != i)
                    w = other % most + 1;
                other += j != i;
                const double angle =
                    2 * pi * static_cast<double>(w * s % n) / static_cast<double>(n) + phase;
                x.push_back(0.5 + std::asin(std::sin(angle)) / pi);
            }
            rows.push_back(x);
        }
    }
    return rows;
}

}  // namespace stipple::testing::sensitivity
