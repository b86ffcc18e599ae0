// SPDX-License-Identifier: MIT
//
// An order of points in which every prefix has an L2 discrepancy as small as a greedy choice makes it:
// next comes the point x for which, with m points p before it,
//
//     2 sum_p K(x, p) + K(x, x) - 2 (m + 1) int K(x, y) dy     is least.
//
// Cost  O(n^2 d).
#pragma once

#include <cstddef>
#include <vector>

#include "math/l2/kinds.hpp"
#include "stipple/run.hpp"

namespace stipple::optimized {

/// The rows in that order; the first `kept` stay where they are.
std::vector<double> in_even_order(const std::vector<double>& rows, std::size_t dimension,
                                  std::size_t kept, l2::Kind kind, const l2::AxisWeights& weights,
                                  const RunContext& run);

}  // namespace stipple::optimized
