// SPDX-License-Identifier: MIT
//
// Bounds for all anchored boxes at once: from boxes that cover all axes except one, from a coarse
// grid, and from a net that the points form.

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "math/combinatorics/combinations.hpp"
#include "math/digital/equidistribution.hpp"
#include "math/discrepancy/star/search.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple::discrepancy::star {

// Bounds from boxes that cover all axes except one. The worst of these boxes is the first known box
// of a search, and its result if no time is left for more. For an upper bound, let E_k bound the
// discrepancy of the points' coordinates on axis k of d. A box with sides v_k and volume v is the
// intersection of d boxes that cover all axes except one, each with one of its sides. Let # be the
// number of points in this box. It contains at most as many points as any of the d boxes, and
// misses at most as many as all of them together:
//
//     #/n <= min_k (v_k + E_k),          min_k v_k = p   =>  v >= p^d,
//     #/n >= 1 - sum_k (1 - v_k + E_k),  mean_k v_k = s  =>  v <= s^d.
//
// So, with the maxima taken over p and s in [0, 1],
//
//     #/n - v <= max_p (p - p^d) + max_k E_k,
//     v - #/n <= max_s (s^d - max(0, 1 - d (1 - s))) + sum_k E_k,
//
//     D <= max( (1 - 1/d) d^(-1/(d - 1)) + max_k E_k,  (1 - 1/d)^d + sum_k E_k ).
//
// Cost    O(n d).

namespace {

/// A box that covers all axes except one.
struct AxisBox {
    double value = -1;
    std::uint32_t rank = 0;  ///< rank of its end on the axis that it does not cover
    std::uint64_t points = 0;

    void take(const AxisBox& other) {
        if (other.value > value) *this = other;
    }
};

/// The worst open and the worst closed box of one axis.
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

// Upper bound of the star discrepancy from counts at the corners of a coarse grid. If a box has its
// upper corner c in the grid's cell from lo to hi,
//
//     vol(c) - #{x < c} / n <= vol(hi) - #{x <= lo} / n,
//     #{x <= c} / n - vol(c) <= #{x <= hi} / n - vol(lo).
//
// So the largest of these bounds holds for all boxes, and exceeds the discrepancy by at most delta
// = max (vol(hi) - vol(lo)). The grid is finer towards 1, where volumes change most:
//
//     1,  x_0 = (1 - delta)^(1/d),  x_(i+1) = (x_i - delta) x_0^(1 - d),  ...,  0.
//
// Shape   any n; about (d / (d - 1) ln(d) / delta)^d corners: useful only in few dimensions.
// Cost    O(n d + corners d); 4 bytes per corner.
// Promise a proven bound, including rounding errors. Does not depend on the number of threads.
// Source  B. Doerr, M. Gnewuch, A. Srivastav, J. Complexity 21 (2005) 691-709 (delta-covers).

namespace {

/// Coordinates of the grid's corners on each axis, increasing from 0 to 1.
std::vector<double> cuts_for(double delta, double dimension) {
    std::vector<double> cuts{1};
    const double first = exponential(logarithm(1 - delta) / dimension);
    const double stretch = exponential(logarithm(first) * (1 - dimension));
    for (double x = first; x > 0; x = (x - delta) * stretch) cuts.push_back(x);
    cuts.push_back(0);
    std::ranges::reverse(cuts);
    return cuts;
}

/// Coordinates of the finest grid with up to `most_corners` corners; empty if these are too few.
std::vector<double> finest_cuts(std::size_t dimension, double most_corners) {
    const auto d = static_cast<double>(dimension);
    const double most = std::floor(exponential(logarithm(most_corners) / d) + 1e-9);
    if (most < 6) return {};  // delta would be above 1/2
    double coarse = 1 - 1e-9;
    double fine = 1e-7;
    for (int step = 0; step < 60; ++step) {
        const double middle = std::sqrt(coarse * fine);
        const double corners = static_cast<double>(cuts_for(middle, d).size());
        (corners > most ? fine : coarse) = middle;
    }
    auto cuts = cuts_for(coarse, d);
    if (static_cast<double>(cuts.size()) > most) cuts.clear();
    return cuts;
}

/// Number of points in the closed box of each corner; the index on the last axis varies fastest.
std::vector<std::uint32_t> corner_counts(const BoxGrid& grid, const std::vector<double>& cuts,
                                         const RunContext& run) {
    const std::size_t side = cuts.size();
    std::size_t corners = 1;
    std::vector<std::uint32_t> corner_of(grid.count);
    for (std::size_t k = 0; k < grid.dimension(); ++k, corners *= side) {
        run.check_stop();
        std::vector<std::uint32_t> above;  // index of the first cut not below each value
        std::uint32_t at = 0;
        for (const double x : grid.values[k]) {
            while (cuts[at] < x) ++at;
            above.push_back(at);
        }
        for (std::size_t i = 0; i < grid.count; ++i)
            corner_of[i] =
                corner_of[i] * static_cast<std::uint32_t>(side) + above[grid.ranks[k][i]];
    }
    std::vector<std::uint32_t> counts(corners);
    for (const std::uint32_t corner : corner_of) ++counts[corner];
    for (std::size_t stride = 1; stride < corners; stride *= side)
        for (std::size_t first = 0; first < corners; first += stride * side) {
            if (first % (std::size_t{1} << 20) < stride * side) run.check_stop();
            std::uint32_t* at = counts.data() + first;
            for (std::size_t i = stride; i < stride * side; ++i) at[i] += at[i - stride];
        }
    return counts;
}

/// Largest bound of a cell; visits the cells in lines along the last axis.
double worst_cell(const BoxGrid& grid, const std::vector<double>& cuts, const RunContext& run) {
    const auto counts = corner_counts(grid, cuts, run);
    const auto points = static_cast<double>(grid.count);
    const std::size_t side = cuts.size();
    std::size_t across = 1;  // index difference between the upper and lower corner of a cell
    for (std::size_t k = 1; k < grid.dimension(); ++k) across = across * side + 1;
    double worst = 0;
    for (std::size_t line = 0; line * side + across < counts.size(); ++line) {
        if (line % 65536 == 0) run.check_stop();
        double low = 1;  // products of the corners' coordinates except the last
        double high = 1;
        std::size_t rest = line;
        for (std::size_t k = 1; k < grid.dimension(); ++k, rest /= side) {
            const std::size_t at = rest % side;
            low *= cuts[at];
            high *= at + 1 < side ? cuts[at + 1] : 0;
        }
        if (high == 0) continue;  // a line at the upper end of an axis has no cells
        const std::uint32_t* below = &counts[line * side];
        const std::uint32_t* within = below + across;
        for (std::size_t i = 0; i + 1 < side; ++i) {
            const double open = high * cuts[i + 1] - below[i] / points;
            const double closed = within[i] / points - low * cuts[i];
            worst = std::max(worst, std::max(open, closed));
        }
    }
    return worst;
}

}  // namespace

double cover_bound(const BoxGrid& grid, std::uint64_t most_corners, const RunContext& run) {
    const std::size_t d = grid.dimension();
    const auto cuts = finest_cuts(d, std::min(static_cast<double>(most_corners), 0x1p31));
    if (cuts.empty()) return 1;
    const double worst = worst_cell(grid, cuts, run);
    const double rounding = 4e-16 * static_cast<double>(d + 2);
    return std::min(1.0, worst + rounding);
}

// Upper bound of the star discrepancy of 2^m points that form a (t,m,d)-net in base 2, from this
// property only. Let E(m, d) bound | #{points in [0,c)} - 2^m vol(c) |. The binary digits split the
// last side of [0,c) into at most one interval of each length 2^-1, ..., 2^-(m-t), and a remainder
// inside one more of the last length. The points whose last coordinate is in an interval of length
// 2^-j form, without that coordinate, a (t,m-j,d-1)-net. The remainder contains at most 2^t points,
// and its volume times 2^m is at most 2^t. So
//
//     E(m, d) = 2^t + sum over k = t, ..., m - 1 of E(k, d - 1),      E(m, 1) = E(t, d) = 2^t,
//
// and D* <= E(m, d) / 2^m. Closed boxes are limits of half-open ones.
//
// Shape   2^m points, m <= 30. Useful only in few dimensions: E grows as m^(d-1).
// Cost    2^m for each of C(m - t + d - 1, d - 1) divisions; less for digital nets.
// Source  the bound is by H. Niederreiter, "Random Number Generation and Quasi-Monte Carlo
//         Methods", SIAM 1992, chapter 4, for base 2; the proof is above.

namespace {

using equidistribution::Matrices;
using equidistribution::Net;
using equidistribution::Probe;

/// The bound E(m, d) / 2^m.
double share_of(std::size_t t, std::size_t m, std::size_t dimension) {
    const double least = std::ldexp(1.0, static_cast<int>(t));
    std::vector<double> excess(m - t + 1, least);  // E(t, d), ..., E(m, d), at first for d = 1
    for (std::size_t d = 2; d <= dimension; ++d) {
        double sum = least;
        for (double& e : excess) {
            const double lower = e;
            e = sum;
            sum += lower;
        }
    }
    return std::ldexp(excess.back(), -static_cast<int>(m));
}

/// The n = 2^m points as a net, from the first m binary digits of their coordinates.
Net net_in_base_two(const BoxGrid& grid) {
    const auto digits = static_cast<std::size_t>(std::countr_zero(grid.count));
    Net net{.base = 2, .digits = digits, .count = grid.count, .dimension = grid.dimension()};
    net.cells.reserve(grid.count * grid.dimension());
    const auto cells = static_cast<double>(grid.count);
    for (std::size_t k = 0; k < grid.dimension(); ++k)
        for (const std::uint32_t rank : grid.ranks[k]) {
            const double cell = std::floor(grid.values[k][rank] * cells);
            net.cells.push_back(static_cast<std::int32_t>(std::min(cell, cells - 1)));
        }
    return net;
}

class NetTest {
  public:
    NetTest(const BoxGrid& grid, const RunContext& run)
        : net_(net_in_base_two(grid)),
          matrices_(equidistribution::matrices_of(net_, run)),
          probe_(equidistribution::probe_of(net_, matrices_, run)) {}

    /// Number of comparisons in passes().
    [[nodiscard]] double work(std::size_t t) const {
        const auto m = static_cast<double>(net_.digits);
        const double each = matrices_ ? m * m : static_cast<double>(net_.count);
        const std::size_t digits = net_.digits - t;
        return each * static_cast<double>(binomial(digits + net_.dimension - 1, digits));
    }

    /// True if the points are a (t,m,d)-net: divisions by m - t digits all have equal counts.
    [[nodiscard]] bool passes(std::size_t t, const RunContext& run) const {
        const std::size_t digits = net_.digits - t;
        for (std::size_t size = 1; size <= std::min(net_.dimension, digits); ++size) {
            Combination along = combination(0, size);
            for (std::uint64_t i = 0; i < binomial(net_.dimension, size); ++i) {
                run.check_stop();
                if (!equidistribution::all_equal(*probe_, along, 0, digits)) return false;
                next_combination(along);
            }
        }
        return true;
    }

  private:
    Net net_;
    std::optional<Matrices> matrices_;
    std::unique_ptr<Probe> probe_;
};

}  // namespace

double net_bound(const BoxGrid& grid, double most, std::uint64_t work, const RunContext& run) {
    if (!std::has_single_bit(grid.count) || grid.count >= std::size_t{1} << 31) return 1;
    const auto m = static_cast<std::size_t>(std::countr_zero(grid.count));
    std::size_t above = 0;  // first t whose bound is not below `most`
    while (above <= m && share_of(above, m, grid.dimension()) < most) ++above;
    auto left = static_cast<double>(work) -
                static_cast<double>(grid.count) * static_cast<double>(grid.dimension());
    if (above == 0 || left < 0) return 1;
    double bound = 1;
    const NetTest test(grid, run);
    for (std::size_t t = above; t-- > 0;) {
        left -= test.work(t);
        if (left < 0 || !test.passes(t, run)) break;
        bound = share_of(t, m, grid.dimension());
    }
    return bound;
}

}  // namespace stipple::discrepancy::star
