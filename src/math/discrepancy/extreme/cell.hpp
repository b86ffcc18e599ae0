// SPDX-License-Identifier: MIT
//
// A cell is a set of boxes with arbitrary sides on the first axis, whose other sides begin and end
// in given ranges. Let V be the product of the other sides, and arrange the points inside on the
// other axes in a line along the first one. Then
//
//     open:    excess <= excess of the worst interval for the largest V and the points inside all
//                        boxes of the cell (decided),
//     closed:  likewise for the smallest V and the points inside some box (decided or not).
//
// Between two undecided points, most decided ones are dominated by a neighbour, so they cannot be
// ends of a worst interval for any V of the cell. On the cube these are pruned, and only their
// number is kept. So the length of a cell's line is about the number of undecided points.
//
// Source  J. Barbay, T. M. Chan, G. Navarro, P. Perez-Lantero, "Maximum-weight planar boxes in
//         O(n^2) time (and better)", Inform. Process. Lett. 114 (2014) 437-445,
//         doi:10.1016/j.ipl.2014.03.007 (lines that shrink with their cells, for fixed weights;
//         the lines in V are this program's).
#pragma once

#include "math/discrepancy/branch_and_bound.hpp"

namespace stipple::discrepancy::extreme {

/// Cell of all boxes of one side. A cell has three ranges for every axis except the first: ranks
/// where a box begins, ranks where it ends, and whether it wraps, 0 or 1.
Cell whole_cell(const BoxGrid& grid, Side side);

/// A point on a cell's line.
struct Entry {
    double x;
    std::uint32_t point;
    std::uint32_t pruned : 31;    ///< decided points removed just before this entry
    std::uint32_t undecided : 1;  ///< not inside all boxes of the cell
};

/// Points along the first axis that are inside some box of a cell on all other axes.
struct Line {
    std::vector<Entry> entries;
    std::uint32_t pruned = 0;  ///< decided points removed after the last entry
};

/// Line of all points, undecided.
Line whole_line(const BoxGrid& grid);

/// Explores a task, starting from the line of all points.
void explore(const BoxGrid& grid, const Line& line, Task& task, const SearchLimits& limits,
             const RunContext& run);

}  // namespace stipple::discrepancy::extreme
