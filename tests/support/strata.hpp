// SPDX-License-Identifier: MIT
//
// Counts points in strata, in integers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/point_set.hpp"
#include "support/exact.hpp"

namespace stipple::testing {

/// floor(x parts) by exact arithmetic.
inline std::uint64_t stratum_of(double x, std::uint64_t parts) {
    const Fraction scaled = exactly(x) * parts;
    return static_cast<std::uint64_t>(numerator(scaled) / denominator(scaled));
}

/// Whether each of n strata along every coordinate contains one of the n points, both in exact
/// arithmetic and by floor(x n) in floating point.
inline bool is_latin(const PointSet& points) {
    const std::size_t n = points.count();
    for (std::size_t k = 0; k < points.dimension(); ++k) {
        std::vector<bool> hit(n);
        for (std::size_t i = 0; i < n; ++i) {
            const std::uint64_t at = stratum_of(points[i][k], n);
            if (hit[at] || at != static_cast<std::uint64_t>(points[i][k] * static_cast<double>(n)))
                return false;
            hit[at] = true;
        }
    }
    return true;
}

/// Whether all cells of a grid with `levels` cells along the given coordinates contain equally many
/// points.
inline bool is_balanced(const PointSet& points, std::uint64_t levels,
                        const std::vector<std::size_t>& coordinates) {
    std::uint64_t cells = 1;
    for (std::size_t l = 0; l < coordinates.size(); ++l) cells *= levels;
    std::vector<std::uint64_t> held(cells);
    for (std::size_t i = 0; i < points.count(); ++i) {
        std::uint64_t cell = 0;
        for (const std::size_t k : coordinates)
            cell = cell * levels + stratum_of(points[i][k], levels);
        ++held[cell];
    }
    return std::ranges::all_of(held, [&](auto h) { return h * cells == points.count(); });
}

/// Whether every choice of `strength` coordinates is balanced: an orthogonal array by definition.
inline bool has_strength(const PointSet& points, std::uint64_t levels, std::size_t strength) {
    const std::size_t d = points.dimension();
    std::vector<bool> chosen(d);
    std::fill_n(chosen.begin(), std::min(strength, d), true);
    do {
        std::vector<std::size_t> coordinates;
        for (std::size_t k = 0; k < d; ++k)
            if (chosen[k]) coordinates.push_back(k);
        if (!is_balanced(points, levels, coordinates)) return false;
    } while (std::prev_permutation(chosen.begin(), chosen.end()));
    return true;
}

}  // namespace stipple::testing
