// SPDX-License-Identifier: MIT
//
// A set of a page, measured and drawn.
#pragma once

#include <cstddef>

#include "page/page_content.hpp"
#include "page/page_measures.hpp"

namespace stipple {

/// The set with all measures and, for a page, its pictures; its grids are in these, and left out.
/// @param number of the set on the page, from 0: its colour
/// @throws Error(cancelled), Error(io)
PageSet finished_set(PageSet set, const PointSet& points, const PageInput& input,
                     const PageLimits& limits, std::size_t number, bool with_pictures,
                     const RunContext& run);

}  // namespace stipple
