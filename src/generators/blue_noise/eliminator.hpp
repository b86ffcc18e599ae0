// SPDX-License-Identifier: MIT
//
// Weighted sample elimination: of M points, the one with the greatest weight is removed, again and
// again, until N are left.
//
//     w_i = sum over j != i of  (1 - max(d_ij, 2 r_min) / (2 r_max))^8    where d_ij < 2 r_max,
//     r_min = 0.65 r_max (1 - (N / M)^1.5).
//
// If the spacing varies, each point i has an r_max of its own, r_i: for a pair, r_i + r_j replaces
// 2 r_max, and r_min / r_max stays the same.
//
// Each term is rounded down to a multiple of 2^-40, so that sums are exact in any order, and remain
// exact when terms are subtracted. Among equal weights, the point of lowest index is removed.
//
// Weights only decrease, so entries of the heap may be outdated. A point on top is put back if its
// weight has decreased; otherwise it is the heaviest of all.
//
// Shape   D dimensions; M < 2^32; r_max > 0.
// Cost    O(M k) time for k points within 2 r_max; 8 D + 40 bytes a point, 40 more if radii vary.
//         Points are sorted into layers of similar radii, each with a grid of its own.
// Source  C. Yuksel, Comput. Graph. Forum 34 (2015) 25-32, doi:10.1111/cgf.12538.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "generators/box_space.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Half the distance of neighbours in the densest packing of `count` points in a space of that
/// dimension and measure; from four dimensions on, an upper bound that no packing reaches.
double packing_radius(double count, std::size_t dimension, double measure);

/// Indices of the removed points in the order of removal; `kept` points remain.
/// @param rows points of the space, one after the other
/// @param shares radius of each point as a multiple of r_max, above 0; empty: 1 for all
std::vector<std::uint32_t> eliminate(std::span<const double> rows, const BoxSpace& space,
                                     double r_max, std::uint64_t kept, const RunContext& run,
                                     std::span<const double> shares = {});

/// Bytes that eliminate() needs.
double elimination_memory(double points, std::size_t dimension, bool with_shares = false);

// Extent of points, estimated from the points: the dimension of the curve, surface or body that
// they fill, and its measure.
//
// Take a ball around one of n points that holds k of them. In d dimensions of measure A its volume
// is nearly V_d r_k^d = A k / n, however evenly the points are spread. The mean squared distance in
// the ball is smoother than r_k^2 and grows by the factor 4^(2/d) from k points to 4k, so the
// median growth gives d. Balls that cross the points' boundary are too large, so the smaller ones
// give A: within about 10 % in the plane, and in space within 25 % (200 points) or 5 % (5000).
//
// The estimate has to hold at the distances between the kept points: many kept points reveal that a
// coil of wire is a curve, few make it look like a surface. So k is about 1.5 n / kept, half of the
// points within 2 r_max, limited to [6, n / 12].
//
// Cost    up to 65536 distances for each of 256 points.
// Promise the same on every machine: roots and products only.

struct CrowdExtent {
    std::size_t dimension = 0;  ///< 0: there are fewer than 24 points, or too many coincide
    double measure = 0;
};

/// @param rows points with `directions` coordinates, up to 6
/// @param dimension dimension that the points fill; 0: estimate it
/// @param kept number of points whose distances matter; 0: a sixteenth of all
CrowdExtent crowd_extent(std::span<const double> rows, std::size_t directions,
                         std::size_t dimension, const RunContext& run, std::uint64_t kept = 0);

}  // namespace stipple
