// SPDX-License-Identifier: MIT
//
// A cell is a set of boxes: their sides on the first axis are free, the others begin and end in
// given ranges. With V the product of the other sides, and the points inside on the other axes in a
// line along the first one,
//
//     open:    excess <= that of the worst interval for the largest V and the points inside for all
//                        boxes of the cell (decided),
//     closed:  the same for the smallest V and the points inside for some (decided or not).
//
// Between two undecided points most decided ones cannot be an end of a worst interval for any V of
// the cell, as a neighbour dominates each; on the cube these are pruned, and counted where they
// were. So a cell's line is about as long as there are undecided points.
//
// Source  J. Barbay, T. M. Chan, G. Navarro, P. Perez-Lantero, "Maximum-weight planar boxes in
//         O(n^2) time (and better)", Inform. Process. Lett. 114 (2014) 437-445,
//         doi:10.1016/j.ipl.2014.03.007 (lines that shrink with their cells, for fixed weights;
//         the lines in V are this program's).
#pragma once

#include "math/discrepancy/branch_and_bound.hpp"

namespace stipple::discrepancy::extreme {

/// All boxes of one side. A cell has three ranges for every axis but the first: of the ranks where
/// a box begins, of those where it ends, and of whether it wraps, 0 or 1.
Cell whole_cell(const BoxGrid& grid, Side side);

/// A point of a line.
struct Entry {
    double x;
    std::uint32_t point;
    std::uint32_t pruned : 31;    ///< decided points that were here, after the entry before
    std::uint32_t undecided : 1;  ///< not inside for all boxes of the cell
};

/// The points inside on all axes but the first for some box of a cell, along the first axis.
struct Line {
    std::vector<Entry> entries;
    std::uint32_t pruned = 0;  ///< decided points that were here, after the last entry
};

/// All points, undecided.
Line whole_line(const BoxGrid& grid);

/// Explores a task from the line of all points.
void explore(const BoxGrid& grid, const Line& line, Task& task, const SearchLimits& limits,
             const RunContext& run);

}  // namespace stipple::discrepancy::extreme
