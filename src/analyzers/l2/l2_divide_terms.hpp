// SPDX-License-Identifier: MIT
//
// L2 discrepancies in three dimensions by divide and conquer, for kernels that are a sum of three
// products on either side of the diagonal. With c = x - 1/2, all kernels of l2_plane.hpp are
//
//     K = p(x) 1 + 1 q(y) + (-g(x)) g(y)   for x <= y,
//     p = a(c) - sigma c,  q = a(c) + sigma c,  g = sqrt(-s11) c,
//     a = a point's own part: a number, and multiples of c, c^2 and |c|.
//
// Points are halved along z, and the two halves, in order of y, are halved again and merged in
// order of x. A pair whose points part in both halvings is then the sum of 27 products of what
// belongs to either point alone, for which running sums are kept. Few points are taken pair by
// pair.
//
// Numbers are fixed, with 90 bits behind the point.
//
// Cost    O(n log^2 n) time, about 370 bytes a point: on one core 7 s for 131 072
//         points (all pairs: 18 s) and 80 s for 10^6 (20 minutes).
// Promise the same for any number of threads. The error that it states holds.
// Source  as in l2_divide.hpp.
#pragma once

#include <cstddef>
#include <vector>

#include "analyzers/l2/l2_kind.hpp"
#include "core/point_set.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::l2 {

/// Whether the terms of a kind of three axes leave room for their sums.
bool terms_divide(Kind kind, const std::vector<double>& weights);

/// Bytes that so many points need.
double divide_terms_memory(std::size_t count);

/// The squared discrepancy of up to 2^23 points. @param weights of the axes, or none
Square divide_terms_square(const PointSet& points, Kind kind, const std::vector<double>& weights,
                           const RunContext& run);

}  // namespace stipple::analyzers::l2
