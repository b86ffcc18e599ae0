// SPDX-License-Identifier: MIT
//
// Upper bounds of the extreme and the periodic discrepancy from the star discrepancy D*: a box is
// the sum and difference of up to 2^d anchored ones, and on the torus of 3^d - 1 (an interval is
// one from 0 less another; if it wraps, the whole axis is added, and the whole space has no
// discrepancy).
#pragma once

#include "analyzers/discrepancy/box_grid.hpp"
#include "analyzers/discrepancy/search_limits.hpp"

namespace stipple::discrepancy::extreme {

/// That of D*, or of bounds of it, for a small part of the work and time that a search may take.
double star_bound(const PointSet& points, Family family, const SearchLimits& share,
                  const RunContext& run);

/// What that may take: little of a long search, nothing to speak of where no end is set.
SearchLimits share_for_bound(const SearchLimits& limits, const RunContext& run);

/// One found in milliseconds, or some more of many points. Goes on when a stop is requested.
double quick_bound(const PointSet& points, Family family, const RunContext& run);

}  // namespace stipple::discrepancy::extreme
