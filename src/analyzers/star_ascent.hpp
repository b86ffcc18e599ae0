// SPDX-License-Identifier: MIT
//
// A good lower bound quickly: coordinate ascent from random corners.
#pragma once

#include "analyzers/star_box.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::star {

/// The worst box that ascents from up to 200 corners on each side reach, fewer for large sets;
/// every ascent takes the best place on one axis with the others fixed, until none helps.
/// Deterministic.
WorstBox ascend(const CornerGrid& grid, const RunContext& run);

}  // namespace stipple::analyzers::star
