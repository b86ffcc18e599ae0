// SPDX-License-Identifier: MIT
//
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
// Shape   2^m points, m <= 31. Useful only in few dimensions: E grows as m^(d-1).
// Cost    2^m for each of C(m - t + d - 1, d - 1) divisions; less for digital nets.
// Source  the bound is by H. Niederreiter, "Random Number Generation and Quasi-Monte Carlo
//         Methods", SIAM 1992, chapter 4, for base 2; the proof is above.

#include "math/discrepancy/star/search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "math/combinatorics/combinations.hpp"
#include "math/digital/equidistribution.hpp"

namespace stipple::discrepancy::star {
namespace {

using equidistribution::Matrices;
using equidistribution::Net;
using equidistribution::Probe;

/// The bound E(m, d) / 2^m.
double share_of(std::size_t t, std::size_t m, std::size_t dimension) {
    const double least = std::ldexp(1.0, static_cast<int>(t));
    std::vector<double> excess(m - t + 1, least);  // for nets of 2^t, 2^(t+1), ... points
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

/// The points as a net, by their first m binary digits.
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

    /// True if every division by m - t digits gives boxes with equal counts.
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
