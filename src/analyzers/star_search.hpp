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

/// Stops, incomplete, after about `max_work` tests of a point against a side of a cell. The result
/// does not depend on the number of threads.
SearchResult search(const CornerGrid& grid, std::uint64_t max_work, const RunContext& run);

}  // namespace stipple::analyzers::star
