// SPDX-License-Identifier: MIT
//
// L2 discrepancies of points in any dimension, from the sum over all pairs of points:
//
//     D^2 = C - 2/n sum_i prod_j f_j(x_ij) + n^-2 sum_ik prod_j K_j(x_ij, x_kj)
//
// with f_j the mean of K_j(x, .) and C the product of the means of f_j. On each axis, K is one of
//
//     min(g_i, g_k)                       star, modified
//     min(g_i, g_k) min(h_i, h_k)         extreme; centered: 1 + min(|a_i|, |a_k|) where a = x -
//     1/2
//                                         has the same sign at both, else 1
//     1 + min(g_i, g_k) min(h_i, h_k)     extreme with weights
//     a + t (t - s)                       periodic, wraparound, diaphony; t = s |x_i - x_k|
//     h_i + h_k + t (t - 3/2 s)           mixture
//
// Shape   points n x d in [0, 1].
// Cost    n^2 d / 2 factors; about 0.09 ns each for the star and 0.2 ns for the wraparound on one
//         core with 256-bit vectors.
// Promise the same for any number of threads and any width of vectors. `error` bounds what rounding
//         did: a few 2^-53 of the sum over pairs for each axis. It is seldom more than a hundredth
//         of that.
#pragma once

#include <vector>

#include "analyzers/l2/l2_kind.hpp"
#include "core/point_set.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::l2 {

/// @param weights of the axes, or none
Square pair_square(const PointSet& points, Kind kind, const std::vector<double>& weights,
                   const RunContext& run);

}  // namespace stipple::analyzers::l2
