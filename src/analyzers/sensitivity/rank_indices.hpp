// SPDX-License-Identifier: MIT
//
// First-order indices by ranks, from any sample of independent inputs. The runs are sorted by input
// i and divided into windows of neighbors, whose x_i are nearly the same. With z the centred
// output, V its variance, and n_g runs of mean z_g and variance s_g^2 in window g,
//
//     S_i = (sum n_g z_g^2 - chance) / (n V).
//
// For independent runs chance is sum s_g^2, and S_i is the mean of the products of different runs
// of a window. On low-discrepancy points the means z_g have smaller errors. Then chance is
// estimated from their second differences, W / (W - 2) sum n_g (z_(g-1) - 2 z_g + z_(g+1))^2 / 6
// for W windows, if that is less. A window has sqrt(n) runs or more and ends where x_i changes, so
// that runs of equal x_i stay together, and their order does not matter.
//
// With windows of two this would nearly be the statistic of Chatterjee, and of Gamboa et al., of
// each run and its next neighbor. That has errors of a fifth and more on low-discrepancy points,
// whose neighbors in one coordinate are related in the others; a window of many is well spread
// there.
//
// The interval extends by Student's quantile times the standard error se to both sides, with the
// degrees of freedom of W or sqrt(n) windows. With m_j the mean of the other runs in the window of
// run j,
//
//     (n V se)^2 = n var(2 z_j m_j - z_g^2 - S_i z_j^2) + sum 2 n_g / (n_g - 1) s_g^4,
//
// where z_g^2 is without its chance. The first term is the influence of run j on the index, the
// second is due to pairs of runs. The upper end is extended by what windows may hide of E(f | x_i),
// the loss with windows of twice the size,
//
//     sum_g (n_g n_(g+1) (z_g - z_(g+1))^2 - n_(g+1) s_g^2 - n_g s_(g+1)^2)
//         / (n_g + n_(g+1)) / (n V),
//
// for both ways to join neighbors. If x_i is constant in both, they hide nothing. Intervals at the
// level of 95 % contain the index in at least 90 % of samples, for n from 20 to 1000, on the
// functions of tests/oracles/sensitivity.py.
//
// Shape   four runs or more, twenty for intervals.
// Cost    O(k n log n).
// Beware  indices are too small by the fraction of the variance that E(f | x_i) has within windows,
//         O(1/n); for independent runs too large by (1 - S_i) 0.8 n^(-3/4), as the lesser chance is
//         taken. Outputs with rare huge values, whose variance n runs do not show, have intervals
//         that are too short. Runs of structured designs share coordinates, which adds other
//         inputs' effects. The bootstrap is useless here: a resample has runs twice, as their own
//         neighbors.
// Source  E. Plischke, E. Borgonovo, C. L. Smith, Eur. J. Oper. Res. 226 (2013) 536-550,
//         doi:10.1016/j.ejor.2012.11.047 (windows); F. Gamboa, P. Gremaud, T. Klein, A. Lagnoux,
//         Bernoulli 28 (2022) 2345-2374, doi:10.3150/21-BEJ1421 (neighbors); Z. Lin, F. Han,
//         Biometrika 110 (2023) 283-299, doi:10.1093/biomet/asac048 (several neighbors).
#pragma once

#include "analyzers/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

/// Leaves out failed runs. @throws Error(input) if too few remain
Effects rank_indices(const Inputs& inputs, const Response& response, const Setting& setting,
                     const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
