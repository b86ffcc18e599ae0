// SPDX-License-Identifier: MIT
//
// The worst of all axis-parallel boxes, by branch and bound.
#pragma once

#include "analyzers/discrepancy/extreme/extreme_box.hpp"
#include "analyzers/discrepancy/search_limits.hpp"

namespace stipple::analyzers::extreme {

struct SearchResult {
    WorstBox worst;
    double upper;   ///< no box is worth more, over the scale
    Ending ending;  ///< if `complete`, nothing is worse than the worst box
};

/// Searches on from a box found before. Looks at open boxes alone for the largest empty box. Once a
/// stop is requested, it ends with what is certain. Does not depend on the number of threads unless
/// a deadline or a stop ends it.
SearchResult search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                    const RunContext& run);

/// The same from nothing: climbs first, which are a part of the work. No box is worth more than
/// `upper`, over the scale.
SearchResult find_worst(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run,
                        double upper = 1);

}  // namespace stipple::analyzers::extreme
