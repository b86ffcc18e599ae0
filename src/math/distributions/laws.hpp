// SPDX-License-Identifier: MIT
//
// Makers of distributions, whose parameters are not checked here: that is for families.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "math/distributions/marginal.hpp"

namespace stipple {

// Closed forms.
MarginalPtr uniform_law(double low, double high);
MarginalPtr log_uniform_law(double low, double high);
MarginalPtr triangular_law(double low, double mode, double high);
MarginalPtr normal_law(double mean, double deviation);
/// @param mu, sigma mean and standard deviation of the logarithm
MarginalPtr lognormal_law(double mu, double sigma);
MarginalPtr exponential_law(double rate);
MarginalPtr weibull_law(double shape, double scale);
MarginalPtr gumbel_law(double location, double scale);

// By incomplete functions.
MarginalPtr gamma_law(double shape, double scale);
MarginalPtr beta_law(double a, double b, double low, double high);
MarginalPtr student_t_law(double degrees, double location, double scale);

// Discrete.
MarginalPtr integers_law(double low, double high);
MarginalPtr poisson_law(double mean);
MarginalPtr binomial_law(double trials, double probability);
/// Each number of a list as likely as it often stands there.
MarginalPtr empirical_law(std::vector<double> values);

/// Straight between the sorted numbers of a list, no two of them the same: between two neighbours
/// of n there lies the probability 1 / (n - 1).
MarginalPtr interpolated_law(std::vector<double> values);

}  // namespace stipple
