// SPDX-License-Identifier: MIT
//
// The largest empty rectangle in the square or on the torus, from all maximal ones. A maximal
// rectangle has a point on its upper side or reaches the ceiling of the square. The search below a
// point starts with the full width and height. One rectangle ends at the highest point inside.
// Deeper rectangles have this point on their left or right side, so it cuts the width. This repeats
// until the highest point inside is straight below the first point.
//
// Cost    O((n + s) log n) with s <= n^2 maximal rectangles (about n log n for random points), in
//         practice less, since narrow ones are skipped; O(n) memory.
// Source  A. Naamad, D. T. Lee, W.-L. Hsu, "On the maximum empty rectangle problem", Discrete Appl.
//         Math. 8 (1984) 267-277, doi:10.1016/0166-218X(84)90124-0.
#pragma once

#include "math/discrepancy/box_grid.hpp"
#include "math/discrepancy/search_limits.hpp"

namespace stipple::discrepancy {

/// Largest empty rectangle of a grid with two axes and Measure::emptiness. A deadline or stop ends
/// the search early with the largest rectangle so far, which is no smaller than the widest strip of
/// full height between neighbouring first coordinates.
SearchResult largest_empty_rectangle(const BoxGrid& grid, const SearchLimits& limits,
                                     const RunContext& run);

/// Bytes per point that largest_empty_rectangle() needs besides the grid.
constexpr std::size_t rectangle_bytes = 16;

}  // namespace stipple::discrepancy
