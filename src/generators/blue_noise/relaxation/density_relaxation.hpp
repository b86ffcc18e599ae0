// SPDX-License-Identifier: MIT
//
// Moves points of a torus to follow a density, by Gaussian kernels as wide as the local spacing of
// points. With lengths in units of (area / n)^(1/2), n points and a density rho of mean 1,
//
//     f(x) = sum_i K_i(x) - integral rho(y) K_y(x) dy,    K_y(x) = exp(-|x - y|^2 / sigma(y)^2),
//
// is 0 where points and density agree; sigma, near rho^(-1/2), is the local spacing of points. They
// move down the gradient of f, smoothed by their own kernel, as in gaussian_relaxation.hpp:
//
//     F_i = sum_j m_j 4 a b / (a + b)^2 (x_i - x_j) exp(-|x_i - x_j|^2 / (a + b)),
//     a = sigma_i^2,  b = sigma_j^2,
//
// over the points (m = 1) and over the leaves of a quadtree that represents the density
// (m = -mass): rectangles that hold at most half a point. sigma^2 is half the area of the square
// about x that holds two points: rho smoothed until it varies little over a kernel. Otherwise the
// force would not be the gradient of an energy, and points would drift. For a constant density this
// is the force of gaussian_relaxation.
//
// Shape   2-D; a density of any contrast; the same proportions of sides as in gaussian_relaxation.
// Cost    a step: about 10 times that of relax_gaussian, more if the contrast is high.
// Promise the same bits on every machine and for any number of threads; no point moves to a place
//         of density 0.
// Source  after A. G. M. Ahmed, J. Ren, P. Wonka, "Gaussian blue noise", ACM Trans. Graph. 41(6),
//         260 (2022), doi:10.1145/3550454.3555519, whose kernels adapt to a density, too. The
//         leaves and the force between kernels of different widths are ours.
#pragma once

#include <cstdint>
#include <span>

#include "media/density_map.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Bytes that relax_to_density needs besides the rows and the map.
double density_relaxation_bytes(std::uint64_t count, const DensityMap& map);

/// Moves points of [0, 1)^2, all at places of positive density, by `steps` steps. Distances are
/// those of a torus with sides proportional to `extents`, or of the unit torus if empty.
/// @throws Error(cancelled)
void relax_to_density(std::span<double> rows, const DensityMap& map, std::uint64_t steps,
                      const RunContext& run, std::span<const double> extents = {});

}  // namespace stipple
