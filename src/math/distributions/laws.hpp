// SPDX-License-Identifier: MIT
//
// Constructors of distributions. Parameters are checked in families.hpp, not here.
#pragma once

#include <cstdint>
#include <vector>

#include "math/distributions/marginal.hpp"

namespace stipple {

// Distributions with closed forms.
MarginalPtr uniform_law(double low, double high);
MarginalPtr log_uniform_law(double low, double high);
MarginalPtr triangular_law(double low, double mode, double high);
MarginalPtr normal_law(double mean, double deviation);
/// @param mu, sigma mean and standard deviation of the logarithm
MarginalPtr lognormal_law(double mu, double sigma);
MarginalPtr exponential_law(double rate);
MarginalPtr weibull_law(double shape, double scale);
MarginalPtr gumbel_law(double location, double scale);

// Distributions by incomplete gamma and beta functions.
MarginalPtr gamma_law(double shape, double scale);
MarginalPtr beta_law(double a, double b, double low, double high);
MarginalPtr student_t_law(double degrees, double location, double scale);

// Discrete distributions.
MarginalPtr integers_law(double low, double high);
MarginalPtr poisson_law(double mean);
MarginalPtr binomial_law(double trials, double probability);
/// Each value has a probability proportional to its frequency in the list.
MarginalPtr empirical_law(std::vector<double> values);

/// Linear interpolation between the sorted values, which must be distinct: probability 1 / (n - 1)
/// between any two neighbours of n values.
MarginalPtr interpolated_law(std::vector<double> values);

}  // namespace stipple
