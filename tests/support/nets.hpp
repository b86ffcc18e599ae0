// SPDX-License-Identifier: MIT
//
// The (t,m,s)-net property in base b by its definition: every elementary interval
//
//     [a_1 / b^k_1, (a_1 + 1) / b^k_1) x ... ,    k_1 + ... + k_s = m - t,
//
// holds exactly b^t of the b^m points. Counted in integers: a coordinate is in the last cell whose
// lower edge, rounded to the nearest double, is not above it. That is the true cell of every
// correctly rounded number a / b^m, while floor(x b^m) may be too small by one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/point_set.hpp"

namespace stipple::testing {

inline std::uint64_t whole_power(std::uint64_t base, std::size_t exponent) {
    std::uint64_t power = 1;
    while (exponent-- > 0) power *= base;
    return power;
}

/// Returns m with base^m == count; the largest std::size_t if there is none.
inline std::size_t whole_logarithm(std::uint64_t count, std::uint64_t base) {
    std::size_t m = 0;
    while (whole_power(base, m) < count) ++m;
    return whole_power(base, m) == count ? m : ~std::size_t{0};
}

/// Index of the cell of width 1 / parts that contains x; parts < 2^53.
inline std::uint64_t cell_of(double x, std::uint64_t parts) {
    const auto edge = [&](std::uint64_t k) {
        return static_cast<double>(k) / static_cast<double>(parts);
    };
    auto k = static_cast<std::uint64_t>(x * static_cast<double>(parts));
    while (edge(k + 1) <= x) ++k;
    while (edge(k) > x) --k;
    return k;
}

namespace detail {

/// Whether all elementary intervals contain equally many points if `digits` more digits are
/// distributed over the coordinates from `k` on.
/// @param interval index of each point's interval so far
inline bool evenly_filled(const std::vector<std::vector<std::uint64_t>>& cells, std::uint64_t base,
                          std::size_t m, std::size_t digits, std::size_t k,
                          const std::vector<std::uint64_t>& interval, std::uint64_t intervals) {
    const std::size_t n = interval.size();
    const bool last = k + 1 == cells.size();
    for (std::size_t own = last ? digits : 0; own <= digits; ++own) {
        const std::uint64_t drop = whole_power(base, m - own);
        const std::uint64_t parts = whole_power(base, own);
        std::vector<std::uint64_t> finer(n);
        for (std::size_t i = 0; i < n; ++i) finer[i] = interval[i] * parts + cells[k][i] / drop;
        if (!last) {
            if (!evenly_filled(cells, base, m, digits - own, k + 1, finer, intervals * parts))
                return false;
            continue;
        }
        std::vector<std::uint64_t> held(intervals * parts);
        for (const std::uint64_t at : finer) ++held[at];
        if (std::ranges::any_of(held, [&](auto h) { return h != n / held.size(); })) return false;
    }
    return true;
}

inline std::vector<std::vector<std::uint64_t>> cells_of(const PointSet& points, std::uint64_t base,
                                                        std::size_t m) {
    std::vector<std::vector<std::uint64_t>> cells(points.dimension());
    for (std::size_t i = 0; i < points.count(); ++i)
        for (std::size_t k = 0; k < points.dimension(); ++k)
            cells[k].push_back(cell_of(points[i][k], whole_power(base, m)));
    return cells;
}

}  // namespace detail

/// Whether the points are a (t,m,s)-net in `base`; false if their number is not base^m with m >= t.
inline bool is_net(const PointSet& points, std::uint64_t base, std::size_t t) {
    const std::size_t m = whole_logarithm(points.count(), base);
    if (m == ~std::size_t{0} || t > m) return false;
    return detail::evenly_filled(detail::cells_of(points, base, m), base, m, m - t, 0,
                                 std::vector<std::uint64_t>(points.count()), 1);
}

/// Smallest t for which base^m points are a (t,m,s)-net; every set is one for t = m.
inline std::size_t exact_t(const PointSet& points, std::uint64_t base) {
    std::size_t t = 0;
    while (!is_net(points, base, t) && t < 64) ++t;
    return t;
}

/// Points first, ..., first + count - 1 of a set, restricted to some coordinates.
inline PointSet part_of(const PointSet& points, std::size_t first, std::size_t count,
                        const std::vector<std::size_t>& coordinates) {
    std::vector<double> rows;
    for (std::size_t i = first; i < first + count; ++i)
        for (const std::size_t k : coordinates) rows.push_back(points[i][k]);
    return {std::move(rows), coordinates.size()};
}

}  // namespace stipple::testing
