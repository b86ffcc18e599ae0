// SPDX-License-Identifier: MIT
//
// Points of a torus that come to follow a density, by Gaussian kernels as wide as points are apart
// there. With lengths in units of (area / n)^(1/2), n points and a density rho of mean 1,
//
//     f(x) = sum_i K_i(x) - integral rho(y) K_y(x) dy,    K_y(x) = exp(-|x - y|^2 / sigma(y)^2),
//
// is 0 where points and density are alike; sigma, near rho^(-1/2), is the distance of points.
// Points move down the gradient of f, smoothed by their own kernel, as in
// gaussian_relaxation.hpp:
//
//     F_i = sum_j m_j 4 a b / (a + b)^2 (x_i - x_j) exp(-|x_i - x_j|^2 / (a + b)),
//     a = sigma_i^2,  b = sigma_j^2,
//
// over the points (m = 1) and over the leaves of a quadtree that stand for the density (m = -mass):
// squares that hold at most half a point. sigma^2 is half the area of the square about x that holds
// two points: rho smoothed so far that it varies little over a kernel, without which the force is
// none of an energy, and points drift. For the constant density this is the force of
// gaussian_relaxation.
//
// Shape   2-D; a density of any contrast; sides of proportions as those of gaussian_relaxation.
// Cost    a step: some 10 times that of relax_gaussian, more where the contrast is high.
// Promise the same bits on every machine and for any number of threads; no point comes to lie where
//         the density is 0.
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

/// Moves rows of [0, 1)^2, which lie where the density is not 0, `steps` times. Distances are those
/// of a torus with sides in proportion to `extents`, of the unit torus without any.
/// @throws Error(cancelled)
void relax_to_density(std::span<double> rows, const DensityMap& map, std::uint64_t steps,
                      const RunContext& run, std::span<const double> extents = {});

}  // namespace stipple
