// SPDX-License-Identifier: MIT
//
// An upper bound of the star discrepancy of 2^m points that are a (t,m,d)-net in base 2, from that
// alone. Let E(m, d) bound | #{points in [0,c)} - 2^m vol(c) |. The last side of [0,c) is, binary
// digit by binary digit, at most one interval of each length 2^-1, ..., 2^-(m-t), and a rest that
// is within one more of the last length. The points whose last coordinate is in one of length 2^-j
// are, without that coordinate, a (t,m-j,d-1)-net; those of the rest are at most 2^t, as its volume
// times 2^m is. So
//
//     E(m, d) = 2^t + sum over k = t, ..., m - 1 of E(k, d - 1),      E(m, 1) = E(t, d) = 2^t,
//
// and D* <= E(m, d) / 2^m. Closed boxes are limits of half-open ones.
//
// Shape   2^m points, m <= 31. Worth it for few dimensions: E grows as m^(d-1).
// Cost    2^m for each of C(m - t + d - 1, d - 1) divisions; less where the points are a digital
//         net.
// Source  the bound is that of H. Niederreiter, "Random Number Generation and Quasi-Monte Carlo
//         Methods", SIAM 1992, chapter 4, for base 2; the proof is above.
#pragma once

#include <cstdint>

#include "analyzers/discrepancy/box_grid.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy::star {

/// The bound, if it is below `most` and found with no more than so many comparisons; else 1.
double net_bound(const BoxGrid& grid, double most, std::uint64_t work, const RunContext& run);

}  // namespace stipple::discrepancy::star
