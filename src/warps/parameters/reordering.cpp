// SPDX-License-Identifier: MIT
#include "warps/parameters/reordering.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "math/functions/cholesky.hpp"
#include "math/functions/normal_distribution.hpp"
#include "warps/parameters/copula.hpp"

namespace stipple::parameters {
namespace {

struct Ranked {
    double number;
    std::uint32_t tie;  ///< orders equal numbers
    std::uint32_t point;

    bool operator<(const Ranked& other) const {
        return number < other.number || (number == other.number && tie < other.tie);
    }
};

/// Sorts them.
Ranks ranks_of(std::vector<Ranked>& items) {
    std::ranges::sort(items, std::less{});
    Ranks ranks(items.size());
    for (std::uint32_t r = 0; r < items.size(); ++r) ranks[items[r].point] = r;
    return ranks;
}

/// Phi^-1((r + 1) / (n + 1)) for r = 0 ... n - 1, symmetric to the last bit.
std::vector<double> van_der_waerden(std::size_t n) {
    std::vector<double> scores(n);
    for (std::size_t r = 0; r < n / 2; ++r) {
        scores[r] = normal_quantile(static_cast<double>(r + 1) / static_cast<double>(n + 1));
        scores[n - 1 - r] = -scores[r];
    }
    return scores;
}

/// Spearman's, of ranks without ties.
double rank_correlation(const Ranks& a, const Ranks& b) {
    const auto n = static_cast<double>(a.size());
    const double middle = (n - 1) / 2;
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - middle) * (b[i] - middle);
    return sum / (n * (n * n - 1) / 12);
}

/// P Q^-1 of lower triangular matrices.
std::vector<double> quotient(const std::vector<double>& p, const std::vector<double>& q,
                             std::size_t d) {
    std::vector<double> s(d * d);
    for (std::size_t i = 0; i < d; ++i)
        for (std::size_t j = i + 1; j-- > 0;) {
            double rest = p[i * d + j];
            for (std::size_t k = j + 1; k <= i; ++k) rest -= s[i * d + k] * q[k * d + j];
            s[i * d + j] = rest / q[j * d + j];
        }
    return s;
}

/// The numbers of a set by their coordinates, and the scores of their ranks.
class ScoredSet {
  public:
    ScoredSet(std::span<const double> rows, std::size_t d, const RunContext& run)
        : d_(d),
          run_(silent(run)),
          scores_(van_der_waerden(rows.size() / d)),
          ranks_(d),
          numbers_(d) {
        for_each_block(run_, d, 1, [&](const Block& column) {
            const auto k = static_cast<std::size_t>(column.first);
            std::vector<Ranked> items(scores_.size());
            for (std::uint32_t i = 0; i < items.size(); ++i) items[i] = {rows[i * d + k], i, i};
            ranks_[k] = ranks_of(items);
            numbers_[k].reserve(items.size());
            for (const Ranked& item : items) numbers_[k].push_back(item.number);
        });
    }

    [[nodiscard]] bool same_in_all(std::size_t k) const {
        return numbers_[k].front() == numbers_[k].back();
    }

    /// E, of the scores of all coordinates.
    [[nodiscard]] std::vector<double> correlations() const {
        double squares = 0;
        for (const double score : scores_) squares += score * score;
        std::vector<double> e(d_ * d_);
        for (std::size_t j = 0; j < d_; ++j) {
            e[j * d_ + j] = 1;
            for (std::size_t k = 0; k < j; ++k) {
                double sum = 0;
                for (std::size_t i = 0; i < scores_.size(); ++i)
                    sum += scores_[ranks_[j][i]] * scores_[ranks_[k][i]];
                e[j * d_ + k] = e[k * d_ + j] = sum / squares;
            }
        }
        return e;
    }

    /// The ranks of R S^T; S is lower triangular with S_00 = 1.
    [[nodiscard]] std::vector<Ranks> transformed(const std::vector<double>& s) const {
        std::vector<Ranks> ranks(d_, ranks_[0]);
        for_each_block(run_, d_ - 1, 1, [&](const Block& column) {
            const auto k = static_cast<std::size_t>(column.first) + 1;
            std::vector<Ranked> items(scores_.size());
            for (std::uint32_t i = 0; i < items.size(); ++i) items[i] = {0, ranks_[k][i], i};
            for (std::size_t j = 0; j <= k; ++j)
                for (std::size_t i = 0; i < items.size(); ++i)
                    items[i].number += s[k * d_ + j] * scores_[ranks_[j][i]];
            ranks[k] = ranks_of(items);
        });
        return ranks;
    }

    /// Gives the numbers of each coordinate out by ranks.
    void give_out(const std::vector<Ranks>& ranks, std::span<double> rows) const {
        for (std::size_t k = 0; k < d_; ++k)
            for (std::size_t i = 0; i < scores_.size(); ++i)
                rows[i * d_ + k] = numbers_[k][ranks[k][i]];
    }

  private:
    std::size_t d_;
    RunContext run_;
    std::vector<double> scores_;                ///< of the ranks 0, 1, ...
    std::vector<Ranks> ranks_;                  ///< a coordinate, by points
    std::vector<std::vector<double>> numbers_;  ///< a coordinate, in their order
};

/// Q. @throws Error(input) where there is none
std::vector<double> factor_of(const ScoredSet& set, const std::vector<std::string>& names) {
    const std::size_t d = names.size();
    for (std::size_t k = 0; k < d; ++k)
        if (set.same_in_all(k))
            fail(ErrorKind::input,
                 "iman-conover: all points have the same number for {}; they must differ",
                 names[k]);
    const auto [factor, failed, minor] = cholesky(set.correlations(), d);
    for (std::size_t k = 0; k < d; ++k)
        if (k + 1 == failed || factor[k * d + k] < 1e-5)
            fail_with_hint(ErrorKind::input, "scrambled points, or more of them, may have others",
                           "iman-conover: the ranks of {} follow from those of the parameters "
                           "before it, and cannot be reordered apart from them",
                           names[k]);
    return factor;
}

}  // namespace

void Reordering::apply(std::span<double> rows, const RunContext& run) const {
    constexpr int most = 10;
    constexpr double enough = 1e-5;
    const std::size_t d = names_.size();
    const std::size_t n = rows.size() / d;
    if (d == 1) return;
    if (n <= d)
        fail(ErrorKind::input,
             "iman-conover takes {} points or more for {} parameters; there {} {}", d + 1, d,
             n == 1 ? "is" : "are", n);
    if (n > std::numeric_limits<std::uint32_t>::max())
        fail(ErrorKind::limit, "iman-conover takes less than 2^32 points");
    run.need_memory(28.0 * static_cast<double>(rows.size()), "the reordering of the points");
    const ScoredSet set(rows, d, run);
    const std::vector<double> own = factor_of(set, names_);
    std::vector<double> asked = correlations_;
    std::vector<Ranks> best;
    double least = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < most && !(least < enough); ++pass) {
        const Cholesky wanted = cholesky(asked, d);
        if (wanted.failed != 0) break;
        std::vector<Ranks> ranks = set.transformed(quotient(wanted.factor, own, d));
        const double lacks = correct(asked, ranks);
        if (lacks < least) best = std::move(ranks);
        least = std::min(least, lacks);
    }
    set.give_out(best, rows);
}

double Reordering::correct(std::vector<double>& asked, const std::vector<Ranks>& ranks) const {
    const std::size_t d = ranks.size();
    double worst = 0;
    for (std::size_t j = 0; j < d; ++j)
        for (std::size_t k = 0; k < j; ++k) {
            const double lacks =
                correlations_[j * d + k] - score_correlation(rank_correlation(ranks[j], ranks[k]));
            worst = std::max(worst, std::abs(lacks));
            asked[j * d + k] += lacks;
            asked[k * d + j] += lacks;
        }
    return worst;
}

}  // namespace stipple::parameters
