// SPDX-License-Identifier: MIT
//
// Good lower bounds quickly: coordinate ascent from random boxes, and from boxes near those where
// it ended.
#pragma once

#include <cstdint>

#include "math/discrepancy/box_grid.hpp"
#include "math/discrepancy/search_limits.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy {

struct Ascent {
    WorstBox worst;
    std::uint64_t work;  ///< comparisons of coordinates
};

/// The worst box that ascents from up to 200 boxes on each side reach, fewer for large sets; a
/// lower bound for little work, often the worst of all. Each takes the worst interval on one axis
/// with the others fixed, until none is worse. Open boxes alone for the largest empty box. One step
/// there is at least. Deterministic, unless the time or a stop ends it: then with what it has.
Ascent ascend(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run);

/// A round of a search without end for bad anchored boxes, by threshold accepting: ascents start
/// where others ended, perturbed on some axes; a worse end is taken for one that is better by less
/// than a threshold, which falls. Offers what they find. Deterministic, unless the time ends it.
/// @param round its number from 0; each takes other ways
/// @returns the comparisons of coordinates that it took.
///
/// Source  M. Gnewuch, M. Wahlstroem, C. Winzen, SIAM J. Numer. Anal. 50 (2012) 781-807 (threshold
///         accepting for star discrepancies, there without ascents).
std::uint64_t accept_thresholds(const BoxGrid& grid, std::uint64_t round, WorstBox& worst,
                                const SearchLimits& limits, const RunContext& run);

}  // namespace stipple::discrepancy
