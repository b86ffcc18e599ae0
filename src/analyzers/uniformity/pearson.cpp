// SPDX-License-Identifier: MIT
#include "analyzers/uniformity/pearson.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analyzers/uniformity/cell_grid.hpp"
#include "core/error.hpp"
#include "core/machine/int128.hpp"
#include "math/functions/distributions.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple::analyzers {
namespace {

/// Largest number of unequal groups whose counts may be enumerated.
constexpr std::size_t most_unequal = 8;

/// Number of equal cells in a group, so that its expectation is at least 5. @throws Error(input) if
/// there are then fewer than two groups
std::uint64_t group_size(std::uint64_t n, std::uint64_t total) {
    const std::uint64_t size = (fewest_expected * total + n - 1) / n;
    if (size > total / 2) {
        const std::uint64_t half = total / 2;
        fail(ErrorKind::input, "chi-square needs at least {} points for {} cells; these are {}",
             (fewest_expected * total + half - 1) / half, total, n);
    }
    return size;
}

/// Probability that independent points fall into equal groups as evenly as possible: n mod K groups
/// have one point more than the others. The continuous chi-square distribution gives nearly 0.
double most_even_chance(std::uint64_t n, std::uint64_t groups) {
    const auto k = static_cast<double>(groups);
    const auto more = static_cast<double>(n % groups);
    const auto each = static_cast<double>(n / groups);
    const double ways = log_factorial(k) - log_factorial(more) - log_factorial(k - more);
    const double counts = log_factorial(static_cast<double>(n)) - (k - more) * log_factorial(each) -
                          more * log_factorial(each + 1);
    return std::min(1.0, exponential(ways + counts - static_cast<double>(n) * logarithm(k)));
}

/// Collects q_1, q_2, ... (see pearson.hpp) down to 1e-30, for groups of rising expectation.
class ModalProbabilities {
  public:
    explicit ModalProbabilities(std::uint64_t n) : whole_(static_cast<double>(n)), rest_(whole_) {}

    /// Adds a group. Not called for the last group, whose count follows from the other counts.
    void add(double expected) {
        if (!found_.empty() && found_.back() < 1e-30) return;
        rest_ -= expected;
        log_ -= log_excess(expected);
        found_.push_back(exponential(log_excess(whole_) + log_ - log_excess(rest_)));
    }

    std::vector<double> take() { return std::move(found_); }

  private:
    double whole_;
    double rest_;  ///< sum of the expectations of later groups
    double log_ = 0;
    std::vector<double> found_;
};

/// Cells whose probability may exceed 0, least probable first; points elsewhere are impossible.
std::vector<std::uint64_t> possible_cells(std::span<const std::uint64_t> counts,
                                          std::span<const Estimate> masses, Fit& found) {
    std::vector<std::uint64_t> cells;
    for (std::uint64_t c = 0; c < masses.size(); ++c) {
        found.mass_error += masses[c].error;
        if (masses[c].value + masses[c].error > 0)
            cells.push_back(c);
        else
            found.impossible += counts[c];
    }
    std::ranges::stable_sort(cells, {}, [&](std::uint64_t c) { return masses[c].value; });
    return cells;
}

/// A group of cells, with its expected and observed numbers of points.
struct Group {
    double expected = 0;
    double error = 0;  ///< error of `expected`
    std::uint64_t observed = 0;
    std::uint64_t cells = 0;

    void add(const Group& other) {
        expected += other.expected;
        error += other.error;
        observed += other.observed;
        cells += other.cells;
    }
};

/// Pools consecutive cells into groups that expect >= 5 points. @throws Error(input) below 2 groups
std::vector<Group> pool(const std::vector<Group>& cells, std::uint64_t n) {
    std::vector<Group> groups;
    Group open;
    for (const Group& cell : cells) {
        open.add(cell);
        if (open.expected < static_cast<double>(fewest_expected)) continue;
        groups.push_back(open);
        open = {};
    }
    if (groups.size() < 2)
        fail_with_hint(ErrorKind::input, "use more points, or other --cells",
                       "chi-square needs two groups of cells that expect {} points each; {} points "
                       "on {} cells give {}",
                       fewest_expected, n, cells.size(), groups.size());
    groups.back().add(open);
    return groups;
}

/// Largest error of the statistic due to the errors of expectations.
double statistic_error_of(double statistic, const std::vector<Group>& groups) {
    double square = 0;
    double ratio = 0;
    for (const Group& group : groups) {
        square += group.error * group.error / group.expected;
        ratio = std::max(ratio, group.error / group.expected);
    }
    if (square == 0) return 0;
    if (!(ratio < 1)) return std::numeric_limits<double>::infinity();
    const double length = std::sqrt(statistic);
    const double step = std::sqrt(square);
    const double above = (length + step) * (length + step) / (1 - ratio) - statistic;
    const double least = std::max(length - step, 0.0);
    return std::max(above, statistic - least * least / (1 + ratio));
}

}  // namespace

Fit fit_equal(std::span<const std::uint64_t> counts, std::uint64_t n, const RunContext& run) {
    const std::uint64_t total = counts.size();
    const std::uint64_t size = group_size(n, total);
    Fit found{.groups = total / size,
              .pooled = size > 1 ? total : 0,
              .points = n,
              .equal = total % size == 0};
    ModalProbabilities modal_probabilities(n);
    for (std::uint64_t g = 0; g < found.groups; ++g) {
        if (g % 65536 == 0) run.check_stop();
        const std::uint64_t first = g * size;
        const std::uint64_t last = g + 1 < found.groups ? first + size : total;
        std::uint64_t observed = 0;
        for (std::uint64_t c = first; c < last; ++c) observed += counts[c];
        // total * (observed - expected) is an integer, as all `total` cells are equally probable.
        const auto scaled = static_cast<double>(static_cast<Int128>(observed) * total -
                                                static_cast<Int128>(last - first) * n);
        const double expected = static_cast<double>(n) *
                                (static_cast<double>(last - first) / static_cast<double>(total));
        const double off = scaled / static_cast<double>(total);
        found.statistic += off * off / expected;
        if (g + 1 < found.groups) modal_probabilities.add(expected);
        if (!found.equal && found.groups <= most_unequal) found.expected.push_back(expected);
    }
    found.modal_probabilities = modal_probabilities.take();
    if (found.equal) found.most_even = most_even_chance(n, found.groups);
    return found;
}

Fit fit_masses(std::span<const std::uint64_t> counts, std::span<const Estimate> masses,
               std::uint64_t n, const RunContext& run) {
    Fit found;
    const auto order = possible_cells(counts, masses, found);
    double sum = 0;
    for (const std::uint64_t c : order) sum += masses[c].value;
    std::vector<Group> cells;
    for (const std::uint64_t c : order)
        cells.push_back({.expected = static_cast<double>(n) * (masses[c].value / sum),
                         .error = static_cast<double>(n) * masses[c].error,
                         .observed = counts[c],
                         .cells = 1});
    run.check_stop();
    const auto groups = pool(cells, n);
    found.groups = groups.size();
    found.points = n;
    found.equal = std::ranges::all_of(
        groups, [&](const Group& group) { return group.expected == groups.front().expected; });
    if (found.equal) found.most_even = most_even_chance(n, found.groups);
    ModalProbabilities modal_probabilities(n);
    for (const Group& group : groups) {
        const double off = static_cast<double>(group.observed) - group.expected;
        found.statistic += off * off / group.expected;
        if (!found.equal && groups.size() <= most_unequal) found.expected.push_back(group.expected);
        if (group.cells > 1) found.pooled += group.cells;
        if (&group != &groups.back()) modal_probabilities.add(group.expected);
    }
    found.modal_probabilities = modal_probabilities.take();
    found.statistic_error = statistic_error_of(found.statistic, groups);
    return found;
}

double Tails::two_sided() const { return std::min(1.0, 2 * std::min(upper, lower)); }

Tails chi_square_tails(double statistic, double freedom) {
    if (std::isinf(statistic)) return {.upper = 0, .lower = 1};
    return {.upper = chi_square_above(statistic, freedom),
            .lower = chi_square_below(statistic, freedom)};
}

namespace {

std::optional<double> exact_tail(double statistic, const Fit& fit) {
    if (fit.equal) return exact_lower_tail(statistic, fit.points, fit.groups);
    if (fit.expected.empty()) return std::nullopt;
    return exact_lower_tail(statistic, fit.points, fit.expected);
}

}  // namespace

Tails count_tails(double statistic, const Fit& fit) {
    Tails tails = chi_square_tails(statistic, fit.freedom());
    if (const auto exact = exact_tail(statistic, fit)) {
        tails.lower = *exact;
        tails.exact = true;
        return tails;
    }
    const auto all = static_cast<std::size_t>(fit.groups - 1);
    double mixed = 0;
    for (std::size_t s = 1; s <= fit.modal_probabilities.size(); ++s) {
        const auto others = static_cast<double>(all - s);
        mixed += fit.modal_probabilities[s - 1] *
                 (s < all ? chi_square_tails(statistic, others).lower : 1);
    }
    const double whole = fit.modal_probabilities.size() == all ? fit.modal_probabilities.back() : 0;
    tails.lower =
        std::min(1.0, std::max({tails.lower + tails.upper * whole, mixed, fit.most_even}));
    return tails;
}

double sidak(double p, double tests) { return p < 1 ? 0 - exp_minus_1(tests * log_1p(-p)) : 1; }

double p_value_of(const Tails& plain, const Tails* second) {
    const double p = plain.two_sided();
    return second ? sidak(std::min(p, second->two_sided()), 2) : p;
}

Tails sidak(std::span<const Tails> tests) {
    Tails least;
    for (const Tails& t : tests) {
        least.upper = std::min(least.upper, t.upper);
        least.lower = std::min(least.lower, t.lower);
    }
    const auto count = static_cast<double>(tests.size());
    return {.upper = sidak(least.upper, count), .lower = sidak(least.lower, count)};
}

Tails fisher(std::span<const Tails> tests) {
    constexpr double least = std::numeric_limits<double>::min();
    double upper = 0;
    double lower = 0;
    for (const Tails& t : tests) {
        upper -= 2 * logarithm(std::max(t.upper, least));
        lower -= 2 * logarithm(std::max(t.lower, least));
    }
    const double freedom = 2 * static_cast<double>(tests.size());
    return {.upper = chi_square_tails(upper, freedom).upper,
            .lower = chi_square_tails(lower, freedom).upper};
}

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
// contain T points together, O of them in the first, they add
//
//     (O - E)^2 / E + (T - O - F)^2 / F  =  (O - c)^2 (1 / E + 1 / F) + (T - E - F)^2 / (E + F),
//
// with c = T E / (E + F).
//
// Cost    equal groups: below K^1.5 D^2 steps, D = n X^2 / K; unequal ones: the number of counts.
//         Returns nullopt if there may be more than some millions, which take milliseconds.
// Promise sums of positive terms, with a relative error of about 1e-12; equal statistics are
//         included.

namespace {

constexpr double most_steps = 2e6;
constexpr double tie = 1e-12;  ///< tolerance for statistics that differ only by rounding

/// Sums of the weights m! m^e / (m + e)! of counts m + e of equal groups, by sum e and sum e^2.
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

    /// Sum of the weights over all counts of `groups` groups with sum e = `rest`, below `groups`.
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

    /// Adds one of the `left` remaining groups; drops sums that these cannot turn into `rest`.
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
    std::int64_t reach_ = 0;  ///< bound of |sum of e|
    std::vector<double> weights_;
};

/// Binomial probability of k = `count` of n points with mean `expected`. n!, k! and (n - k)! enter
/// by log_excess(), without the powers n^n, k^k and (n - k)^(n - k), which would cancel.
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

    /// Upper bound of the number of combinations of counts with at most this statistic.
    [[nodiscard]] double most(double statistic) const {
        double count = 1;
        for (std::size_t k = 0; k + 1 < expected_.size(); ++k)
            count *= 2 * std::sqrt(statistic * expected_[k]) + 1;
        return count;
    }

    /// Probability that `left` points in the groups k, k + 1, ... add at most `room` to X^2.
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
    std::vector<double> behind_;  ///< for each group, the sum of later groups' expectations
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
    // Logarithm of n! / (groups^n m!^groups m^rest), from ln n! = n ln n - n + log_excess(n).
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
