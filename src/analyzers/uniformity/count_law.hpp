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
// Unequal groups: counts are enumerated group by group, as long as they leave room for the others.
// Each is binomial among the remaining points. If groups that expect E and F hold T together, they
// add at least
//
//     (O - E)^2 / E + (T - O - F)^2 / F  =  (O - c)^2 (1 / E + 1 / F) + (T - E - F)^2 / (E + F),
//
// with c = T E / (E + F).
//
// Cost    equal groups: below K^1.5 D^2 steps, D = n X^2 / K; unequal ones: the number of counts.
//         Returns nullopt if there may be more than some millions, which take milliseconds.
// Promise sums of positive terms, with a relative error of about 1e-12; equal statistics are
//         included.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace stipple::analyzers {

/// For groups of equal probability, at most n of them.
std::optional<double> exact_lower_tail(double statistic, std::uint64_t n, std::uint64_t groups);

/// For two or more groups with these expected numbers of points, n together.
std::optional<double> exact_lower_tail(double statistic, std::uint64_t n,
                                       std::span<const double> expected);

}  // namespace stipple::analyzers
