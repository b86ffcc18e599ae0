// SPDX-License-Identifier: MIT
//
// Kernels K(x, y) = prod k(|x_j - y_j|) with their means over a domain of independent coordinates
// Y_j, computed from the distribution functions F_j:
//
//     E k(|x - Y|)  =  integral over t > 0 of -k'(t) (F(x + t) - F(x - t)) dt
//     E E k         =  integral over u of E k(|q(u) - Y|) du,    F(q(u)) = u.
//
// Cost    about 300 values of F for the mean in one coordinate, about 10^5 for its total.
// Promise means have an error of about 1e-11, which rounding() includes.
#pragma once

#include <optional>
#include <span>

#include "core/domain.hpp"
#include "math/kernels/kernel.hpp"
#include "stipple/run.hpp"

namespace stipple::kernels {

/// True if the domain's coordinates are independent, and each cube coordinate is the distribution
/// function of one of them. Tested at the given points, moved along single coordinates.
bool has_independent_axes(const Domain& domain, std::span<const double> points);

/// Kernels for arbitrary points whose target is a domain with independent axes.
/// @param order nullopt for the Gaussian kernel, otherwise the order of Matern's (kernel.hpp)
KernelPtr of_domain(DomainPtr domain, double bandwidth, std::optional<unsigned> order,
                    const RunContext& run);

}  // namespace stipple::kernels
