// SPDX-License-Identifier: MIT
//
// A search over coordinates for points of least objective, by descents along its gradient.
//
// Starts    sets that are given, or the best of some that are made; each is descended from, and the
//           best are kept: the more, the more values the budget has.
// Hops      half of the points of each are moved; a descent follows, and takes the new set's place
//           unless that is worse; fewer and fewer are kept.
// Descents  steps that adapt to each coordinate's gradient (Adam), shorter and shorter, while the
//           soft maximum comes nearer to the maximum.
//
// Promise   a function of what is given, for any number of threads.
// Source    D. P. Kingma, J. Ba, arXiv:1412.6980 (Adam).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "generators/optimized/objective.hpp"
#include "generators/optimized/search_run.hpp"
#include "math/combinatorics/splitmix64.hpp"
#include "stipple/run.hpp"

namespace stipple::optimized {

/// How a descent goes, from its first step to its last.
struct Schedule {
    std::size_t steps;
    double first_rate;  ///< of a coordinate in one step, at most
    double last_rate;
    double first_sharpness;
    double last_sharpness;
};

struct CoordinateSearch {
    std::size_t count;
    std::size_t dimension;
    std::size_t kept;  ///< the first so many points stay where they are
    std::function<std::unique_ptr<Objective>()> objective;
    /// Rows of the i-th set that a start is chosen from.
    std::function<std::vector<double>(std::uint64_t i, SplitMix64& draws)> start;
    Schedule from_start;
    Schedule from_hop;
    double hop;  ///< that a coordinate is disturbed by, at most
    std::uint64_t seed;
    double budget;           ///< in steps of the objective
    bool one_start = false;  ///< all starts are the same
    std::size_t sets_a_start = 16;
};

/// Reports progress with the least value so far, as reports have it, behind `words`.
/// @throws Error(cancelled)
OptimizedRows search_coordinates(const CoordinateSearch& search, const std::string& words,
                                 const RunContext& run);

}  // namespace stipple::optimized
