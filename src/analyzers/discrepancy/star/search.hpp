// SPDX-License-Identifier: MIT
//
// The worst anchored box in any dimension, by branch and bound; stopped early, bounds that are
// certain.
#pragma once

#include "analyzers/discrepancy/branch_and_bound.hpp"

namespace stipple::discrepancy::star {

/// Looks for boxes worse than `worst`; the worse that is, the less is left to look at.
SearchResult search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                    const RunContext& run, Peers* peers = nullptr);

/// The same from nothing: coordinate ascents first, which are a part of the work.
SearchResult find_worst(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run,
                        Peers* peers = nullptr);

/// No box has a larger discrepancy; found in milliseconds, or some more of many points. Also for
/// boxes whose discrepancy is at most `of_axis` times that of anchored ones on each axis, and
/// `of_all` times on all together. Goes on when a stop is requested.
double quick_bound(const BoxGrid& grid, const RunContext& run, double of_axis = 1,
                   double of_all = 1);

/// Bytes that the search takes, with these points, beside the grid.
double search_bytes(std::size_t count, std::size_t dimension, unsigned threads);

}  // namespace stipple::discrepancy::star
