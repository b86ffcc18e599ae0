// SPDX-License-Identifier: MIT
//
// A good lower bound quickly: coordinate ascent from random corners.
#pragma once

#include "analyzers/star_box.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::star {

/// The worst box that `starts` ascents on each side reach; every ascent takes the best place on one
/// axis with the others fixed, until none helps. Deterministic.
WorstBox ascend(const CornerGrid& grid, std::size_t starts, const RunContext& run);

}  // namespace stipple::analyzers::star
