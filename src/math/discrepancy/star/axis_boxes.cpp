// SPDX-License-Identifier: MIT
//
// Bounds from boxes that cover all axes except one. The worst of these is the first known box, and
// the result if there is no time for more. For an upper bound, let E_k bound the discrepancy of the
// points' coordinates on axis k of d. A box with sides v_k and volume v is the intersection of d
// boxes that cover all axes except one, each with one of its sides. It contains at most as many
// points as any of these, and misses at most as many as all of them together:
//
//     #/n <= min_k (v_k + E_k),          min_k v_k = p   =>  v >= p^d,
//     #/n >= 1 - sum_k (1 - v_k + E_k),  mean_k v_k = s  =>  v <= s^d.
//
// So #/n - v is at most the maximum of p - p^d over p, and the largest E_k; v - #/n is at most the
// maximum of s^d - max(0, 1 - d (1 - s)) over s, and the sum of all E_k:
//
//     D <= max( (1 - 1/d) d^(-1/(d - 1)) + max_k E_k,  (1 - 1/d)^d + sum_k E_k ).
//
// Cost    O(n d).

#include "math/discrepancy/star/search.hpp"
#include "math/functions/logarithm.hpp"

#include <algorithm>
#include <cmath>

namespace stipple::discrepancy::star {
namespace {

/// A box that covers all axes except one.
struct AxisBox {
    double value = -1;
    std::uint32_t rank = 0;  ///< rank of its end on that axis
    std::uint64_t points = 0;

    void take(const AxisBox& other) {
        if (other.value > value) *this = other;
    }
};

/// Worst boxes of an axis.
struct Worst {
    AxisBox open;
    AxisBox closed;
};

/// Marks points with a coordinate 1, which no open box contains.
std::vector<bool> points_at_one(const BoxGrid& grid) {
    std::vector<bool> at_one(grid.count);
    for (std::size_t k = 0; k < grid.dimension(); ++k)
        for (std::size_t i = 0; i < grid.count; ++i)
            if (grid.ranks[k][i] + 1 == grid.values[k].size()) at_one[i] = true;
    return at_one;
}

Worst worst_of_axis(const BoxGrid& grid, std::size_t k, const std::vector<bool>& at_one) {
    const auto n = static_cast<double>(grid.count);
    const auto points = points_at(grid, k);
    std::vector<std::uint32_t> inside(points.size());
    for (std::size_t i = 0; i < grid.count; ++i)
        if (!at_one[i]) ++inside[grid.ranks[k][i]];
    Worst worst;
    std::uint64_t below = 0;
    std::uint64_t within = 0;
    for (std::uint32_t a = 0; a < points.size(); ++a) {
        const double x = grid.values[k][a];
        worst.open.take({x - static_cast<double>(below) / n, a, below});
        below += inside[a];
        within += points[a];
        worst.closed.take({static_cast<double>(within) / n - x, a, within});
    }
    return worst;
}

}  // namespace

void offer_axis_boxes(const BoxGrid& grid, WorstBox& worst) {
    offer_axis_boxes(grid, worst, worst);
}

void offer_axis_boxes(const BoxGrid& grid, WorstBox& worst_open, WorstBox& worst_closed) {
    const auto at_one = points_at_one(grid);
    std::vector<std::uint32_t> corner;
    for (const auto& values : grid.values)
        corner.push_back(static_cast<std::uint32_t>(values.size() - 1));
    for (std::size_t k = 0; k < grid.dimension(); ++k) {
        const std::uint32_t whole = corner[k];
        const auto [open, closed] = worst_of_axis(grid, k, at_one);
        corner[k] = open.rank;
        worst_open.offer(Side::open, corner, open.points);
        corner[k] = closed.rank;
        worst_closed.offer(Side::closed, corner, closed.points);
        corner[k] = whole;
    }
}

double axis_bound(const BoxGrid& grid, double times) {
    const auto d = static_cast<double>(grid.dimension());
    const std::vector<bool> none(grid.count);
    double most = 0;
    double all = 0;
    for (std::size_t k = 0; k < grid.dimension(); ++k) {
        const auto [open, closed] = worst_of_axis(grid, k, none);
        const double worst = times * std::max(open.value, closed.value);
        most = std::max(most, worst);
        all += worst;
    }
    constexpr double rounding = 0x1p-46;
    if (d == 1) return most + rounding;
    const double full = (1 - 1 / d) * real_power(d, -1 / (d - 1)) + most;
    const double empty = real_power(1 - 1 / d, d) + all;
    return std::min(1.0, std::max(full, empty) * (1 + rounding) + rounding);
}

}  // namespace stipple::discrepancy::star
