// SPDX-License-Identifier: MIT
//
// Pearson's statistic over groups of cells, its tails, and how several tests become one.
//
//     X^2 = sum_i (O_i - E_i)^2 / E_i,    degrees of freedom = groups - 1
//
// Groups of cells of equal probability are neighbours in the order of the cells, as many to a group
// as it takes to expect 5 points; what is left over goes to the last group. Cells of unequal
// probability are first sorted by it, the least probable first (equal ones by their number), and
// put together until a group expects 5; what is left over goes to the last group. So all groups
// expect at least 5, and cells that do so alone stay alone.
//
// Where expectations are known within errors d_i, X^2 is so, too: the statistic is the squared
// length of (O - E) / sqrt(E), which moves by at most D = sqrt(sum d_i^2 / E_i), and the E below
// are off by a factor of at most 1 + d_i / E_i:
//
//     (X - D)^2 / (1 + r)  <=  right statistic  <=  (X + D)^2 / (1 - r),    r = max d_i / E_i
//
// Counts are whole, so that few groups leave few values to X^2, and a value as small as any has a
// chance that chi-square, being continuous, takes for next to nothing. The lower tail is exact where
// the counts can be gone through (count_law.hpp). Elsewhere, let q_s be the chance of the
// most probable counts in the s groups that expect the least, and F_f the chi-square distribution
// function (F_0 = 1). Taking these s groups as they are and the others as a continuum gives
// q_s F_(f-s), and a ball holds about as many lattice points as its volume and those of its
// sections make together, so that
//
//     lower tail = max(F_f + q_f (1 - F_f), sum_{s=1..f} q_s F_(f-s)),    f = degrees of freedom,
//
// not below the chance of the most even counts there are, where that is known. Where it takes the
// place of an exact one, of equal groups, it was found within 5 % of it for tails down to 1e-4.
//
// Promise equal cells: (K (O - E))^2 is worked out in whole numbers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

struct Fit {
    double statistic = 0;
    std::uint64_t groups = 0;
    std::uint64_t pooled = 0;      ///< cells that were put together with others
    std::uint64_t impossible = 0;  ///< points in cells of probability 0
    double mass_error = 0;         ///< sum over the cells' probabilities
    double statistic_error = 0;    ///< most by which it may be off the right statistic
    double most_even = 0;          ///< chance of the least statistic there is; 0: not known
    std::vector<double> modal_probabilities = {};  ///< q_1, q_2, ... as far as they matter
    std::uint64_t points = 0;
    std::vector<double> expected = {};  ///< of groups, where they are few and not equal
    bool equal = false;                 ///< all groups expect as many points

    [[nodiscard]] double freedom() const { return static_cast<double>(groups - 1); }
};

/// Cells of equal probability. @throws Error(input) where fewer than two groups come of it.
Fit fit_equal(std::span<const std::uint64_t> counts, std::uint64_t n, const RunContext& run);

/// Cells of these probabilities, of which there is one for each count. @throws Error(input)
Fit fit_masses(std::span<const std::uint64_t> counts, std::span<const Estimate> masses,
               std::uint64_t n, const RunContext& run);

/// The chances that what is right gives so large a statistic, and so small a one.
struct Tails {
    double upper = 1;
    double lower = 1;
    bool exact = false;  ///< the lower one is

    [[nodiscard]] double two_sided() const;
};

/// Of chi-square with these degrees of freedom.
Tails chi_square_tails(double statistic, double freedom);

/// The same with the lower tail that whole counts have, for a statistic on the groups of `fit`.
Tails count_tails(double statistic, const Fit& fit);

/// One of several independent tests: the least of their p-values, 1 - (1 - p)^T; each tail by
/// itself.
Tails sidak(std::span<const Tails> tests);

/// -2 sum ln p is chi-square with 2 T degrees of freedom; each tail by itself.
Tails fisher(std::span<const Tails> tests);

/// 1 - (1 - p)^tests.
double sidak(double p, double tests);

/// Two-sided, of one test, or of the smaller p of two.
double p_value_of(const Tails& plain, const Tails* second);

}  // namespace stipple::analyzers
