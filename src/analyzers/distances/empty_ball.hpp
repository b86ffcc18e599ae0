// SPDX-License-Identifier: MIT
//
// The largest ball that contains no point of a set, with its centre in a box:
//
//     radius = max over x in the box of  min_i |x - x_i|.
//
// d = 1   half of the widest gap between points, or the whole gap at a wall.
// d = 2   the maximum is at a corner of a point's Voronoi cell (math/neighbors/planar_sites.hpp).
//         Cutting a cell ends once its corners are nearer to its point than the best radius so far.
// d >= 3  branch and bound over boxes. The points near a box give an upper bound of the radius of
//         balls centred in it, and a centre whose ball attains this bound up to the square of the
//         box's size (math/neighbors/covering_bound.hpp). A box is done if its bound is at most
//         (1 + tolerance) times the largest distance found so far; others are halved.
//
// Cost    d = 2: O(n log n) for even sets; 10^6 points take 2.5 s on one core. d >= 3: grows with
//         the number of empty balls nearly as large as the largest, and exponentially with d.
//         Verifying that a Poisson-disk set is maximal takes 0.06 ms per point in 3-D, 0.5 ms in
//         4-D, 2 ms in 5-D, 4 ms in 6-D.
// Promise the radius is the distance, in float64, of the centre to its nearest point (in a box far
//         from 0, of the centre before its coordinates are rounded). For d <= 2 it is the
//         maximum up to the rounding of the centre's coordinates. For d >= 3 the maximum is in
//         [radius, upper]. The same for any number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "analyzers/distances/distances.hpp"
#include "core/point_set.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

struct EmptyBall {
    double radius;
    double upper;  ///< no empty ball has a larger radius
    std::vector<double> center;
};

/// Limits of the branch and bound for d >= 3.
struct BallSearch {
    double tolerance = 1e-6;
    double enough = 0;  ///< radius; boxes without larger balls are not divided
    std::uint64_t max_boxes = 100'000'000;
};

/// Largest empty ball for any d; requires distances.box. @throws Error(limit, cancelled)
EmptyBall largest_empty_ball(const PointSet& points, const Distances& distances,
                             const BallSearch& search, const RunContext& run);

/// Uses branch and bound for any d.
EmptyBall bounded_empty_ball(const PointSet& points, const Distances& distances,
                             const BallSearch& search, const RunContext& run);

EmptyBall planar_empty_ball(const PointSet& points, const Distances& distances,
                            const RunContext& run);

}  // namespace stipple::analyzers
