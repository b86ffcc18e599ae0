// SPDX-License-Identifier: MIT
//
// Pearson's statistic over groups of cells, its tails, and the combination of several tests.
//
//     X^2 = sum_i (O_i - E_i)^2 / E_i,    degrees of freedom = groups - 1
//
// Cells of equal probability are grouped in their order, with as many in a group as needed to
// expect 5 points; remaining cells go to the last group. Cells of unequal probability are first
// sorted, the least probable first (equal ones by their index), and then pooled until a group
// expects 5; remaining cells go to the last group. So all groups expect at least 5, and at most one
// cell that expects 5 alone is pooled.
//
// If expectations are known within errors d_i, X^2 has an error, too. X^2 is the squared length of
// (O - E) / sqrt(E), which changes by at most D = sqrt(sum d_i^2 / E_i), and the divisors E are
// wrong by a factor of at most 1 + d_i / E_i:
//
//     (X - D)^2 / (1 + r)  <=  right statistic  <=  (X + D)^2 / (1 - r),    r = max d_i / E_i
//
// Counts are integers, so with few groups X^2 takes few values. Its smallest values then have a
// probability that is almost 0 for the continuous chi-square distribution. The lower tail is exact
// if the counts can be enumerated (pearson.cpp). Otherwise, let q_s be the probability of the
// most probable counts in the s groups with the smallest expectations, and F_f the chi-square
// distribution function (F_0 = 1). With these s groups fixed and the others treated as continuous,
// the probability is q_s F_(f-s). The number of lattice points in a ball is about the sum of its
// volume and the volumes of its sections, so
//
//     lower tail = max(F_f + q_f (1 - F_f), sum_{s=1..f} q_s F_(f-s)),    f = degrees of freedom,
//
// and at least the probability of the most even counts, if that is known. Compared with exact
// values for equal groups, its error was below 5 % for tails down to 1e-4.
//
// Promise equal cells: K (O - E) is computed in integers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

struct Fit {
    double statistic = 0;
    std::uint64_t groups = 0;
    std::uint64_t pooled = 0;      ///< cells pooled with others
    std::uint64_t impossible = 0;  ///< points in cells of probability 0
    double mass_error = 0;         ///< sum of the errors of the cells' probabilities
    double statistic_error = 0;    ///< largest error of the statistic due to those errors
    double most_even = 0;          ///< probability of the smallest possible statistic; 0: unknown
    std::vector<double> modal_probabilities = {};  ///< q_1, q_2, ... (see the top) down to 1e-30
    std::uint64_t points = 0;
    std::vector<double> expected = {};  ///< expectations of groups, if few and unequal
    bool equal = false;                 ///< whether all groups have the same expectation

    [[nodiscard]] double freedom() const { return static_cast<double>(groups - 1); }
};

/// Fit for cells of equal probability. @throws Error(input) if the cells make fewer than two groups
Fit fit_equal(std::span<const std::uint64_t> counts, std::uint64_t n, const RunContext& run);

/// Fit for cells with these probabilities, one per count. @throws Error(input)
Fit fit_masses(std::span<const std::uint64_t> counts, std::span<const Estimate> masses,
               std::uint64_t n, const RunContext& run);

/// Probabilities, under the hypothesis, of a statistic >= (upper) and <= (lower) the given one.
struct Tails {
    double upper = 1;
    double lower = 1;
    bool exact = false;  ///< whether the lower tail is exact

    [[nodiscard]] double two_sided() const;
};

/// Tails of chi-square with these degrees of freedom.
Tails chi_square_tails(double statistic, double freedom);

/// Like chi_square_tails(), with the lower tail for integer counts in the groups of `fit`.
Tails count_tails(double statistic, const Fit& fit);

/// Probability that the statistic of n independent points is at most `statistic`, for at most n
/// groups of equal probability; nullopt if it would take too long.
std::optional<double> exact_lower_tail(double statistic, std::uint64_t n, std::uint64_t groups);

/// The same for two or more groups with the given expected numbers of points, whose sum is n.
std::optional<double> exact_lower_tail(double statistic, std::uint64_t n,
                                       std::span<const double> expected);

/// Sidak's combination of independent tests, for each tail: 1 - (1 - p)^T of the smallest p.
Tails sidak(std::span<const Tails> tests);

/// Fisher's combination, for each tail: -2 sum ln p is chi-square with 2 T degrees of freedom.
Tails fisher(std::span<const Tails> tests);

/// 1 - (1 - p)^tests, without loss of digits for small p.
double sidak(double p, double tests);

/// Two-sided p-value of one test or, for two tests, Sidak's combination of the smaller p.
double p_value_of(const Tails& plain, const Tails* second);

}  // namespace stipple::analyzers
