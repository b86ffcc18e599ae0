// SPDX-License-Identifier: MIT
//
// Bounds for all anchored boxes at once, found sooner than cells of a search get small.
#pragma once

#include <cstdint>

#include "analyzers/discrepancy/box_grid.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy::star {

/// Offers the worst one-axis boxes of each axis and side: worse than 1/(2n), always.
void offer_axis_boxes(const BoxGrid& grid, WorstBox& worst);

/// The upper bound, where the discrepancy on an axis is at most `times` that of anchored boxes.
/// Below 1 for any dimension where points are many enough, but never small.
double axis_bound(const BoxGrid& grid, double times);

/// The upper bound from the finest grid of up to `most_corners`; 1 where that is too few to tell
/// anything.
double cover_bound(const BoxGrid& grid, std::uint64_t most_corners, const RunContext& run);

/// The upper bound from the net in base 2 that the points are, if it is below `most` and found with
/// no more than so many comparisons; else 1.
double net_bound(const BoxGrid& grid, double most, std::uint64_t work, const RunContext& run);

}  // namespace stipple::discrepancy::star
