// SPDX-License-Identifier: MIT
//
// Probability that Pearson's statistic of n independent points is at most a given value, summed
// over all counts with such a statistic: exact, if there are few enough to enumerate.
//
// Equal groups: with counts m + e_i, m = n div K, the statistic is
//
//     X^2 = K / n (sum e_i^2 - r^2 / K),    sum e_i = r = n mod K,
//
// and the weights 1 / (m + e_i)! of the groups are convolved, one after another, over the pairs
// (sum e_i, sum e_i^2).
//
// Unequal groups: counts are enumerated group by group, as long as the statistic can stay small
// enough. Each count is binomial among the remaining points. If groups with expectations E and F
// contain T points together, they add at least
//
//     (O - E)^2 / E + (T - O - F)^2 / F  =  (O - c)^2 (1 / E + 1 / F) + (T - E - F)^2 / (E + F),
//
// with c = T E / (E + F).
//
// Cost    equal groups: below K^1.5 D^2 steps, D = n X^2 / K; unequal ones: the number of counts.
//         Returns nullopt if there may be more than some millions, which take milliseconds.
// Promise sums of positive terms, with a relative error of about 1e-12; equal statistics are
//         included.

#include "analyzers/uniformity/pearson.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/functions/distributions.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple::analyzers {
namespace {

constexpr double most_steps = 2e6;
constexpr double tie = 1e-12;  ///< tolerance for statistics that differ only by rounding

/// Sums over the counts m + e of equal groups, with weights m! m^e / (m + e)!, indexed by the sum
/// of e and the sum of e^2.
class EqualCounts {
  public:
    /// @param squares largest sum of e^2
    EqualCounts(std::int64_t m, std::int64_t squares)
        : squares_(squares), least_(-std::min(root(squares), m)) {
        const auto count = static_cast<double>(m);
        const auto zero = static_cast<std::size_t>(-least_);
        weights_.assign(static_cast<std::size_t>(root(squares) - least_) + 1, 1);
        for (std::size_t k = zero + 1; k < weights_.size(); ++k)
            weights_[k] = weights_[k - 1] * (count / (count + static_cast<double>(k - zero)));
        for (std::size_t k = zero; k-- > 0;)
            weights_[k] = weights_[k + 1] * ((count - static_cast<double>(zero - k - 1)) / count);
    }

    /// Sum of the weights of all counts of `groups` groups whose e add up to `rest`, which is less
    /// than `groups`.
    double sum(std::int64_t groups, std::int64_t rest) {
        if (rest > squares_) return 0;  // the sum of squares of integers is at least their sum
        reach_ = root(groups * squares_) + 1;
        std::vector<double> from(table_size());
        from[at(0, 0)] = 1;
        for (std::int64_t left = groups; left > 0; --left) from = with_group(from, left, rest);
        double all = 0;
        for (std::int64_t q = 0; q <= squares_; ++q) all += from[at(rest, q)];
        return all;
    }

  private:
    static std::int64_t root(std::int64_t x) {
        return static_cast<std::int64_t>(std::sqrt(static_cast<double>(x)));
    }
    [[nodiscard]] std::size_t table_size() const {
        return static_cast<std::size_t>((2 * reach_ + 1) * (squares_ + 1));
    }
    [[nodiscard]] std::size_t at(std::int64_t sum, std::int64_t squares) const {
        return static_cast<std::size_t>((sum + reach_) * (squares_ + 1) + squares);
    }

    /// Adds a group when `left` groups remain; drops sums from which `rest` cannot be reached.
    [[nodiscard]] std::vector<double> with_group(const std::vector<double>& from, std::int64_t left,
                                                 std::int64_t rest) const {
        std::vector<double> to(table_size());
        for (std::int64_t s = -reach_; s <= reach_; ++s)
            for (std::int64_t q = 0; q <= squares_; ++q) {
                const double here = from[at(s, q)];
                if (here == 0 || (rest - s) * (rest - s) > left * (squares_ - q)) continue;
                const std::int64_t most = root(squares_ - q);
                const std::int64_t first = std::max({-most, least_, -reach_ - s});
                for (std::int64_t e = first; e <= std::min(most, reach_ - s); ++e)
                    to[at(s + e, q + e * e)] +=
                        here * weights_[static_cast<std::size_t>(e - least_)];
            }
        return to;
    }

    std::int64_t squares_;
    std::int64_t least_;
    std::int64_t reach_ = 0;  ///< bound of the absolute sum of e
    std::vector<double> weights_;
};

/// Probability that `count` of n points are where `expected` are expected. The powers of n, k and n
/// - k are separated from n! / (k! (n - k)!), so that nothing cancels.
double binomial_chance(double count, double n, double expected) {
    const auto off = [](double found, double right) {
        const double e = (found - right) / right;
        return right * (found > 0 ? (1 + e) * log_1p(e) - e : 1);
    };
    return exponential(log_excess(n) - log_excess(count) - log_excess(n - count) -
                       off(count, expected) - off(n - count, n - expected));
}

/// Enumerates the counts of unequal groups, the one with the largest expectation last.
class UnequalCounts {
  public:
    explicit UnequalCounts(std::span<const double> expected)
        : expected_(expected.begin(), expected.end()) {
        std::ranges::sort(expected_);
        behind_.resize(expected_.size());
        for (std::size_t k = expected_.size() - 1; k-- > 0;)
            behind_[k] = behind_[k + 1] + expected_[k + 1];
    }

    /// Upper bound of the number of counts with at most this statistic.
    [[nodiscard]] double most(double statistic) const {
        double count = 1;
        for (std::size_t k = 0; k + 1 < expected_.size(); ++k)
            count *= 2 * std::sqrt(statistic * expected_[k]) + 1;
        return count;
    }

    /// Probability that groups k, k + 1, ... share `left` points and add at most `room` to the
    /// statistic.
    [[nodiscard]] double chance(std::size_t k, std::uint64_t left, double room) const {
        const double here = expected_[k];
        const double rest = behind_[k];
        const auto points = static_cast<double>(left);
        const double off = points - here - rest;
        const double width = (room - off * off / (here + rest)) / (1 / here + 1 / rest);
        if (width < 0) return 0;
        const double middle = points * (here / (here + rest));
        const double low = std::max(std::ceil(middle - std::sqrt(width)), 0.0);
        const double high = std::min(std::floor(middle + std::sqrt(width)), points);
        if (low > high) return 0;
        double weight = binomial_chance(low, points, middle);
        double sum = 0;
        for (double count = low; count <= high; ++count) {
            const double used = (count - here) * (count - here) / here;
            const bool last = k + 2 == expected_.size();
            sum += last ? weight
                        : weight *
                              chance(k + 1, left - static_cast<std::uint64_t>(count), room - used);
            weight *= (points - count) / (count + 1) * (here / rest);
        }
        return sum;
    }

  private:
    std::vector<double> expected_;
    std::vector<double> behind_;  ///< sum of the expectations of later groups
};

}  // namespace

std::optional<double> exact_lower_tail(double statistic, std::uint64_t n, std::uint64_t groups) {
    const auto k = static_cast<double>(groups);
    const auto rest = static_cast<double>(n % groups);
    const double squares = static_cast<double>(n) * (statistic / k) + rest * (rest / k);
    const double steps = std::max(1.0, squares) * k;
    if (!(steps * std::max(1.0, squares) * std::sqrt(k) < 3 * most_steps)) return std::nullopt;
    const auto m = static_cast<std::int64_t>(n / groups);
    EqualCounts counts(m, static_cast<std::int64_t>(squares + 1e-6));
    const double sum =
        counts.sum(static_cast<std::int64_t>(groups), static_cast<std::int64_t>(n % groups));
    // ln(n! / (K^n m!^K m^r)) by ln n! = n ln n - n + log_excess(n).
    const auto points = static_cast<double>(n);
    const double ways = log_excess(points) - k * log_excess(static_cast<double>(m)) +
                        points * log_1p(rest / (points - rest)) - rest;
    return std::min(1.0, sum * exponential(ways));
}

std::optional<double> exact_lower_tail(double statistic, std::uint64_t n,
                                       std::span<const double> expected) {
    const UnequalCounts counts(expected);
    if (!(counts.most(statistic) < most_steps)) return std::nullopt;
    const double least = std::min(tie, 0.01 / static_cast<double>(n));
    return std::min(1.0, counts.chance(0, n, statistic * (1 + tie) + least));
}

}  // namespace stipple::analyzers
