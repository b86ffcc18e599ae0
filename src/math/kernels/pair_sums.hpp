// SPDX-License-Identifier: MIT
//
// Squared maximum mean discrepancies of points x_1, ..., x_n from a target, by sums over all pairs:
//
//     squared = total - 2/n sum_i mean(x_i) + n^-2 sum_i sum_k K(x_i, x_k)        (known mean)
//     squared = m^-2 sum K(y, y') - 2/(n m) sum K(x, y) + n^-2 sum K(x, x')       (points y)
//
// Values of K are rounded to multiples of 2^-70 of a bound of them all and added as whole numbers;
// the terms are combined as such, and rounded once.
//
// Cost    n^2 / 2 values of K, with points y m^2 / 2 + n m more; O(n + m) memory.
// Promise the same for any number of threads and any order of the points; 0 from points that are
//         the same as the target's.
#pragma once

#include "math/kernels/kernel.hpp"
#include "stipple/run.hpp"

namespace stipple::kernels {

struct SquaredDiscrepancy {
    double squared;
    double error;     ///< `squared` is off by at most this, by the rounding of K
    double expected;  ///< of n independent points of the target: (mean of K(x,x) - total) / n
};

/// From what the kernel knows the mean of; where its target is unknown, `expected` takes the mean
/// of the points' own K(x, x). @throws Error(limit) where values are too large for a double
SquaredDiscrepancy squared_from_mean(const Kernel& kernel, const Columns& points,
                                     const RunContext& run);

/// From other points. @throws as above
SquaredDiscrepancy squared_from_points(const Kernel& kernel, const Columns& points,
                                       const Columns& target, const RunContext& run);

}  // namespace stipple::kernels
