// SPDX-License-Identifier: MIT
//
// Chooses n of N points with a small squared maximum mean discrepancy, `squared`, for a kernel K:
//
//     n^2 (squared - total)  =  sum_(i, k chosen) K(x_i, x_k)  -  2 n sum_(i chosen) m(x_i),
//
// where m(x) is the mean of K(x, .) over the target and `total` that of K over both arguments.
//
// Let P_j = sum_(i chosen) K(x_i, x_j) be the potential of each of the N points. Kernel herding
// chooses as the c-th point the one with the least P_j + K_jj / 2 - c m_j. Then each chosen point
// in turn is replaced by the best of all points, until no exchange helps. After that, some points
// are exchanged at random and the search continues from the best choice so far.
//
// Cost    N values of K per choice, 2 N per exchange; 32 N bytes, the columns of the points, and
//         another 16 N bytes for the best choice so far.
// Promise depends only on the points, n, the seed and the number of steps, not on the number of
//         threads.
// Source  Y. Chen, M. Welling, A. Smola, "Super-samples from kernel herding", UAI 2010,
//         arXiv:1203.3472; for the Stein kernel: M. Riabiz et al., "Optimal thinning of MCMC
//         output", J. R. Stat. Soc. B 84 (2022) 1059-1081, arXiv:2005.03952. Exchanges: this
//         program's own.

#include "generators/subset/choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "core/machine/wide.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"

namespace stipple::generators::subset {
namespace {

using kernels::Columns;
using kernels::Kernel;
using kernels::tile;

constexpr double never = std::numeric_limits<double>::infinity();

STIPPLE_WIDE void add(const double* values, std::size_t count, double* sums) {
    for (std::size_t j = 0; j < count; ++j) sums[j] += values[j];
}

STIPPLE_WIDE void add_difference(const double* values, const double* less, std::size_t count,
                                 double* sums) {
    for (std::size_t j = 0; j < count; ++j) sums[j] += values[j] - less[j];
}

/// Scores P_j + K_jj / 2 - weight m_j of a tile's points, from `sums`, `halves` and `means`.
STIPPLE_WIDE void score(const double* sums, const double* halves, const double* means,
                        double weight, std::size_t count, double* scores) {
    for (std::size_t j = 0; j < count; ++j) scores[j] = (sums[j] + halves[j]) - weight * means[j];
}

STIPPLE_WIDE void subtract(const double* values, std::size_t count, double* scores) {
    for (std::size_t j = 0; j < count; ++j) scores[j] -= values[j];
}

/// Minimum of a tile's values. Halves the tile repeatedly, since such loops can be vectorised.
/// @param room buffer for `count` values
STIPPLE_WIDE double least(const double* numbers, std::size_t count, double* room) {
    for (std::size_t j = 0; j < count; ++j) room[j] = numbers[j];
    for (std::size_t size = count; size > 1;) {
        const std::size_t half = (size + 1) / 2;
        const double* const upper = room + half;
        for (std::size_t j = 0; j < size - half; ++j)
            room[j] = upper[j] < room[j] ? upper[j] : room[j];
        size = half;
    }
    return room[0];
}

/// The point with the lowest score; of several equal ones the first.
struct Best {
    double score = never;
    std::size_t at = 0;

    void take(const Best& other) {
        if (other.score < score) *this = other;
    }
};

/// Chosen points, and the terms of the cost of choosing each point.
struct Chosen {
    Rows members;                    ///< in the order in which exchanges are tried
    std::vector<double> potentials;  ///< P_j of every point
    std::vector<double> halves;      ///< K_jj / 2; infinite for chosen points
};

class Herding {
  public:
    Herding(const Kernel& kernel, const Columns& points, std::size_t n, std::uint64_t seed,
            RunContext run)
        : kernel_(kernel),
          points_(points),
          n_(n),
          rng_(seed, 1),
          run_(std::move(run)),
          means_(points.count()),
          removed_(points.count()),
          row_(points.width()) {
        now_.potentials.assign(points.count(), 0);
        now_.halves.resize(points.count());
        for (std::size_t j = 0; j < points.count(); ++j) {
            if (j % 65536 == 0) run_.check_stop();
            points.row(j, row_.data());
            means_[j] = kernel.mean(row_.data());
            now_.halves[j] = kernel.diagonal(row_.data()) / 2;
            largest_ = std::max(largest_, 2 * now_.halves[j]);
        }
    }

    void choose_greedily() {
        Best next = scan(Step::look, 0, 1);
        for (std::size_t c = 1;; ++c) {
            put(next.at);
            now_.members.push_back(next.at);
            run_.tick(c, n_ + 1);
            if (c == n_) break;
            next = scan(Step::grow, next.at, static_cast<double>(c + 1));
        }
        scan(Step::grow, next.at, 0);
    }

    /// @param values budget of kernel evaluations
    void improve(double values, RunContext run) {
        run_ = std::move(run);
        values_ = values;
        descend();
        best_ = now_;
        double best_cost = cost();
        // For n_ = 1, descend() has already compared all points.
        while (n_ > 1 && left()) {
            perturb();
            descend();
            const double now_cost = cost();
            if (now_cost < best_cost - slack()) {
                best_cost = now_cost;
                best_ = now_;
            } else {
                now_ = best_;
            }
        }
        now_ = best_;
    }

    Rows rows() {
        std::ranges::sort(now_.members);
        return now_.members;
    }

  private:
    enum class Step { look, grow, remove };

    /// Whether the budget allows another exchange.
    [[nodiscard]] bool left() const {
        return spent_ + 2 * static_cast<double>(points_.count()) <= values_;
    }

    /// Gains below this are rounding errors.
    [[nodiscard]] double slack() const { return 1e-10 * largest_; }

    void put(std::size_t i) { now_.halves[i] = never; }
    void take(std::size_t i) {
        points_.row(i, row_.data());
        now_.halves[i] = kernel_.diagonal(row_.data()) / 2;
    }

    /// Point with the lowest score, with the means times `weight`. Step::look takes the potentials
    /// as they are; grow first adds K(x_i, .) to them; remove only subtracts it from the scores,
    /// and stores it in removed_.
    Best scan(Step step, std::size_t i, double weight) {
        constexpr std::size_t tiles = 32;
        if (step != Step::look) points_.row(i, row_.data());
        const std::size_t all = points_.count();
        std::vector<Best> parts(block_count(all, tiles * tile));
        for_each_block(threads(), all, tiles * tile, [&](const Block& block) {
            Best best;
            for (std::size_t first = block.first; first < block.last; first += tile)
                best.take(scan_tile(step, first, std::min<std::size_t>(tile, block.last - first),
                                    weight));
            parts[block.index] = best;
        });
        Best best;
        for (const Best& part : parts) best.take(part);
        return best;
    }

    Best scan_tile(Step step, std::size_t first, std::size_t count, double weight) {
        std::array<double, tile> values;
        std::array<double, tile> scores;
        double* const sums = &now_.potentials[first];
        if (step != Step::look) kernel_.fill(row_.data(), points_, first, count, values.data());
        if (step == Step::grow) add(values.data(), count, sums);
        score(sums, &now_.halves[first], &means_[first], weight, count, scores.data());
        if (step == Step::remove) {
            std::copy_n(values.data(), count, &removed_[first]);
            subtract(values.data(), count, scores.data());
        }
        const double found = least(scores.data(), count, values.data());
        const auto* const at = std::find(scores.data(), scores.data() + count, found);
        return {found, first + static_cast<std::size_t>(at - scores.data())};
    }

    /// Adds K(x_j, .) to the potentials and subtracts removed_, stored by the last scan(remove).
    void exchange(std::size_t j) {
        constexpr std::size_t tiles = 32;
        points_.row(j, row_.data());
        for_each_block(threads(), points_.count(), tiles * tile, [&](const Block& block) {
            std::array<double, tile> values;
            for (std::size_t first = block.first; first < block.last; first += tile) {
                const std::size_t count = std::min<std::size_t>(tile, block.last - first);
                kernel_.fill(row_.data(), points_, first, count, values.data());
                add_difference(values.data(), &removed_[first], count, &now_.potentials[first]);
            }
        });
    }

    void replace(std::size_t place, std::size_t j) {
        take(now_.members[place]);
        put(j);
        now_.members[place] = j;
        exchange(j);
    }

    /// Exchanges points until no exchange helps or the budget is spent.
    void descend() {
        const auto n = static_cast<double>(n_);
        bool exchanged = true;
        while (exchanged && left()) {
            shuffle();
            exchanged = false;
            for (std::size_t place = 0; place < n_ && left(); ++place) {
                const std::size_t i = now_.members[place];
                const Best best = scan(Step::remove, i, n);
                spend();
                points_.row(i, row_.data());
                const double own =
                    (now_.potentials[i] - kernel_.diagonal(row_.data()) / 2) - n * means_[i];
                if (!(best.score < own - slack())) continue;
                replace(place, best.at);
                spend();
                exchanged = true;
            }
        }
    }

    void perturb() {
        const std::size_t most = std::max<std::size_t>(1, n_ / 4);
        const std::size_t some = 2 + draw(most);
        for (std::size_t k = 0; k < some && left(); ++k) {
            const std::size_t place = draw(n_);
            const std::size_t j = draw(points_.count());
            if (now_.halves[j] == never) continue;
            scan(Step::remove, now_.members[place], 0);
            replace(place, j);
            spend();
            spend();
        }
    }

    void shuffle() {
        constexpr std::size_t often = 65536;
        for (std::size_t k = n_; k > 1; --k) {
            if (k % often == 0) run_.check_stop();
            std::swap(now_.members[k - 1], now_.members[draw(k)]);
        }
    }

    /// Right-hand side of the formula at the top, which differs from n^2 times the squared
    /// discrepancy by a constant.
    [[nodiscard]] double cost() const {
        double sum = 0;
        for (const std::size_t i : now_.members)
            sum += now_.potentials[i] - 2 * static_cast<double>(n_) * means_[i];
        return sum;
    }

    void spend() {
        constexpr double often = 1 << 21;
        const double before = spent_;
        spent_ += static_cast<double>(points_.count());
        if (std::floor(before / often) == std::floor(spent_ / often)) return;
        const double n = static_cast<double>(n_);
        run_.tick(static_cast<std::uint64_t>(std::min(spent_, values_)),
                  static_cast<std::uint64_t>(values_) + 1,
                  fmt::format("squared {:.4g}", cost() / (n * n) + kernel_.total()));
    }

    [[nodiscard]] RunContext threads() const {
        const double work =
            static_cast<double>(points_.count()) * static_cast<double>(points_.width());
        return worth_threads(silent(run_), 5e-10 * work);
    }

    [[nodiscard]] std::size_t draw(std::size_t below) {
        return static_cast<std::size_t>(rng_.below(drawn_++, below));
    }

    const Kernel& kernel_;
    const Columns& points_;
    std::size_t n_;
    Rng rng_;
    std::uint64_t drawn_ = 0;
    RunContext run_;
    std::vector<double> means_;
    std::vector<double> removed_;  ///< K(x_i, .) for i of the last scan with Step::remove
    std::vector<double> row_;
    double largest_ = 0;  ///< largest K(x, x)
    Chosen now_;
    Chosen best_;
    double values_ = 0;  ///< budget of kernel evaluations
    double spent_ = 0;
};

}  // namespace

Rows choose_by_kernel(const Kernel& kernel, const Columns& points, std::size_t n, double values,
                      std::uint64_t seed, const RunContext& run) {
    const double all = static_cast<double>(points.count()) * static_cast<double>(n);
    const double greedy = all / (all + values);
    Rows rows(n);
    if (n == points.count()) {
        std::iota(rows.begin(), rows.end(), std::size_t{0});
        return rows;
    }
    Herding herding(kernel, points, n, seed, run.stage(0, greedy));
    herding.choose_greedily();
    herding.improve(values, run.stage(greedy, 1));
    return herding.rows();
}

double choice_memory(double points) { return 48 * points; }

Columns columns_of(const Columns& points, const Rows& rows, const RunContext& run) {
    constexpr std::size_t often = 16384;
    std::vector<double> numbers(rows.size() * points.width());
    for (std::size_t s = 0; s < rows.size(); ++s) {
        if (s % often == 0) run.check_stop();
        points.row(rows[s], &numbers[s * points.width()]);
    }
    return {numbers, points.width()};
}

}  // namespace stipple::generators::subset
