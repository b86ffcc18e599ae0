// SPDX-License-Identifier: MIT
//
// The worst of all axis-parallel boxes, by branch and bound.
#pragma once

#include "math/discrepancy/branch_and_bound.hpp"

namespace stipple::discrepancy::extreme {

/// Bytes that a search with `threads` threads needs, including the grid.
double search_memory(const PointSet& points, unsigned threads);

/// Searches for boxes worse than `worst`; `upper` is an upper bound on the values of all boxes.
SearchResult search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                    const RunContext& run, double upper = 1);

/// Searches without a known box. Begins with coordinate ascents, which count against limits.work.
SearchResult find_worst(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run,
                        double upper = 1);

/// Searches after finding an upper bound by the star discrepancy in up to a tenth of the limits.
SearchResult find_worst(const PointSet& points, const BoxGrid& grid, const SearchLimits& limits,
                        const RunContext& run);

/// Upper bound on the discrepancy, found in milliseconds (longer for many points). Ignores stops.
double quick_bound(const PointSet& points, Family family, const RunContext& run);

}  // namespace stipple::discrepancy::extreme
