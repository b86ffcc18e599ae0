// SPDX-License-Identifier: MIT
#include "experiments/parameters/reordering.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "experiments/parameters/copula.hpp"
#include "math/functions/cholesky.hpp"
#include "math/functions/normal_distribution.hpp"

namespace stipple::parameters {
namespace {

struct Ranked {
    double number;
    std::uint32_t tie;  ///< rank among equal numbers
    std::uint32_t point;

    auto operator<=>(const Ranked&) const = default;
};

/// Sorts the items, and returns the ranks of the points.
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

/// P Q^-1, for lower triangular P and Q.
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

/// A set's numbers, sorted for each coordinate, and the scores of their ranks.
class ScoredSet {
  public:
    ScoredSet(std::span<const double> rows, const std::vector<MarginalPtr>& laws,
              const RunContext& run)
        : d_(laws.size()),
          run_(silent(run)),
          scores_(van_der_waerden(rows.size() / d_)),
          ranks_(d_),
          numbers_(d_),
          mean_ranks_(d_),
          tied_(d_) {
        const std::size_t d = d_;
        for_each_block(run_, d, 1, [&](const Block& column) {
            const auto k = static_cast<std::size_t>(column.first);
            std::vector<Ranked> items(scores_.size());
            for (std::uint32_t i = 0; i < items.size(); ++i) items[i] = {rows[i * d + k], i, i};
            ranks_[k] = ranks_of(items);
            numbers_[k].reserve(items.size());
            for (const Ranked& item : items) numbers_[k].push_back(item.number);
            rank_equals(k, laws[k]);
        });
    }

    [[nodiscard]] bool same_in_all(std::size_t k) const {
        return numbers_[k].front() == numbers_[k].back();
    }

    /// Whether several points have the same value of parameter k.
    [[nodiscard]] bool tied(std::size_t k) const { return tied_[k] != 0; }
    [[nodiscard]] bool any_tied() const { return std::ranges::count(tied_, 0) < std::ssize(tied_); }
    /// Spearman's rank correlation of two parameters; 0 if one of them is constant.
    [[nodiscard]] double rank_correlation(std::size_t j, std::size_t k,
                                          const std::vector<Ranks>& ranks) const {
        double sum = 0, of_j = 0, of_k = 0;
        for (std::size_t i = 0; i < scores_.size(); ++i) {
            const double x = mean_ranks_[j][ranks[j][i]];
            const double y = mean_ranks_[k][ranks[k][i]];
            sum += x * y;
            of_j += x * x;
            of_k += y * y;
        }
        return of_j > 0 && of_k > 0 ? sum / std::sqrt(of_j * of_k) : 0;
    }

    /// Matrix E of reordering.hpp: the correlations of the scores of all coordinates.
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

    /// Ranks of the points in the matrix R S^T of reordering.hpp; S is lower triangular, S_00 = 1.
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

    /// Gives each point, in each coordinate, the number whose rank equals the point's rank.
    void give_out(const std::vector<Ranks>& ranks, std::span<double> rows) const {
        for (std::size_t k = 0; k < d_; ++k)
            for (std::size_t i = 0; i < scores_.size(); ++i)
                rows[i * d_ + k] = numbers_[k][ranks[k][i]];
    }

  private:
    /// Computes mean_ranks_: numbers that give equal parameters get the mean of their ranks.
    void rank_equals(std::size_t k, const MarginalPtr& law) {
        const auto& numbers = numbers_[k];
        const auto parameter = [&](double u) { return law ? law->quantile(u) : u; };
        auto& means = mean_ranks_[k];
        for (std::size_t first = 0; first < numbers.size(); first = means.size()) {
            const double x = parameter(numbers[first]);
            std::size_t end = first + 1;
            while (end < numbers.size() && parameter(numbers[end]) == x) ++end;
            if (end > first + 1) tied_[k] = 1;
            const auto twice =
                static_cast<double>(first + end) - static_cast<double>(numbers.size());
            means.resize(end, twice / 2);
        }
    }

    std::size_t d_;
    RunContext run_;
    std::vector<double> scores_;                   ///< scores of the ranks 0, 1, ...
    std::vector<Ranks> ranks_;                     ///< ranks of the points, by coordinate
    std::vector<std::vector<double>> numbers_;     ///< numbers in ascending order, by coordinate
    std::vector<std::vector<double>> mean_ranks_;  ///< mean ranks of equal numbers, centred
    std::vector<std::uint8_t> tied_;
};

/// Adjusts the requested score correlations until the ranks have the requested correlations.
class Corrections {
  public:
    Corrections(const std::vector<double>& spearman, std::vector<double> scores,
                const ScoredSet& set)
        : spearman_(spearman),
          set_(set),
          d_(static_cast<std::size_t>(std::lround(std::sqrt(spearman.size())))),
          asked_(std::move(scores)),
          step_(spearman.size(), 1),
          before_(spearman.size(), 0) {}

    [[nodiscard]] const std::vector<double>& asked() const { return asked_; }
    /// Adds the remaining error of the rank correlations to the requested score correlations.
    /// Returns the largest error, converted to scores.
    double correct(const std::vector<Ranks>& ranks) {
        double worst = 0;
        for (std::size_t j = 0; j < d_; ++j)
            for (std::size_t k = 0; k < j; ++k) {
                const double lacks = score_correlation(spearman_[j * d_ + k]) -
                                     score_correlation(set_.rank_correlation(j, k, ranks));
                worst = std::max(worst, std::abs(lacks));
                asked_[j * d_ + k] = asked_[k * d_ + j] = next(j, k, lacks);
            }
        return worst;
    }

  private:
    double next(std::size_t j, std::size_t k, double lacks) {
        const double now = asked_[j * d_ + k];
        if (!set_.tied(j) && !set_.tied(k)) return now + lacks;
        // Errors are multiplied by `step`, since with ties ranks change more, or less, than scores.
        double& step = step_[j * d_ + k];
        double& before = before_[j * d_ + k];
        if (std::abs(lacks) > std::abs(before) / 2 && before != 0)
            step = lacks * before < 0 ? step / 2 : std::min(1.5 * step, 8.0);
        before = lacks;
        const double then = now + step * lacks;
        return std::abs(then) < 1 ? then : (now + std::copysign(1, then)) / 2;
    }

    const std::vector<double>& spearman_;
    const ScoredSet& set_;
    std::size_t d_;
    std::vector<double> asked_;  ///< correlations requested for the scores
    std::vector<double> step_;
    std::vector<double> before_;  ///< error before the last correction
};

/// Matrix Q of reordering.hpp. @throws Error(input) if E has no well-conditioned factor
std::vector<double> factor_of(const ScoredSet& set, const std::vector<std::string>& names) {
    const std::size_t d = names.size();
    for (std::size_t k = 0; k < d; ++k)
        if (set.same_in_all(k))
            fail(ErrorKind::input,
                 "iman-conover: all points have the same value of {}; expected different values",
                 names[k]);
    const auto [factor, failed, minor] = cholesky(set.correlations(), d);
    for (std::size_t k = 0; k < d; ++k)
        if (k + 1 == failed || factor[k * d + k] < 1e-5)
            fail_with_hint(ErrorKind::input, "scrambled points, or more points, may help",
                           "iman-conover: the ranks of {} are determined by those of the preceding "
                           "parameters, and cannot be reordered independently",
                           names[k]);
    return factor;
}

}  // namespace

void Reordering::apply(std::span<double> rows, const RunContext& run) const {
    constexpr double enough = 1e-5;
    const std::size_t d = names.size();
    const std::size_t n = rows.size() / d;
    if (d == 1) return;
    if (n <= d)
        fail(ErrorKind::input,
             "iman-conover: expected at least {} points for {} parameters; there {} {}", d + 1, d,
             n == 1 ? "is" : "are", n);
    if (n > std::numeric_limits<std::uint32_t>::max())
        fail(ErrorKind::limit, "iman-conover: expected fewer than 2^32 points");
    run.need_memory(36.0 * static_cast<double>(rows.size()), "the reordering of the points");
    const ScoredSet set(rows, laws, run);
    const std::vector<double> own = factor_of(set, names);
    const int most = set.any_tied() ? 30 : 10;
    Corrections corrections(spearman, scores, set);
    std::vector<Ranks> best;
    double least = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < most && !(least < enough); ++pass) {
        const Cholesky wanted = cholesky(corrections.asked(), d);
        if (wanted.failed != 0) break;
        std::vector<Ranks> ranks = set.transformed(quotient(wanted.factor, own, d));
        const double lacks = corrections.correct(ranks);
        if (lacks < least) best = std::move(ranks);
        least = std::min(least, lacks);
    }
    set.give_out(best, rows);
    constexpr double told = 0.01;
    for (std::size_t j = 0; j < d; ++j)
        for (std::size_t k = j + 1; k < d; ++k)
            if (const double r = set.rank_correlation(j, k, best);
                std::abs(r - spearman[j * d + k]) > told)
                run.notify(
                    fmt::format("iman-conover: the rank correlation of {} and {} in these {} "
                                "points is {:.4f}; {} was requested",
                                names[j], names[k], n, r, spearman[j * d + k]));
}

}  // namespace stipple::parameters
