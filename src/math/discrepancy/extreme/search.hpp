// SPDX-License-Identifier: MIT
//
// The worst of all axis-parallel boxes, by branch and bound.
#pragma once

#include "math/discrepancy/branch_and_bound.hpp"

namespace stipple::discrepancy::extreme {

/// Bytes that a search with so many threads takes, the grid included.
double search_memory(const PointSet& points, unsigned threads);

/// Searches on from a box found before; no value is above `upper`.
SearchResult search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                    const RunContext& run, double upper = 1);

/// The same from nothing: coordinate ascents first, which are a part of the work.
SearchResult find_worst(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run,
                        double upper = 1);

/// The same after a bound from the star discrepancy of the points, which is a small part of the work.
SearchResult find_worst(const PointSet& points, const BoxGrid& grid, const SearchLimits& limits,
                        const RunContext& run);

/// One of milliseconds, or some more of many points. Goes on when a stop is requested.
double quick_bound(const PointSet& points, Family family, const RunContext& run);

}  // namespace stipple::discrepancy::extreme
