// SPDX-License-Identifier: MIT
//
// Random points of a rectangle, with a radius that depends on the position, by dart throwing until
// no further point fits.
//
//     x and y may both be points if |x - y| >= min(r(x), r(y)),    r = scale * f
//     (varying/radius_field.hpp);    darts are thrown in proportion to 1 / r(x)^2.
//
// The process is that of generators/poisson_disk/maximal_disks.hpp: darts are thrown in rounds at
// gaps, rectangles that may be uncovered. Gaps are halves of halves of the rectangle, down to the
// cells of the field and beyond, where r is constant. A gap is certainly covered if some point y is
// nearer to its farthest corner than min(least r of the gap, r(y)). In each round gaps are halved
// until hardly more than one dart falls on each. Of the darts of a round, those too near to older
// points are rejected first; the others are tried in the order of their times, and kept if they
// satisfy the condition.
//
// Shape   d = 2; any rectangle, torus or bounded; any field.
// Cost    5 us (one radius) to 9 us (a picture) a point on one core; 250 bytes a point.
// Promise squared_distance (math/neighbors/spaced_points.hpp) of returned coordinates is at least
//         min(r(x), r(y))^2 for every pair. Every position x at which points are allowed has a
//         point y with |x - y| < min(r(x), r(y)), except in gaps that float64 can hardly resolve:
//         below 2^-46 of the largest coordinate. Points are in [low, high), none where the density
//         is 0. It runs on one thread.
// Source  R. L. Cook, ACM Trans. Graph. 5 (1986) 51-72, doi:10.1145/7529.8927 (the process).
#pragma once

#include <cstdint>
#include <span>

#include "generators/box_space.hpp"
#include "generators/poisson_disk/varying/radius_field.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple::poisson_disk {

/// Approximate number of points; valid if the field's cells are not much smaller than the radii.
double expected_varied(const RadiusField& field, double scale);

/// Makes the points, in an arbitrary but reproducible order.
/// @param dart_scale scale that darts are thrown for, at most `scale`; with the same dart_scale,
/// similar scales give similar sets
/// @throws Error(limit, cancelled)
Rows varied_disks(const BoxSpace& space, const RadiusField& field, double scale, double dart_scale,
                  std::uint64_t seed, const RunContext& run);

/// Reorders the points of varied_disks() so that the first m are well spread, for every m, like
/// spread_out() (generators/spread_order.hpp), but with radii in proportion to r.
Rows spread_varied(std::span<const double> rows, const BoxSpace& space, const RadiusField& field,
                   double scale, const RunContext& run);

}  // namespace stipple::poisson_disk
