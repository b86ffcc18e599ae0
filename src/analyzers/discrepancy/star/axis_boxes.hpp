// SPDX-License-Identifier: MIT
//
// What the axes tell one by one. Boxes that are whole on all axes but one give a worst box to
// begin with, and bad ones to report when there is no time for more. An upper bound: let E_k
// bound the discrepancy of the points' coordinates on axis k, of d. A box has sides v_k and the
// volume v, their product. It has no more points than any box with one of its sides, and lacks no
// more than all of these do together:
//
//     #/n <= min_k (v_k + E_k),          min_k v_k = p   =>  v >= p^d,
//     #/n >= 1 - sum_k (1 - v_k + E_k),  mean_k v_k = s  =>  v <= s^d.
//
// So #/n - v is at most the maximum of p - p^d over p, and the largest E_k; v - #/n is at most the
// maximum of s^d - max(0, 1 - d (1 - s)) over s, and the sum of all E_k:
//
//     D <= max( (1 - 1/d) d^(-1/(d - 1)) + max_k E_k,  (1 - 1/d)^d + sum_k E_k ).
//
// Cost    O(n d).
#pragma once

#include "analyzers/discrepancy/box_grid.hpp"

namespace stipple::discrepancy::star {

/// Offers the worst one-axis boxes of each axis and side: worse than 1/(2n), always.
void offer_axis_boxes(const BoxGrid& grid, WorstBox& worst);

/// The upper bound, where the discrepancy on an axis is at most `times` that of anchored boxes.
/// Below 1 for any dimension where points are many enough, but never small.
double axis_bound(const BoxGrid& grid, double times);

}  // namespace stipple::discrepancy::star
