// SPDX-License-Identifier: MIT
//
// Points of a rectangle thrown at random, with a radius that changes from place to place, until no
// further point fits: dart throwing, to its end.
//
//     x and y may both be there if |x - y| >= min(r(x), r(y)),    r = scale * f
//     (varying/radius_field.hpp);    darts are thrown in proportion to 1 / r(x)^2.
//
// The process is that of generators/poisson_disk/maximal_disks.hpp: darts are thrown in rounds
// at gaps, parts of the rectangle that may be uncovered. Gaps are halves of halves of the
// rectangle, down to the cells of the field and on, so that below these r is one number. A gap
// is covered for certain if one disk y has its farthest corner within min(least r of the gap,
// r(y)). With each round gaps are halved until hardly more than one dart falls on each. Of a
// round, darts that are too near to older points go first; the rest come in the order of their
// times, and stay if they keep the rule.
//
// Shape   d = 2; any rectangle, torus or bounded; any field.
// Cost    5 us (one radius) to 9 us (a picture) a point on one core; 250 bytes a point.
// Promise squared_distance (math/neighbors/spaced_points.hpp) of the numbers that come out is at
//         least min(r(x), r(y))^2 for every pair. Every place x where points may lie has a point
//         y with |x - y| < min(r(x), r(y)), but for gaps that float64 hardly tells from none:
//         below 2^-46 of the largest coordinate. Points are in [low, high), none where the
//         density is 0. One thread does it all.
// Source  R. L. Cook, ACM Trans. Graph. 5 (1986) 51-72, doi:10.1145/7529.8927 (the process).
#pragma once

#include <cstdint>
#include <span>

#include "generators/box_space.hpp"
#include "generators/poisson_disk/varying/radius_field.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple::poisson_disk {

/// About how many points there will be, where cells of the field are not much smaller than radii.
double expected_varied(const RadiusField& field, double scale);

/// The points, in no order that means anything, but always in the same.
/// @param dart_scale at most `scale`: with the same one, sets for scales that hardly differ hardly
/// differ themselves. @throws Error(limit, cancelled)
Rows varied_disks(const BoxSpace& space, const RadiusField& field, double scale, double dart_scale,
                  std::uint64_t seed, const RunContext& run);

/// Such points in an order in which the first m are well spread, for every m: as spread_out
/// (generators/spread_order.hpp), with radii that are in proportion to r.
Rows spread_varied(std::span<const double> rows, const BoxSpace& space, const RadiusField& field,
                   double scale, const RunContext& run);

}  // namespace stipple::poisson_disk
