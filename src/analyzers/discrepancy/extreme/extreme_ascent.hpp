// SPDX-License-Identifier: MIT
//
// A bad box found fast: from some boxes, one axis after the other takes the worst interval there
// is with the box's other sides, until none gets worse.
#pragma once

#include "analyzers/discrepancy/extreme/extreme_box.hpp"
#include "analyzers/discrepancy/search_limits.hpp"

namespace stipple::analyzers::extreme {

struct Ascent {
    WorstBox worst;
    std::uint64_t work;  ///< comparisons of coordinates
};

/// The worst box that the climbs find; a lower bound, often the worst of all. Open boxes alone for
/// the largest empty box. Depends on the grid and the limit of work only, unless the time or a stop
/// ends it: then with what it has.
Ascent ascend(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run);

}  // namespace stipple::analyzers::extreme
