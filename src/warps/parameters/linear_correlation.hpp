// SPDX-License-Identifier: MIT
//
// The linear correlation of parameters that a Gaussian copula joins. With X_a = F_a^-1(Phi(Z_a)), Z
// standard normal with correlation rho, and normalised Hermite polynomials h_k,
//
//     E X_a X_b = sum over k of a_k b_k rho^k,    a_k = E X_a h_k(Z).
//
// Cost    some thousand quantiles of each.
// Promise within 1e-3 for distributions with steps, 1e-6 for smooth ones whose tails are not heavy.
// Source  M. C. Cario, B. L. Nelson, "Modeling and generating random vectors with arbitrary marginal
//         distributions and correlation matrix", Northwestern University, 1997 (NORTA).
#pragma once

#include "math/distributions/marginal.hpp"

namespace stipple::parameters {

/// The rho with which the parameters have the correlation r.
/// @throws Error(usage) where no rho has, naming what is possible, or where there are no moments
double correlation_of_scores(const Marginal& a, const Marginal& b, double r);

}  // namespace stipple::parameters
