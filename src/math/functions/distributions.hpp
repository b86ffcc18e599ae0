// SPDX-License-Identifier: MIT
//
// Distribution functions and quantiles of test statistics.
//
// Promise accurate to nearly the last digit; less accurate, without a warning, far out in a tail.
#pragma once

#include "math/functions/log_excess.hpp"

namespace stipple {

/// Probability that a chi-square variable with `freedom` degrees of freedom is at most, or at
/// least, `statistic`.
double chi_square_below(double statistic, double freedom);
double chi_square_above(double statistic, double freedom);

/// Noncentrality at which a chi-square test rejects a statistic as too large with probability 0.9.
/// `level` is the level of the two-sided test.
double detectable_noncentrality(double freedom, double level);

/// Probability that Student's t with `freedom` degrees of freedom is above t, 0 <= t <= 1e150.
double student_above(double t, double freedom);

/// The value that Student's t with `freedom` degrees of freedom exceeds with probability `above`.
double student_quantile(double above, double freedom);

}  // namespace stipple
