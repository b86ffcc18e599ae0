// SPDX-License-Identifier: MIT
//
// Distribution functions and quantiles of test statistics.
//
// Promise to nearly the last digit; where that is out of reach, far out in a tail, no error is
//         raised.
#pragma once

namespace stipple {

/// Chance that chi-square with these degrees of freedom is at most so large, or at least.
double chi_square_below(double statistic, double freedom);
double chi_square_above(double statistic, double freedom);

/// The noncentrality with which chi-square has the probability `miss` not to exceed what the
/// central one exceeds with the probability `level`.
double noncentrality_for(double freedom, double level, double miss);

/// What Student's t with these degrees of freedom exceeds with the probability `above`.
double student_quantile(double above, double freedom);

}  // namespace stipple
