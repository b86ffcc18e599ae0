// SPDX-License-Identifier: MIT
//
// Distribution functions and quantiles of test statistics.
//
// Promise to nearly the last digit; where that is out of reach, far out in a tail, no error is
//         raised.
#pragma once

#include "math/functions/log_excess.hpp"

namespace stipple {

/// Chance that chi-square with these degrees of freedom is at most so large, or at least.
double chi_square_below(double statistic, double freedom);
double chi_square_above(double statistic, double freedom);

/// The noncentrality at which a chi-square test of that two-sided level has too large a statistic
/// with probability 0.9.
double detectable_noncentrality(double freedom, double level);

/// What Student's t with these degrees of freedom exceeds with the probability `above`.
double student_quantile(double above, double freedom);

}  // namespace stipple
