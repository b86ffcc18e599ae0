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

/// The noncentrality at which a chi-square test of that two-sided level has too large a statistic
/// with probability 0.9.
double detectable_noncentrality(double freedom, double level);

/// ln(n! / (n^n e^-n)), which is nearly ln(2 pi n) / 2; 0 at 0.
double log_excess(double n);

/// ln n!
double log_factorial(double n);

/// What Student's t with these degrees of freedom exceeds with the probability `above`.
double student_quantile(double above, double freedom);

}  // namespace stipple
