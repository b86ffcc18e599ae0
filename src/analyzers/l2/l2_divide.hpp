// SPDX-License-Identifier: MIT
//
// L2 discrepancies in three and four dimensions by divide and conquer, for kernels that are one
// product on either side of the diagonal:
//
//     K(x, y) = L(x) U(y)   for x <= y.
//
//                L                        U
//     star       1                        1 - y
//     modified   1                        1 + w (1 - y)
//     extreme    x                        1 - y
//     centered   1 + w max(x - 1/2, 0)    1 + w max(1/2 - y, 0)
//
// Points are halved along the last axis. A pair from both halves then has the factor L of its lower
// point and U of its upper one: as weights of the points, these leave the same problem on one axis
// less, between two colors. Halving such points along their next axis gives two problems between
// lower points of one color and upper points of the other; on the last axis a running sum is left,
// taken while points are merged along it.
//
// Numbers are fixed: weights have 96 bits behind the point, sums of their products are exact.
//
// Cost    O(n log^(d-1) n) time: on one core 0.3 s for 65 536 points in three dimensions and 8 s
//         for 10^6 (all pairs: 0.6 s and 140 s), 8 s for 200 000 in four. 128 (d - 1) bytes a
//         point.
// Beware  periodic, wraparound, mixture and diaphony are sums of three such products: in three
//         dimensions they are left to l2_divide_terms.hpp, in four a point would have 81 weights,
//         and all pairs are quicker.
// Promise the same for any number of threads. The square is off by less than 2^-80 and its own
//         rounding; and by what coordinates lose that are no multiples of 2^-63, most below 2^-10.
// Source  S. Heinrich, Math. Comp. 65 (1996) 1621-1633, doi:10.1090/S0025-5718-96-00756-4;
//         K. Frank, S. Heinrich, J. Complexity 12 (1996) 287-314.
#pragma once

#include <cstddef>
#include <vector>

#include "analyzers/l2/l2_kind.hpp"
#include "core/point_set.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::l2 {

/// Whether divide_square() takes such points.
bool divides(std::size_t dimension, Kind kind, const std::vector<double>& weights);

/// Whether it is faster than all pairs are.
bool divide_wins(std::size_t count, std::size_t dimension, Kind kind);

/// Bytes that it needs.
double divide_memory(std::size_t count, std::size_t dimension, Kind kind);

/// The squared discrepancy. @param weights of the axes, or none
Square divide_square(const PointSet& points, Kind kind, const std::vector<double>& weights,
                     const RunContext& run);

}  // namespace stipple::analyzers::l2
