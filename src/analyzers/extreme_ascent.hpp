// SPDX-License-Identifier: MIT
//
// A bad box found fast: from some boxes, one axis after the other takes the worst interval there
// is with the box's other sides, until none gets worse.
#pragma once

#include "analyzers/extreme_box.hpp"

namespace stipple::analyzers::extreme {

/// The worst box that the climbs find; a lower bound, often the worst of all. Open boxes alone for
/// the largest empty box. Depends on the grid only.
WorstBox ascend(const BoxGrid& grid, const RunContext& run);

}  // namespace stipple::analyzers::extreme
