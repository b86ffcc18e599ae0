// SPDX-License-Identifier: MIT
//
// The worst box in one and two dimensions, by a sweep over the coordinates.
#pragma once

#include "analyzers/star_box.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::star {

/// O(n) after sorting.
WorstBox sweep_1d(const CornerGrid& grid, const RunContext& run);

/// O(n^(4/3)) time in practice, O(n) memory; see star_strips.hpp.
WorstBox sweep_2d(const CornerGrid& grid, const RunContext& run);

}  // namespace stipple::analyzers::star
