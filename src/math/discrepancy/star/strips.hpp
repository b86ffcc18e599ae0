// SPDX-License-Identifier: MIT
//
// The worst box in the plane, strip by strip. Places on the first axis are grouped into strips,
// those on the second into blocks, of up to B points each. For the boxes that end in a strip a0 <=
// a < a1 and a block j0 <= j < j1, with X_a, Y_j the values at ranks and #[..] counting points by
// their ranks (r, t), open boxes split into parts that know one axis only,
//
//     n X_a Y_j - #[r < a, t < j]  =  n X_a0 Y_j0 - #[r < a0, t < j0]
//         + { n (X_a - X_a0) Y_j0 - #[a0 <= r < a, t < j0] }
//         + { n (Y_j - Y_j0) X_a0 - #[r < a0, j0 <= t < j] }
//         + n (X_a - X_a0) (Y_j - Y_j0) - #[a0 <= r < a, j0 <= t < j],
//
// of which the last line is at most n times the strip's width times the block's. Closed boxes are
// the same from the block's last rank,
//
//     #[r <= a, t <= j] - n X_a Y_j  =  #[r < a0, t < j1] - n X_a0 Y_J      (J = j1 - 1)
//         + { #[a0 <= r <= a, t < j1] - n (X_a - X_a0) Y_J }
//         + { n (Y_J - Y_j) X_a0 - #[r < a0, j < t < j1] }
//         + n (X_a - X_a0) (Y_J - Y_j) - #[a0 <= r <= a, j < t < j1].
//
// The maximum of a brace is convex in the other axis's value for as long as no point enters it, so
// a chord bounds it from one point of the strip (or block) to the next. What is left for each pair
// of strip and block is two products and a comparison; few pairs need their boxes looked at.
//
// Cost    n B for the chords and (n / B)^2 for the pairs: O(n^(4/3)) time with B ~ n^(1/3), where
//         the worst box stands out by more than a strip's own unevenness; O(n) memory.
// Source  this program's own.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "math/discrepancy/box_grid.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy::star {

/// Neighbouring ranks of one axis, put together to groups of some points or one rank each.
struct Groups {
    std::vector<std::uint32_t> first;  ///< rank of each, and behind them the number of ranks

    [[nodiscard]] std::size_t count() const { return first.size() - 1; }
};

/// A point by its ranks.
struct Dot {
    std::uint32_t first;
    std::uint32_t second;
    std::uint32_t block;  ///< that `second` is in
};

/// The points in order of their first coordinate, in strips.
struct Plane {
    const BoxGrid* grid = nullptr;
    double count = 0;  ///< n
    Groups strips;
    Groups blocks;
    double widest = 0;                     ///< group, from its first value to its last
    std::vector<Dot> dots;                 ///< rising by `first`
    std::vector<std::uint32_t> dots_from;  ///< of each strip: its first dot; behind them, n
    std::vector<std::uint32_t> next;       ///< of each dot: next strip with a dot in its block
    std::vector<std::uint32_t> first;      ///< of each block: first strip with a dot in it
};

/// Keeps a reference to the grid.
Plane plane(const BoxGrid& grid, const RunContext& run);

/// Strips first, ..., last - 1.
struct StripRange {
    std::size_t first;
    std::size_t last;
};

/// Offers to `worst` all boxes of one side that end in these strips and may be worse; calls
/// passed(dots) after each strip.
void sweep_strips(const Plane& plane, Side side, StripRange strips, WorstBox& worst,
                  const RunContext& run, const std::function<void(std::uint64_t)>& passed);

}  // namespace stipple::discrepancy::star
