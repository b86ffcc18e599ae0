// SPDX-License-Identifier: MIT
//
// The worst box in one and two dimensions, by a sweep over the coordinates.
#pragma once

#include "analyzers/discrepancy/box_grid.hpp"
#include "analyzers/discrepancy/search_limits.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy::star {

/// O(n) after sorting.
SearchResult sweep_1d(const BoxGrid& grid, const RunContext& run);

/// O(n^(4/3)) time in practice, O(n) memory; see strips.hpp. Ends early at the deadline, or when a
/// stop is requested, with what it has.
SearchResult sweep_2d(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run);

}  // namespace stipple::discrepancy::star
