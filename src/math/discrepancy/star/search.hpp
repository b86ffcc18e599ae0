// SPDX-License-Identifier: MIT
//
// The worst anchored box in any dimension, by branch and bound; stopped early, bounds that are
// certain.
#pragma once

#include <cstdint>

#include "math/discrepancy/box_grid.hpp"
#include "math/discrepancy/branch_and_bound.hpp"
#include "math/discrepancy/search_limits.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy::star {

/// Looks for boxes worse than `worst`; the worse that is, the less is left to look at.
SearchResult search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                    const RunContext& run, Peers* peers = nullptr);

/// The same, by a sweep in one and two dimensions, where nothing need be known.
SearchResult sweep_or_search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                             const RunContext& run);

/// The same from nothing: coordinate ascents first, which are a part of the work.
SearchResult find_worst(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run,
                        Peers* peers = nullptr);

/// No box has a larger discrepancy; found in milliseconds, or some more of many points. Also for
/// boxes whose discrepancy is at most `of_axis` times that of anchored ones on each axis, and
/// `of_all` times on all together. Goes on when a stop is requested.
double quick_bound(const BoxGrid& grid, const RunContext& run, double of_axis = 1,
                   double of_all = 1);

/// Bytes that the search takes, with these points, beside the grid.
double search_bytes(std::size_t count, std::size_t dimension, unsigned threads);

// Bounds for all anchored boxes at once, found sooner than cells of a search get small.

/// Offers the worst one-axis boxes of each axis and side: worse than 1/(2n), always.
void offer_axis_boxes(const BoxGrid& grid, WorstBox& worst);

/// The same with open and closed boxes apart, of which one kind may have none.
void offer_axis_boxes(const BoxGrid& grid, WorstBox& open, WorstBox& closed);

/// The upper bound, where the discrepancy on an axis is at most `times` that of anchored boxes.
/// Below 1 for any dimension where points are many enough, but never small.
double axis_bound(const BoxGrid& grid, double times);

/// The upper bound from the finest grid of up to `most_corners`; 1 where that is too few to tell
/// anything.
double cover_bound(const BoxGrid& grid, std::uint64_t most_corners, const RunContext& run);

/// The upper bound from the net in base 2 that the points are, if it is below `most` and found with
/// no more than so many comparisons; else 1.
double net_bound(const BoxGrid& grid, double most, std::uint64_t work, const RunContext& run);

// The worst box in one and two dimensions, by a sweep over the coordinates.

/// O(n) after sorting.
SearchResult sweep_1d(const BoxGrid& grid, const RunContext& run);

/// O(n^(4/3)) time in practice, O(n) memory; see strips.hpp. Ends early at the deadline, or when a
/// stop is requested, with what it has.
SearchResult sweep_2d(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run);

/// The worst box of each side: too few points in an open one, too many in a closed one. Where no
/// box of a side is so, its value is 0.
struct WorstOfSides {
    WorstBox open;
    WorstBox closed;
};

/// By the same sweep. @throws Error(cancelled) when a stop is requested
WorstOfSides worst_of_sides_2d(const BoxGrid& grid, const RunContext& run);

}  // namespace stipple::discrepancy::star
