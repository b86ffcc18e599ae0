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

#include <array>

#include "analyzers/discrepancy/branch_and_bound.hpp"

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

/// Points that are looked at together when a line is pruned.
inline constexpr std::size_t longest_stretch = 32;

/// Bounds cells; keeps its buffers.
class CellBounder {
  public:
    using Points = Line;

    /// Keeps references to both.
    CellBounder(const BoxGrid& grid, WorstBox& worst);

    /// Shrinks and bounds the cell, given the line of a larger one; offers its box if it is a
    /// single one. False if it holds none worse than the worst box, or nothing is left to split.
    bool tighten(Cell& cell, const Line& from, Line& mine);

    /// Halves a cell on the axis where that promises most; takes the half with the larger boxes
    /// away. A half may have no boxes.
    Cell split(Cell& cell) const;

    /// Comparisons of coordinates until now.
    [[nodiscard]] std::uint64_t work() const { return work_; }

  private:
    /// Decided points of a line next to each other.
    struct Stretch {
        std::size_t first;
        std::size_t last;
    };

    void refine(const Cell& cell, const Line& from, Line& to);
    [[nodiscard]] double bound(const Line& line) const;
    bool check_exactly(const Cell& cell, const Line& line, double bound);
    [[nodiscard]] double worst_inside(const Stretch& stretch, const Line& line) const;
    [[nodiscard]] bool may_prune(const Stretch& stretch, const Line& line) const;
    void find_useful(const Stretch& stretch, const Line& line);
    void prune(Line& line);

    const BoxGrid& grid_;
    WorstBox& worst_;
    double scale_;
    double weight_;
    double rounding_;
    std::uint64_t work_ = 0;

    // What is known of the cell at hand.
    Side side_ = Side::open;
    std::vector<RankSet> outer_;  ///< on every axis but the first, inside for some box
    std::vector<RankSet> inner_;  ///< and inside for all
    double largest_ = 0;          ///< section of the cell's boxes, times the scale
    double smallest_ = 0;
    std::array<bool, longest_stretch> useful_{};  ///< of the points of a stretch
};

}  // namespace stipple::discrepancy::extreme
