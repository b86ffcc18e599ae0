// SPDX-License-Identifier: MIT
//
// The worst box in any dimension, by branch and bound; stopped early, bounds that are certain.
#pragma once

#include <limits>

#include "analyzers/star_box.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::star {

/// When to stop before the worst box is found.
struct SearchLimits {
    std::uint64_t work = std::numeric_limits<std::uint64_t>::max();  ///< comparisons of coordinates
    double deadline = std::numeric_limits<double>::infinity();       ///< in the run's seconds
    double tolerance = 0;  ///< enough if upper - lower <= tolerance * lower
};

enum class Ending { complete, tolerance, work, time, stopped };

struct SearchResult {
    WorstBox worst;
    double upper;   ///< the star discrepancy is at most this
    Ending ending;  ///< if `complete`, the worst box is the worst of all
};

/// Looks for boxes worse than `worst`; the worse that is, the less is left to look at. Once a stop
/// is requested, it ends with what is certain. The result does not depend on the number of threads
/// unless a deadline or a stop ends it.
SearchResult search(const CornerGrid& grid, WorstBox worst, const SearchLimits& limits,
                    const RunContext& run);

/// Bytes that the search takes, with these points, beside the grid.
double search_bytes(std::size_t count, std::size_t dimension, unsigned threads);

}  // namespace stipple::analyzers::star
