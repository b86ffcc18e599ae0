// SPDX-License-Identifier: MIT
//
// Squared maximum mean discrepancy of points x_1, ..., x_n from a target, by sums over all pairs:
//
//     squared = total - 2/n sum_i mean(x_i) + n^-2 sum_i sum_k K(x_i, x_k)        (known mean)
//     squared = m^-2 sum K(y, y') - 2/(n m) sum K(x, y) + n^-2 sum K(x, x')       (points y)
//
// Values of K are rounded to multiples of 2^-70 times their upper bound. These are added, and the
// terms combined, as integers, so that the result is rounded only once.
//
// Cost    n^2 / 2 values of K, plus m^2 / 2 + n m for target points y; O(n + m) memory.
// Promise the same result for any number of threads and any order of the points; 0 if points and
//         target points are equal.
#pragma once

#include "math/kernels/kernel.hpp"
#include "stipple/run.hpp"

namespace stipple::kernels {

struct SquaredDiscrepancy {
    double squared;
    double error;     ///< bound on the error of `squared` from the rounding of K
    double expected;  ///< for n random points of the target: (mean of K(x,x) - total) / n
};

/// Squared discrepancy from the kernel's target, whose means it knows. If mean_diagonal() is
/// unknown, `expected` uses the mean K(x, x) of the points. @throws Error(limit) if values are too
/// large for a double
SquaredDiscrepancy squared_from_mean(const Kernel& kernel, const Columns& points,
                                     const RunContext& run);

/// Squared discrepancy from target points. @throws Error(limit) like squared_from_mean
SquaredDiscrepancy squared_from_points(const Kernel& kernel, const Columns& points,
                                       const Columns& target, const RunContext& run);

}  // namespace stipple::kernels
