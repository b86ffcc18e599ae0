// SPDX-License-Identifier: MIT
//
// The worst box in one and two dimensions, by a sweep over the coordinates.
#pragma once

#include "analyzers/discrepancy/search_limits.hpp"
#include "analyzers/discrepancy/star/star_box.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::star {

/// O(n) after sorting.
WorstBox sweep_1d(const CornerGrid& grid, const RunContext& run);

struct Sweep {
    WorstBox worst;
    bool complete;  ///< nothing is worse
};

/// O(n^(4/3)) time in practice, O(n) memory; see star_strips.hpp. Ends early at the deadline, or
/// when a stop is requested, with what it has.
Sweep sweep_2d(const CornerGrid& grid, const SearchLimits& limits, const RunContext& run);

}  // namespace stipple::analyzers::star
