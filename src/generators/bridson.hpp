// SPDX-License-Identifier: MIT
//
// Points of a box, no two nearer than a radius r, as many as Bridson's method finds places for.
//
// From a point picked at random among the active ones, up to k candidates are thrown into the shell
// [r, 2r] around it, uniformly by volume; one that keeps the distance from all points becomes a
// point, and active. A point around which k in a row fail is active no more.
//
// Shape   d = 2, 3; any box; r up to its diagonal.
// Cost    O(n k) time; about 50 bytes a point.
// Promise squared_distance (math/spaced_points.hpp) of the numbers that come out is at least r^2
//         for every pair. Points are in [low, high).
// Beware  not quite maximal: some 0.1 % of the space is left for more points.
// Source  R. Bridson, SIGGRAPH 2007 sketches, doi:10.1145/1278780.1278807.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/domain.hpp"
#include "core/rng.hpp"
#include "core/run_context.hpp"

namespace stipple {

struct DiskSpace {
    Box box;
    bool torus = true;  ///< distances go across opposite faces
    std::int64_t attempts = 30;
};

/// About how many points there will be; a little more rather than less.
double expected_disks(const DiskSpace& space, double radius);

/// The points, one after the other. Reports its progress to run.
/// @throws Error(limit, cancelled)
std::vector<double> bridson(const DiskSpace& space, double radius, const Rng& rng,
                            const RunContext& run);

}  // namespace stipple
