// SPDX-License-Identifier: MIT
//
// The worst box in any dimension, by branch and bound.
#pragma once

#include "analyzers/star_box.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::star {

struct SearchResult {
    WorstBox worst;
    double upper;   ///< the star discrepancy is at most this
    bool complete;  ///< the worst box is the worst of all
};

/// Looks for a box worse than `worst`; the worse that is, the less is left to look at. Stops,
/// incomplete, after about `max_work` comparisons of coordinates. The result does not depend on the
/// number of threads.
SearchResult search(const CornerGrid& grid, WorstBox worst, std::uint64_t max_work,
                    const RunContext& run);

}  // namespace stipple::analyzers::star
