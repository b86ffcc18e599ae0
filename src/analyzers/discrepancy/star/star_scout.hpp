// SPDX-License-Identifier: MIT
//
// A good box of a large planar set in a few passes over its points.
#pragma once

#include "analyzers/discrepancy/star/star_box.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::star {

/// The worse of two boxes, one for each side: from the worst corner of a coarse grid, one
/// coordinate after the other goes to its best place. O(n).
WorstBox scout(const CornerGrid& grid, const RunContext& run);

}  // namespace stipple::analyzers::star
