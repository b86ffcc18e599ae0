// SPDX-License-Identifier: MIT
//
// The largest ball with its centre in a box, in which no point of a set is:
//
//     radius = max over x in the box of  min_i |x - x_i|.
//
// d = 1   half of the widest gap, or all of one at a wall.
// d = 2   the maximum is at a corner of a point's cell: of the part of the box (of the plane, on
// the
//         torus) that is nearer to it than to any other. Cells are cut out of the box by the
//         bisectors to those points of a k-d tree that can still reach a corner; a cell is given up
//         as soon as all its corners are nearer than the best corner so far.
// d >= 3  branch and bound over boxes. For a box with centre c and half sides h, points p_i, and
// any
//         weights w_i >= 0 with sum 1 and mean m = sum_i w_i p_i,
//
//             min_i |x - p_i|^2 <= sum_i w_i |x - p_i|^2
//                               <= sum_i w_i |c - p_i|^2 + 2 sum_k h_k |c_k - m_k| + |h|^2
//
//         in the box. The best weights for the points near c are a linear program, solved by the
//         simplex method; its multipliers are a place in the box where the bound is reached but for
//         |h|^2, which in the end is the largest ball's centre. So bounds close with the square of
//         a box's size. A box is done when its bound is at most (1 + tolerance) times the largest
//         distance found so far; others are halved.
//
// Cost    d = 2: O(n log n) for even sets; 10^6 points take 2.5 s on one core. d >= 3: grows with
// the
//         number of places that are nearly as empty as the emptiest, and exponentially with d. That
//         a Poisson-disk set is maximal takes 0.06 ms a point in 3-D to verify, 0.5 ms in 4-D, 2 ms
//         in 5-D, 4 ms in 6-D.
// Promise the radius is the distance, in float64, of the centre to its nearest point. For d <= 2 it
//         is the maximum but for the rounding of the centre's coordinates. For d >= 3 the maximum
//         is in [radius, upper]. The same for any number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "analyzers/distances/distances.hpp"
#include "core/point_set.hpp"
#include "core/run_context.hpp"

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
