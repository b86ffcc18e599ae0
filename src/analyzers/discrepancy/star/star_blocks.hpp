// SPDX-License-Identifier: MIT
//
// An upper bound of discrepancies from those of a few axes at a time. Let the axes be in m blocks,
// and let E_b bound the discrepancy of the points' coordinates on block b. A box has sides of
// volumes v_b on the blocks and the volume v, their product. It has no more points than any of its
// sides, and lacks no more than all of them do together:
//
//     #/n <= min_b (v_b + E_b),          min_b v_b = p  =>  v >= p^m,
//     #/n >= 1 - sum_b (1 - v_b + E_b),  mean_b v_b = s  =>  v <= s^m.
//
// So #/n - v is at most the maximum of p - p^m over p, and the largest E_b; v - #/n is at most the
// maximum of s^m - max(0, 1 - m (1 - s)) over s, and the sum of all E_b:
//
//     D <= max( (1 - 1/m) m^(-1/(m - 1)) + max_b E_b,  (1 - 1/m)^m + sum_b E_b ).
//
// Shape   any n and dimension; below 1 where n is large against m, but never small.
// Cost    O(n d + corners): what is left to say when there is no time for more.
// Promise certain: rounding is allowed for. Never depends on the number of threads.
#pragma once

#include <cstdint>

#include "analyzers/discrepancy/star/star_box.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::star {

/// How many times the star discrepancy that of other boxes may be, in so many dimensions.
using Factor = double (*)(double dimension);

/// The best of these bounds: blocks of one axis are measured, those of up to four and the whole are
/// bounded by covers of no more corners altogether than that.
double block_bound(const CornerGrid& grid, std::uint64_t most_corners, const RunContext& run,
                   Factor factor);

/// That of the star discrepancy, in a few milliseconds; in some more of many points.
double quick_bound(const CornerGrid& grid, const RunContext& run);

/// Offers the worst boxes that leave all axes but one whole: worse than 1/(2n), always. O(n d).
void offer_slabs(const CornerGrid& grid, WorstBox& worst);

}  // namespace stipple::analyzers::star
