// SPDX-License-Identifier: MIT
//
// L2 discrepancies in three and four dimensions by divide and conquer, for kernels that are a sum
// of a few products on either side of the diagonal,
//
//     K(x, y) = sum_r L_r(x) U_r(y)   for x <= y.
//
// One product is enough for
//
//                L                        U
//     star       1                        1 - y
//     modified   1                        1 + w (1 - y)
//     extreme    x                        1 - y
//     centered   1 + w max(x - 1/2, 0)    1 + w max(1/2 - y, 0)
//
// and all kernels of kinds.hpp are three: with c = x - 1/2, a = a number and multiples of c, c^2
// and |c|, and g = sqrt(-s11) c,
//
//     K = (a(c) - sigma c) 1 + 1 (a(c') + sigma c') - g(c) g(c')   for c <= c'.
//
// Points are halved along the last axis. A pair from both halves has L of its lower point and U of
// its upper one as factors: with these as weights of the points, the same problem on one axis less
// is left, between two colors. Halving such points along their next axis gives two problems between
// lower points of one color and upper points of the other. On the last axis running sums are left,
// taken while points are merged along it. Few points are taken pair by pair.
//
// Numbers are fixed, with 90 bits behind the point.
//
// Cost    O(n log^(d-1) n) time: on one core 0.3 s for 65 536 points in three dimensions and 8 s
//         for 10^6 (all pairs: 0.6 s and 140 s), 8 s for 200 000 in four; with three products 7 s
//         for 131 072 points (all pairs: 18 s) and 80 s for 10^6 (20 minutes).
// Beware  in four dimensions three products a kernel would be 81 weights of a point, and all pairs
//         are quicker.
// Promise the same for any number of threads. `error` bounds the rounding, also that of coordinates
//         that are no multiples of 2^-63, most of them below 2^-10.
// Source  S. Heinrich, Math. Comp. 65 (1996) 1621-1633, doi:10.1090/S0025-5718-96-00756-4;
//         K. Frank, S. Heinrich, J. Complexity 12 (1996) 287-314.
#pragma once

#include <cstddef>

#include "analyzers/l2/kinds.hpp"
#include "core/point_set.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers::l2 {

/// Whether divide_square() takes such points.
bool divides(std::size_t dimension, Kind kind, const AxisWeights& weights);

/// Whether it is faster than all pairs are.
bool divide_wins(std::size_t count, std::size_t dimension, Kind kind);

/// Bytes that it needs.
double divide_memory(std::size_t count, std::size_t dimension, Kind kind);

/// The squared discrepancy of points that divides() and divide_wins() let pass, or fewer.
Square divide_square(const PointSet& points, Kind kind, const AxisWeights& weights,
                     const RunContext& run);

}  // namespace stipple::analyzers::l2
