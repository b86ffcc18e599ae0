// SPDX-License-Identifier: MIT
//
// Order of points in which every prefix has a small L2 discrepancy, chosen greedily. After m points
// p comes the point x that minimizes
//
//     2 sum_p K(x, p) + K(x, x) - 2 (m + 1) int K(x, y) dy.
//
// Cost  O(n^2 d).
#pragma once

#include <cstddef>
#include <vector>

#include "math/l2/kinds.hpp"
#include "stipple/run.hpp"

namespace stipple::optimized {

/// Returns the rows in that order; the first `kept` keep their positions.
std::vector<double> in_even_order(const std::vector<double>& rows, std::size_t dimension,
                                  std::size_t kept, l2::Kind kind, const l2::AxisWeights& weights,
                                  const RunContext& run);

}  // namespace stipple::optimized
