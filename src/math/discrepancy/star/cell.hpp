// SPDX-License-Identifier: MIT
//
// Cells of upper corners, and bounds on the anchored boxes with these corners, for branch and
// bound.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/discrepancy/branch_and_bound.hpp"

namespace stipple::discrepancy::star {

/// Cell of all corners of one side. A cell contains the corners lo <= y <= hi. On axis k, y means
/// values[k][y] for open boxes and values[k][y - 1] for closed ones, so that on both sides a point
/// is inside if its rank is below y.
Cell whole_cell(const BoxGrid& grid, Side side);

/// The points that can affect a cell, with ranks stored axis by axis; `decided` is the number of
/// points that are inside all boxes of the cell and were dropped.
struct Active {
    std::size_t size = 0;
    /// Number of points below hi on all axes. These come first; the others are on a face at hi.
    std::size_t inside = 0;
    std::uint64_t decided = 0;
    std::vector<std::int32_t> ranks;

    [[nodiscard]] const std::int32_t* axis(std::size_t k) const { return ranks.data() + k * size; }
};

/// All points, undecided.
Active all_points(const BoxGrid& grid);

/// Logarithms of the grid's values, by axis.
std::vector<std::vector<double>> logarithms(const BoxGrid& grid);

/// Explores a task. @param logs logarithms(grid)
void explore(const BoxGrid& grid, const std::vector<std::vector<double>>& logs,
             const Active& points, Task& task, const SearchLimits& limits, const RunContext& run);

}  // namespace stipple::discrepancy::star
