// SPDX-License-Identifier: MIT
//
// Kernels K(x, y) = prod k(|x_j - y_j|) with their means over a domain of independent coordinates Y_j,
// from the distribution functions F_j alone:
//
//     E k(|x - Y|)  =  integral over t > 0 of -k'(t) (F(x + t) - F(x - t)) dt
//     E E k         =  integral over u of E k(|q(u) - Y|) du,    F(q(u)) = u.
//
// Cost    some 300 values of F for a mean of one coordinate, some 10^5 for its total.
// Promise means within some 1e-11 of right, as rounding() says.
#pragma once

#include <optional>
#include <span>

#include "core/domain.hpp"
#include "math/kernels/kernel.hpp"
#include "stipple/run.hpp"

namespace stipple::kernels {

/// Whether the coordinates of the domain are independent, and each of its cube's coordinates is the
/// distribution function of one of them; found at points, and at places of its bounding box.
/// @param points rows inside the domain
bool has_independent_axes(const Domain& domain, std::span<const double> points);

/// The kernels, of points anywhere, whose target is the domain, with independent axes.
/// @param order nothing for the Gaussian kernel, else of Matern's (kernel.hpp)
KernelPtr of_domain(DomainPtr domain, double bandwidth, std::optional<unsigned> order,
                    const RunContext& run);

}  // namespace stipple::kernels
