// SPDX-License-Identifier: MIT
//
// The worst box in the plane, strip by strip. Ranks on the first axis are grouped into strips,
// those on the second into blocks, of up to B points each. Consider boxes that end in a strip a0 <=
// a < a1 and a block j0 <= j < j1, where X_a and Y_j are the coordinates at these ranks, and #[..]
// is the number of points whose ranks (r, t) satisfy the conditions. Open boxes split into parts
// that depend on a or j alone, and a remainder:
//
//     n X_a Y_j - #[r < a, t < j]  =  n X_a0 Y_j0 - #[r < a0, t < j0]
//         + { n (X_a - X_a0) Y_j0 - #[a0 <= r < a, t < j0] }
//         + { n (Y_j - Y_j0) X_a0 - #[r < a0, j0 <= t < j] }
//         + n (X_a - X_a0) (Y_j - Y_j0) - #[a0 <= r < a, j0 <= t < j].
//
// The last line is at most n times the product of the widths of strip and block. Closed boxes are
// split likewise at the block's last rank:
//
//     #[r <= a, t <= j] - n X_a Y_j  =  #[r < a0, t < j1] - n X_a0 Y_J      (J = j1 - 1)
//         + { #[a0 <= r <= a, t < j1] - n (X_a - X_a0) Y_J }
//         + { n (Y_J - Y_j) X_a0 - #[r < a0, j < t < j1] }
//         + n (X_a - X_a0) (Y_J - Y_j) - #[a0 <= r <= a, j < t < j1].
//
// For a given a or j, a brace is a line: a linear function of the coordinate on the other axis, as
// long as it counts the same points. The maximum over all a (or j) is convex, so a chord bounds it
// from one point of the strip (or block) to the next. Each pair of strip and block then takes two
// products and a comparison; only for few pairs are all boxes compared.
//
// Cost    n B for the chords and (n / B)^2 for the pairs: O(n^(4/3)) time with B ~ n^(1/3), if the
//         worst box exceeds others by more than the variation within a strip; O(n) memory.
// Source  original.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "math/discrepancy/box_grid.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy::star {

/// Groups of neighbouring ranks of an axis: each is limited in points and width, or a single rank.
struct Groups {
    std::vector<std::uint32_t> first;  ///< first rank of each group, then the number of ranks

    [[nodiscard]] std::size_t count() const { return first.size() - 1; }
};

/// A point given by its ranks.
struct Dot {
    std::uint32_t first;
    std::uint32_t second;
    std::uint32_t block;  ///< block of `second`
};

/// The points in order of their first coordinate, in strips.
struct Plane {
    const BoxGrid* grid = nullptr;
    double count = 0;  ///< n
    Groups strips;
    Groups blocks;
    double widest = 0;                     ///< maximum width of a group
    std::vector<Dot> dots;                 ///< sorted by `first`
    std::vector<std::uint32_t> dots_from;  ///< first dot of each strip, then n
    std::vector<std::uint32_t> next;   ///< by dot: next strip with a dot in its block, or the last
    std::vector<std::uint32_t> first;  ///< by block: first strip with a dot in it, or the last
};

/// Builds the plane; it keeps a reference to the grid.
Plane plane(const BoxGrid& grid, const RunContext& run);

/// Range of strips: first, ..., last - 1.
struct StripRange {
    std::size_t first;
    std::size_t last;
};

/// Offers to `worst` all boxes of one side that end in these strips and may be worse than it. Calls
/// passed(number of dots) after each strip.
void sweep_strips(const Plane& plane, Side side, StripRange strips, WorstBox& worst,
                  const RunContext& run, const std::function<void(std::uint64_t)>& passed);

}  // namespace stipple::discrepancy::star
