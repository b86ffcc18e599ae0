// SPDX-License-Identifier: MIT
//
// Partitions all points into sets of n that are similarly even: the sum of their squared maximum
// mean discrepancies is made small. The points are dealt out at random; then pairs of sets trade
// points, as in a round-robin tournament. If two sets A and B exchange a point i of A for a point j
// of B, the sum of K within the sets grows by
//
//     2 (K_ii + K_jj - 2 K_ij - D_i + D_j),    D_x = sum_(a in A) K(x, a) - sum_(b in B) K(x, b),
//
// so for each i in turn the best j is exchanged. The means of K cancel, since no point is dropped.
//
// Cost    some 8 n^2 values of K per pair. Every round roughly halves the squared discrepancies,
//         until they are as small as those of n well-chosen points.
// Promise depends only on the points, the number of sets, the seed and the number of values, not on
//         the number of threads.
// Source  this program's own; for halving by kernels see R. Dwivedi, L. Mackey, "Kernel thinning",
//         J. Mach. Learn. Res. 25 (2024), arXiv:2105.05842.

#include "generators/subset/choice.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "core/parallel.hpp"
#include "core/rng.hpp"

namespace stipple::generators::subset {
namespace {

using kernels::Columns;
using kernels::Kernel;
using kernels::tile;

/// Points of two sets that trade: places 0, ..., n - 1 hold the first set, the rest the second.
class Trade {
  public:
    Trade(const Kernel& kernel, const Columns& points, Rows& first, Rows& second,
          const RunContext& run)
        : kernel_(kernel),
          run_(run),
          n_(first.size()),
          rows_(joined(first, second)),
          points_(columns_of(points, rows_, run)),
          differences_(2 * n_),
          diagonals_(2 * n_),
          values_(2 * n_),
          others_(2 * n_),
          row_(points.width()) {
        for (std::size_t x = 0; x < 2 * n_; ++x) {
            run_.check_stop();
            fill(x, values_);
            diagonals_[x] = kernel_.diagonal(row_.data());
            largest_ = std::max(largest_, diagonals_[x]);
            const double sign = x < n_ ? 1 : -1;
            for (std::size_t y = 0; y < 2 * n_; ++y) differences_[y] += sign * values_[y];
        }
    }

    /// Exchanges points, in at most 8 sweeps, until no exchange helps; returns how many were made.
    std::size_t go() {
        constexpr int most_sweeps = 8;
        std::size_t all = 0;
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            std::size_t here = 0;
            for (std::size_t i = 0; i < n_; ++i) here += exchange(i) ? 1U : 0U;
            if (here == 0) break;
            all += here;
        }
        return all;
    }

    void give(Rows& first, Rows& second) const {
        const auto middle = rows_.begin() + static_cast<std::ptrdiff_t>(n_);
        first.assign(rows_.begin(), middle);
        second.assign(middle, rows_.end());
    }

  private:
    static Rows joined(const Rows& first, const Rows& second) {
        Rows rows = first;
        rows.insert(rows.end(), second.begin(), second.end());
        return rows;
    }

    /// Kernel values of the point of `column` with all points. Exchanges do not reorder columns.
    void fill(std::size_t column, std::vector<double>& values) {
        points_.row(column, row_.data());
        for (std::size_t first = 0; first < 2 * n_; first += tile)
            kernel_.fill(row_.data(), points_, first, std::min(tile, 2 * n_ - first),
                         &values[first]);
    }

    /// Exchanges the point at place i with the best one of the other set, if that helps.
    bool exchange(std::size_t i) {
        run_.check_stop();
        fill(columns_[i], values_);
        double least = 0;
        std::size_t at = 0;
        for (std::size_t j = n_; j < 2 * n_; ++j) {
            const std::size_t y = columns_[j];
            const double gain = differences_[y] + diagonals_[y] - 2 * values_[y];
            if (at != 0 && !(gain < least)) continue;
            least = gain;
            at = j;
        }
        const std::size_t x = columns_[i];
        if (!(least + diagonals_[x] - differences_[x] < -1e-10 * largest_)) return false;
        fill(columns_[at], others_);
        for (std::size_t y = 0; y < 2 * n_; ++y) differences_[y] += 2 * (others_[y] - values_[y]);
        std::swap(columns_[i], columns_[at]);
        std::swap(rows_[i], rows_[at]);
        return true;
    }

    const Kernel& kernel_;
    const RunContext& run_;
    std::size_t n_;
    Rows rows_;  ///< row of the point at each place
    Columns points_;
    Rows columns_ = places();          ///< index in points_ of the point at each place
    std::vector<double> differences_;  ///< D_x, defined at the top, of each column's point x
    std::vector<double> diagonals_;
    std::vector<double> values_;
    std::vector<double> others_;
    std::vector<double> row_;
    double largest_ = 0;

    [[nodiscard]] Rows places() const {
        Rows all(2 * n_);
        std::iota(all.begin(), all.end(), std::size_t{0});
        return all;
    }
};

/// All rows, dealt out at random to the sets.
std::vector<Rows> dealt(std::size_t count, std::size_t sets, std::uint64_t seed,
                        const RunContext& run) {
    constexpr std::size_t often = 65536;
    const Rng rng(seed, 4);
    Rows rows(count);
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    for (std::size_t k = count; k > 1; --k) {
        if (k % often == 0) run.check_stop();
        std::swap(rows[k - 1], rows[static_cast<std::size_t>(rng.below(k, k))]);
    }
    std::vector<Rows> all(sets);
    for (std::size_t i = 0; i < count; ++i) all[i % sets].push_back(rows[i]);
    return all;
}

/// Pairs of sets in a round of a tournament, by the circle method: for an even number of sets, the
/// last one stays in place and the others rotate.
std::vector<std::array<std::size_t, 2>> pairs_of(std::size_t round, std::size_t sets) {
    const std::size_t ring = sets % 2 == 0 ? sets - 1 : sets;
    std::vector<std::array<std::size_t, 2>> pairs;
    if (sets % 2 == 0) pairs.push_back({round % ring, sets - 1});
    for (std::size_t k = 1; k <= (ring - 1) / 2; ++k)
        pairs.push_back({(round + k) % ring, (round + ring - k) % ring});
    return pairs;
}

}  // namespace

std::vector<Rows> part_by_kernel(const Kernel& kernel, const Columns& points, std::size_t sets,
                                 double values, std::uint64_t seed, const RunContext& run) {
    std::vector<Rows> all = dealt(points.count(), sets, seed, run);
    const std::size_t tournament = sets % 2 == 0 ? sets - 1 : sets;
    const std::size_t least_rounds = std::bit_width(sets) + 1;
    const double n = static_cast<double>(points.count() / sets);
    const double round_values = 8 * n * n * static_cast<double>(sets / 2);
    const auto rounds =
        std::max<std::size_t>(least_rounds, static_cast<std::size_t>(values / round_values));
    std::size_t idle = 0;  // consecutive rounds without a trade
    for (std::size_t round = 0; round < rounds && idle < tournament; ++round) {
        const auto pairs = pairs_of(round % tournament, sets);
        std::vector<std::size_t> traded(pairs.size());
        const auto at = static_cast<double>(round);
        const auto end = static_cast<double>(rounds);
        for_each_block(run.stage(at / end, (at + 1) / end), pairs.size(), 1,
                       [&](const Block& block) {
                           const auto [a, b] = pairs[block.index];
                           Trade trade(kernel, points, all[a], all[b], run);
                           traded[block.index] = trade.go();
                           trade.give(all[a], all[b]);
                       });
        idle = std::ranges::max(traded) == 0 ? idle + 1 : 0;
    }
    for (Rows& rows : all) std::ranges::sort(rows);
    return all;
}

}  // namespace stipple::generators::subset
