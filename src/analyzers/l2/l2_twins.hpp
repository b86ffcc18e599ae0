// SPDX-License-Identifier: MIT
//
// L2 discrepancies of points in any dimension from all pairs, as l2_pairs.hpp, in numbers of twice
// the digits of a double: what cancels between the sums is at most all but 2^-97 of them.
//
// On every axis the factor of two points is
//
//     a_i + a_k + p x_i x_k + s |x_i - x_k|,
//
// with a, of the point alone, and p and s, of the axis, pairs of doubles. So are the factors and
// their products.
//
// Cost    n^2 d / 2 factors, about 4 ns each on one core with 256-bit vectors: a number of times
//         what those of l2_pairs.hpp take.
// Promise the same for any number of threads and any width of vectors. `error` bounds what rounding
//         did.
// Source  T. J. Dekker, Numer. Math. 18 (1971) 224-242, doi:10.1007/BF01397083 (numbers in pairs).
#pragma once

#include <cstddef>
#include <vector>

#include "analyzers/l2/l2_kind.hpp"
#include "core/point_set.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::l2 {

/// Whether that takes no more than a fraction of a second.
bool twins_are_quick(std::size_t count, std::size_t dimension);

/// The squared discrepancy. @param weights of the axes, or none
Square twin_square(const PointSet& points, Kind kind, const std::vector<double>& weights,
                   const RunContext& run);

}  // namespace stipple::analyzers::l2
