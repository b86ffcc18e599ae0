// SPDX-License-Identifier: MIT
//
// Weighted sample elimination: of M points, always the one with the greatest weight goes, until N
// are left.
//
//     w_i = sum over j != i of  (1 - max(d_ij, 2 r_min) / (2 r_max))^8    where d_ij < 2 r_max,
//     r_min = 0.65 r_max (1 - (N / M)^1.5).
//
// Where points are to be nearer to each other here than there, each has an r_max of its own: of a
// pair, r_i + r_j stand for 2 r_max, and r_min is the same share of both.
//
// Each term is rounded down to a multiple of 2^-40, so that sums are exact, in whatever order they
// are taken, and stay so when terms are taken off them. Of equal weights the point of lowest index
// goes.
//
// A point's weight only falls. The heap keeps weights that it once had; a point on top whose weight
// has fallen since is put back, and one whose weight has not is the heaviest of all.
//
// Shape   D directions; M < 2^32; r_max > 0.
// Cost    O(M k) time, k points within 2 r_max; 8 D + 40 bytes a point, with radii of their own 40
//         more. Points lie in layers of like radii, each in a grid of its own.
// Source  C. Yuksel, Comput. Graph. Forum 34 (2015) 25-32, doi:10.1111/cgf.12538.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "generators/box_space.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Half the distance of neighbours in the densest packing of `count` points on so many dimensions
/// with that measure; for four dimensions and more a bound that none reaches.
double packing_radius(double count, std::size_t dimension, double measure);

/// The numbers of the points in the order in which they go: the first `count` - `kept` that do.
/// @param rows points of the space, one after the other.
/// @param shares of r_max that are each point's own; none: 1 for all. Above 0.
std::vector<std::uint32_t> eliminate(std::span<const double> rows, const BoxSpace& space,
                                     double r_max, std::uint64_t kept, const RunContext& run,
                                     std::span<const double> shares = {});

/// Bytes that it takes.
double elimination_memory(double points, std::size_t dimension, bool with_shares = false);

// What points fill, told by themselves: the dimension of the curve, surface or body that they are
// on, and its measure.
//
// The balls about some of the points that hold k of n points have, on d dimensions of measure A,
// the volume V_d r_k^d = A k / n, nearly, however evenly the points lie; and the mean square of
// distances in them, which is smoother than r_k^2, grows 4^(2/d) times from k points to 4k. The
// median growth says d. Balls that reach beyond a rim are too large; the smaller ones say A, within
// some 10 % in the plane, and in space within 25 % (of 200 points) or 5 % (of 5000).
//
// What counts is how points lie at the distances that those have which are to be kept: a coil of
// wire is a curve to many points, and a surface to few. So k is about 1.5 n / kept, half of the
// points that are nearer than 2 r_max, within [6, n / 12].
//
// Cost    O(65536) distances for each of 256 points.
// Promise the same on every machine: no more than roots and products.

struct CrowdExtent {
    std::size_t dimension = 0;  ///< 0: the points are fewer than 24, or too many in one place
    double measure = 0;
};

/// @param rows points in so many directions, up to 6
/// @param dimension that they have, or 0 to look for it
/// @param kept number of points whose distances count; 0: a sixteenth of them
CrowdExtent crowd_extent(std::span<const double> rows, std::size_t directions,
                         std::size_t dimension, const RunContext& run, std::uint64_t kept = 0);

}  // namespace stipple
