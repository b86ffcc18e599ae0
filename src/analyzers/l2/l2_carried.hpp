// SPDX-License-Identifier: MIT
//
// L2 discrepancies of points in any dimension from all pairs, as l2_pairs.hpp, with what rounding
// takes from every factor and product carried along: each is a double and a correction, which has
// its own rounding alone. Of the sum over pairs, all but 2^-80 may cancel.
//
// On each axis the factor is one of these, times a constant, with t = |x - y|:
//
//     min(g_x, g_y)                     star, modified; two of them: extreme, centered
//     a + t (t - 1)                     periodic, wraparound, diaphony
//     h_x + h_y + t (t - 3/2)           mixture
//     a + min(x, y) min(1 - x, 1 - y)   extreme with weights
//
// Coordinates that are no multiples of 2^-53 have a correction, too.
//
// Shape   n x d points in [0, 1], d <= 400, weights such that no product leaves the doubles' range.
// Cost    n^2 d / 2 factors, fewer where blocks of points lie beside each other on an axis; on one
//         core with 512-bit vectors 0.15 ns each for the star, 0.2 for the centered kernel, 0.4 for
//         the wraparound and 0.5 for the mixture one, about half as much again where coordinates or
//         values have corrections; with 256-bit vectors twice as long. Needs an instruction for
//         a b + c with one rounding.
// Promise the same for any number of threads and any width of vectors. `error` bounds what rounding
//         did.
// Source  T. Ogita, S. M. Rump, S. Oishi, SIAM J. Sci. Comput. 26 (2005) 1955-1988,
//         doi:10.1137/030601818 (sums with corrections); S. Graillat, IEEE Trans. Comput. 58 (2009)
//         994-1000 (products).
#pragma once

#include <cstddef>
#include <vector>

#include "analyzers/l2/l2_kind.hpp"
#include "core/point_set.hpp"
#include "core/run_context.hpp"
#include "core/vectors.hpp"

namespace stipple::analyzers::l2 {

/// Whether carried_square() takes such points.
bool carries(std::size_t dimension, Kind kind, const std::vector<double>& weights);

/// The squared discrepancy. @param weights of the axes, or none
Square carried_square(const PointSet& points, Kind kind, const std::vector<double>& weights,
                      const RunContext& run, Vectors widest = Vectors::eights);

}  // namespace stipple::analyzers::l2
