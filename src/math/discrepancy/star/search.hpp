// SPDX-License-Identifier: MIT
//
// The worst anchored box in any dimension, by branch and bound, or proven bounds if stopped early.
#pragma once

#include <cstdint>

#include "math/discrepancy/box_grid.hpp"
#include "math/discrepancy/branch_and_bound.hpp"
#include "math/discrepancy/search_limits.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy::star {

/// Searches for boxes worse than `worst`; a worse start leaves less to search.
SearchResult search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                    const RunContext& run, Peers* peers = nullptr);

/// As search(), except that one and two dimensions use a sweep, which ignores `worst`.
SearchResult sweep_or_search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                             const RunContext& run);

/// Searches without a known box. Begins with coordinate ascents, which count against limits.work.
SearchResult find_worst(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run,
                        Peers* peers = nullptr);

/// Upper bound on the discrepancy, computed in milliseconds, or longer for many points. Ignores
/// stop requests. For another family of boxes, `of_axis` and `of_all` bound the ratio of its
/// discrepancy to that of anchored boxes, for a single coordinate and for all of them.
double quick_bound(const BoxGrid& grid, const RunContext& run, double of_axis = 1,
                   double of_all = 1);

/// Bytes of the search for these points, without the grid.
double search_bytes(std::size_t count, std::size_t dimension, unsigned threads);

// Bounds for all anchored boxes at once, available before the cells of a search become small.

/// Offers the worst box that covers all axes except one, for each axis and side. The worst of all
/// these boxes has a value of at least 1/(2n).
void offer_axis_boxes(const BoxGrid& grid, WorstBox& worst);

/// As offer_axis_boxes() above, but keeps open and closed boxes apart. One of the two may stay
/// without a box of positive value.
void offer_axis_boxes(const BoxGrid& grid, WorstBox& open, WorstBox& closed);

/// Upper bound from single axes, if discrepancies on an axis are at most `times` those of anchored
/// boxes. Below 1 in any dimension for enough points, but never small.
double axis_bound(const BoxGrid& grid, double times);

/// Upper bound from the finest grid with up to `most_corners` corners; 1 if these are too few.
double cover_bound(const BoxGrid& grid, std::uint64_t most_corners, const RunContext& run);

/// Upper bound from the base-2 net that the points form; 1 if it is not below `most`, or needs more
/// than `work` comparisons.
double net_bound(const BoxGrid& grid, double most, std::uint64_t work, const RunContext& run);

// The worst box in one and two dimensions, by sweeps over the coordinates.

/// Worst box in one dimension, in O(n) after sorting.
SearchResult sweep_1d(const BoxGrid& grid, const RunContext& run);

/// Worst box in two dimensions, in O(n^(4/3)) time in practice and O(n) memory; see strips.hpp. A
/// deadline or stop ends it early with the result so far.
SearchResult sweep_2d(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run);

/// Worst box of each side: an open one with too few points, a closed one with too many. The value
/// is 0 if there is no such box.
struct WorstOfSides {
    WorstBox open;
    WorstBox closed;
};

/// Finds the worst box of each side by the sweep. @throws Error(cancelled) when a stop is requested
WorstOfSides worst_of_sides_2d(const BoxGrid& grid, const RunContext& run);

}  // namespace stipple::discrepancy::star
