// SPDX-License-Identifier: MIT
//
// The largest empty rectangle in the square or on the torus, by way of all those that cannot grow.
// One that cannot grow upwards has a point inside its upper side. Below each point, start with the
// full width; the highest point inside bounds the rectangle from below, and from the left or the
// right those that reach further down; and so on, until it is above or below the first.
//
// Cost    O((n + s) log n), where s <= n^2 rectangles cannot grow (about n log n of random points),
//         fewer as those that are too narrow are not followed; O(n) memory.
// Source  A. Naamad, D. T. Lee, W.-L. Hsu, "On the maximum empty rectangle problem", Discrete Appl.
//         Math. 8 (1984) 267-277, doi:10.1016/0166-218X(84)90124-0.
#pragma once

#include "math/discrepancy/box_grid.hpp"
#include "math/discrepancy/search_limits.hpp"

namespace stipple::discrepancy {

/// The largest empty rectangle of a grid of two axes that measures emptiness. Ends early at the
/// deadline, or when a stop is requested, with the largest one so far, or a gap between neighbours.
SearchResult largest_empty_rectangle(const BoxGrid& grid, const SearchLimits& limits,
                                     const RunContext& run);

/// Bytes for each point, besides the grid.
constexpr std::size_t rectangle_bytes = 16;

}  // namespace stipple::discrepancy
