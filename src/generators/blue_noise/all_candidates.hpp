// SPDX-License-Identifier: MIT
//
// Mitchell's method as it is written down (best_candidate.cpp): of max(1, c i) places
// uniform in the box, all of which are made, the one farthest from the i points before it.
//
// A place loses as soon as a point is met that is as near as one of the best so far.
//
// Cost    one core does 10^4 points in 5-D with c = 1 in 20 s; c n^3.
// Promise point i does not depend on the number of points.
#pragma once

#include <cstdint>
#include <vector>

#include "generators/box_space.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// The first points, one after the other. @param factor c; positive
/// @throws Error(limit, cancelled)
std::vector<double> all_candidates(const BoxSpace& space, std::uint64_t seed, double factor,
                                   std::uint64_t wanted, const RunContext& run);

}  // namespace stipple
