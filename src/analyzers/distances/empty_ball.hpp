// SPDX-License-Identifier: MIT
//
// The largest ball with its centre in a box, in which no point of a set is:
//
//     radius = max over x in the box of  min_i |x - x_i|.
//
// d = 1   half of the widest gap, or all of one at a wall.
// d = 2   the maximum is at a corner of a point's Voronoi cell (math/neighbors/planar_sites.hpp). A
//         cell is given up as soon as all its corners are nearer than the best corner so far.
// d >= 3  branch and bound over boxes. The points near a box give an upper bound of the balls that
//         have their centres in it, and a place where the bound is reached but for the square of
//         the box's size (math/neighbors/covering_bound.hpp). A box is done when its bound is at
//         most (1 + tolerance) times the largest distance found so far; others are halved.
//
// Cost    d = 2: O(n log n) for even sets; 10^6 points take 2.5 s on one core. d >= 3: grows with
//         the number of places that are nearly as empty as the emptiest, and exponentially with d.
//         That a Poisson-disk set is maximal takes 0.06 ms a point in 3-D to verify, 0.5 ms in 4-D,
//         2 ms in 5-D, 4 ms in 6-D.
// Promise the radius is the distance, in float64, of the centre to its nearest point. For d <= 2 it
//         is the maximum but for the rounding of the centre's coordinates. For d >= 3 the maximum
//         is in [radius, upper]. The same for any number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "analyzers/distances/distances.hpp"
#include "core/point_set.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

struct EmptyBall {
    double radius;
    double upper;  ///< no ball is larger
    std::vector<double> center;
};

/// When d >= 3 takes work to bound.
struct BallSearch {
    double tolerance = 1e-6;
    double enough = 0;  ///< while no ball is larger, nothing but that is made certain
    std::uint64_t max_boxes = 100'000'000;
};

/// Needs distances.box. @throws Error(limit, cancelled)
EmptyBall largest_empty_ball(const PointSet& points, const Distances& distances,
                             const BallSearch& search, const RunContext& run);

/// The same by branch and bound for any d, as for d >= 3.
EmptyBall bounded_empty_ball(const PointSet& points, const Distances& distances,
                             const BallSearch& search, const RunContext& run);

/// The same for d = 2.
EmptyBall planar_empty_ball(const PointSet& points, const Distances& distances,
                            const RunContext& run);

}  // namespace stipple::analyzers
