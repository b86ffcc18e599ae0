// SPDX-License-Identifier: MIT
//
// L2 discrepancies of points in any dimension from the sum over all pairs of points:
//
//     D^2 = C - 2/n sum_i prod_j f_j(x_ij) + n^-2 sum_ik prod_j K_j(x_ij, x_kj)
//
// with f_j the mean of K_j(x, .) and C the product of the means of f_j. What rounding takes from
// every factor and product is kept: each is a double and an error term, which has its own rounding
// alone. Of the sum over pairs, all but 2^-80 may cancel.
//
// On each axis K is one of these, times a constant, with t = |x - y|:
//
//     min(g_x, g_y)                     star, modified; two of them: extreme, centered
//     a + t (t - 1)                     periodic, wraparound, diaphony
//     h_x + h_y + t (t - 3/2)           mixture
//     a + min(x, y) min(1 - x, 1 - y)   extreme with weights
//
// Coordinates that are no multiples of 2^-53 have an error term, too. Factors are scaled by powers
// of two so that the largest product of a point with itself stays near 1 from axis to axis: these
// kernels are positive definite, so no product is larger.
//
// Shape   n x d points in [0, 1].
// Cost    n^2 d / 2 factors, fewer where blocks of points lie beside each other on an axis; on one
//         core with 512-bit vectors 0.25 ns each for the star, 0.2 for the centered kernel (half as
//         much again where coordinates are no multiples of 2^-53), 0.6 for the wraparound and 0.75
//         for the mixture one; with 256-bit vectors twice as long. Needs an instruction for a b + c
//         with one rounding.
// Promise the same for any number of threads and any width of vectors. `error` bounds what rounding
//         did.
// Source  T. Ogita, S. M. Rump, S. Oishi, SIAM J. Sci. Comput. 26 (2005) 1955-1988,
//         doi:10.1137/030601818 (compensated sums); S. Graillat, IEEE Trans. Comput. 58 (2009)
//         994-1000 (products).
#pragma once

#include <cstddef>

#include "analyzers/l2/kinds.hpp"
#include "core/machine/vectors.hpp"
#include "core/point_set.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers::l2 {

/// The squared discrepancy; not finite where it is beyond the largest double.
Square pair_square(const PointSet& points, Kind kind, const AxisWeights& weights,
                   const RunContext& run, Vectors widest = Vectors::eights);

/// Bytes that it needs.
double pair_memory(std::size_t count, std::size_t dimension);

}  // namespace stipple::analyzers::l2
