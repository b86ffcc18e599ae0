// SPDX-License-Identifier: MIT
//
// How the number of points in a ball scatters over places of the ball that are drawn at random, the
// same for any run, so that all of it is inside the box.
//
// Shape    points of a box, d = 1, 2, 3; rising radii, the largest below half the shortest side.
// Cost     O(n + windows * points in the largest).
// Promise  a point is in a window if its distance^2, as float64 computes it, is at most R^2. The
//          same for any number of threads.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "core/point_set.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

/// Over all windows of each radius.
struct WindowCounts {
    std::vector<double> mean;
    std::vector<double> variance;  ///< unbiased, were the windows apart
};

/// @throws Error(limit, cancelled)
WindowCounts count_in_windows(const PointSet& points, const Box& box, std::span<const double> radii,
                              std::size_t windows, const RunContext& run);

}  // namespace stipple::analyzers
