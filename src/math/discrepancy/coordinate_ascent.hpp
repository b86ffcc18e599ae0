// SPDX-License-Identifier: MIT
//
// Fast lower bounds by coordinate ascent from random boxes, and from boxes near previous results.
#pragma once

#include <cstdint>

#include "math/discrepancy/box_grid.hpp"
#include "math/discrepancy/search_limits.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy {

struct Ascent {
    WorstBox worst;
    std::uint64_t work;  ///< number of comparisons of coordinates
};

/// Worst box reached by ascents from up to 200 open and 200 closed boxes, fewer for large sets: a
/// cheap lower bound, and often the worst box of all. Each ascent replaces the interval on one axis
/// by the worst one, with the other axes fixed, until no axis gains. The search for the largest
/// empty box uses only open boxes. At least one ascent makes at least one step. Deterministic,
/// unless time or a stop ends the search with the results so far.
Ascent ascend(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run);

/// One round of an endless search for bad anchored boxes by threshold accepting. Each ascent starts
/// from the previous box, perturbed on some axes. The new box replaces the previous one unless its
/// excess is smaller by more than a threshold, which decreases. Offers all boxes reached.
/// Deterministic, unless time ends it.
/// @param round index of the round, from 0; selects the random numbers
/// @returns the number of comparisons of coordinates.
///
/// Source  M. Gnewuch, M. Wahlstroem, C. Winzen, SIAM J. Numer. Anal. 50 (2012) 781-807 (threshold
///         accepting for star discrepancies, there without ascents).
std::uint64_t accept_thresholds(const BoxGrid& grid, std::uint64_t round, WorstBox& worst,
                                const SearchLimits& limits, const RunContext& run);

}  // namespace stipple::discrepancy
