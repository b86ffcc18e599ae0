// SPDX-License-Identifier: MIT
//
// The chance that Pearson's statistic of n independent points is at most so large, summed over all
// counts that make it so: exact, where these are few enough to be gone through.
//
// Equal groups: with counts m + e_i, m = n div K, the statistic is K / n times a whole number,
//
//     X^2 = K / n (sum e_i^2 - r^2 / K),    sum e_i = r = n mod K,
//
// and the weights 1 / (m + e_i)! of the groups are convolved, one after the other, over the pairs
// (sum e_i, sum e_i^2).
//
// Unequal groups: group after group, the counts that leave room for the others; each is binomial
// among the points that are left, and of groups that expect E and F and hold T together
//
//     (O - E)^2 / E + (T - O - F)^2 / F  =  (O - c)^2 (1 / E + 1 / F) + (T - E - F)^2 / (E + F),
//
// c = T E / (E + F), is the least that they add.
//
// Cost    equal groups: below K^1.5 D^2 steps, D = n X^2 / K; unequal ones: the counts there are.
//         Nothing is given where these may be above some millions, which take milliseconds.
// Promise sums of positive terms, right to about 1e-12; equal statistics are counted in.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace stipple::analyzers {

/// Of groups of equal probability, no more than there are points.
std::optional<double> exact_lower_tail(double statistic, std::uint64_t n, std::uint64_t groups);

/// Of groups that expect so many points each, n together; 2 or more.
std::optional<double> exact_lower_tail(double statistic, std::uint64_t n,
                                       std::span<const double> expected);

}  // namespace stipple::analyzers
