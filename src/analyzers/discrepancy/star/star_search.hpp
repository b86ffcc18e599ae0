// SPDX-License-Identifier: MIT
//
// The worst box in any dimension, by branch and bound; stopped early, bounds that are certain.
#pragma once

#include "analyzers/discrepancy/search_limits.hpp"
#include "analyzers/discrepancy/star/star_ascent.hpp"
#include "analyzers/discrepancy/star/star_box.hpp"
#include "core/peers.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::star {

using analyzers::Ending;
using analyzers::SearchLimits;

struct SearchResult {
    WorstBox worst;
    double upper;   ///< the star discrepancy is at most this
    Ending ending;  ///< if `complete`, the worst box is the worst of all
};

/// Looks for boxes worse than `worst`; the worse that is, the less is left to look at. Once a stop
/// is requested, it ends with what is certain. The result does not depend on the number of threads,
/// nor of peers, unless a deadline or a stop ends it; all peers get the same.
SearchResult search(const CornerGrid& grid, WorstBox worst, const SearchLimits& limits,
                    const RunContext& run, Peers* peers = nullptr);

/// The same from nothing, or from a hint: climbs first, which are a part of the work.
SearchResult find_worst(const CornerGrid& grid, const SearchLimits& limits, const RunContext& run,
                        const Hint* hint = nullptr, Peers* peers = nullptr);

/// What is certain without a search: that box or a worse one, and a bound that takes milliseconds.
SearchResult certain_at_once(const CornerGrid& grid, WorstBox worst, Ending ending,
                             const RunContext& run);

/// Bytes that the search takes, with these points, beside the grid.
double search_bytes(std::size_t count, std::size_t dimension, unsigned threads);

}  // namespace stipple::analyzers::star
