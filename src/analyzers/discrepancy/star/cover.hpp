// SPDX-License-Identifier: MIT
//
// An upper bound of the star discrepancy from counts at the corners of a coarse grid: with lo <= c
// <= hi the corners of the cell that c is in,
//
//     vol(c) - #{x < c} / n <= vol(hi) - #{x <= lo} / n,
//     #{x <= c} / n - vol(c) <= #{x <= hi} / n - vol(lo),
//
// so that the worst cell bounds the discrepancy, no more than delta = max (vol(hi) - vol(lo)) above
// it. The grid is finer towards 1, where volumes change most:
//
//     1,  x_0 = (1 - delta)^(1/d),  x_(i+1) = (x_i - delta) x_0^(1 - d),  ...,  0.
//
// Shape   any n; about (d / (d - 1) ln(d) / delta)^d corners: worth it for few dimensions.
// Cost    O(n d + corners d); 4 bytes a corner.
// Promise certain: rounding is allowed for. Never depends on the number of threads.
// Source  B. Doerr, M. Gnewuch, A. Srivastav, J. Complexity 21 (2005) 691-709 (delta-covers).
#pragma once

#include <cstdint>

#include "analyzers/discrepancy/box_grid.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy::star {

/// The bound from the finest grid of up to `most_corners`; 1 where that is too few to tell
/// anything.
double cover_bound(const BoxGrid& grid, std::uint64_t most_corners, const RunContext& run);

}  // namespace stipple::discrepancy::star
