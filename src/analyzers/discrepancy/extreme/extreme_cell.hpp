// SPDX-License-Identifier: MIT
//
// A cell is a set of boxes: their sides on the first axis are free, the others begin and end in
// given ranges. With V the product of the other sides, and the points inside on the other axes in a
// line along the first one,
//
//     open:    worth <= that of the worst interval for the largest V and the points that are inside
//                       for all boxes of the cell (decided),
//     closed:  the same for the smallest V and the points inside for some (decided or not).
//
// Between two undecided points most decided ones cannot be an end of a worst interval for any V of
// the cell, as a neighbour is better for each; these are dropped, and counted where they were. So a
// cell's line is about as long as there are undecided points.
//
// Source  J. Barbay, T. M. Chan, G. Navarro, P. Perez-Lantero, "Maximum-weight planar boxes in
//         O(n^2) time (and better)", Inform. Process. Lett. 114 (2014) 437-445,
//         doi:10.1016/j.ipl.2014.03.007 (lines that shrink with their cells, for fixed weights;
//         the lines in V are this program's).
#pragma once

#include <array>

#include "analyzers/discrepancy/extreme/extreme_box.hpp"

namespace stipple::analyzers::extreme {

/// Places from first to last.
struct Range {
    std::uint32_t first;
    std::uint32_t last;

    [[nodiscard]] bool single() const { return first == last; }
};

/// Whether the intervals of a cell on an axis wrap.
enum class Shape { plain, wrapped, either };

/// The intervals on one axis that a cell's boxes have there.
struct Ends {
    Range lower;
    Range upper;
    Shape shape;
};

struct Cell {
    Side side;
    std::vector<Ends> axes;  ///< all but the first
    double bound;            ///< no box is worth more
};

/// All boxes of one side.
Cell whole_cell(const BoxGrid& grid, Side side);

/// Halves a cell on the axis where that promises most; the first half has the larger boxes. A half
/// may have no boxes. Needs a cell of two boxes or more on other axes than the first.
std::pair<Cell, Cell> split(const BoxGrid& grid, const Cell& cell);

/// Leaves out ends that no interval of the cell has; false if none is left.
bool trim(Cell& cell);

/// Whether its boxes differ on the first axis only.
bool is_single(const Cell& cell);

/// A point of a line.
struct Entry {
    double x;
    std::uint32_t point;
    std::uint32_t dropped : 31;   ///< decided points that were here, after the entry before
    std::uint32_t undecided : 1;  ///< not inside for all boxes of the cell
};

/// The points inside on all axes but the first for some box of a cell, along the first axis.
struct Line {
    std::vector<Entry> entries;
    std::uint32_t dropped = 0;  ///< decided points that were here, after the last entry
};

/// All points, undecided.
Line whole_line(const BoxGrid& grid);

/// The line of a cell, of that of a larger one.
void refine(const BoxGrid& grid, const Cell& cell, const Line& from, Line& to);

/// Points that are looked at together when a line is shortened.
inline constexpr std::size_t longest_stretch = 32;

/// Bounds cells; keeps its buffers.
class CellBounder {
  public:
    explicit CellBounder(const BoxGrid& grid)
        : grid_(grid),
          scale_(static_cast<double>(grid.scale)),
          weight_(static_cast<double>(grid.weight)),
          rounding_(grid.rounding()) {}

    /// Worth of the cell's worst box at most, up to rounding.
    [[nodiscard]] double bound(const Cell& cell, const Line& line) const;

    /// Whether the bound, without rounding, is above the worst box; offers the box of a single
    /// cell.
    bool settle(const Cell& cell, const Line& line, WorstBox& worst);

    /// Drops decided points that make no difference for boxes worse than the worst one.
    void shorten(const Cell& cell, const WorstBox& worst, Line& line);

    [[nodiscard]] double rounding() const { return rounding_; }

  private:
    /// Decided points of a line next to each other.
    struct Stretch {
        std::size_t first;
        std::size_t last;
        double height;  ///< h of the law of lines that bounds the cell
        double around;  ///< worth of the whole circle
    };

    [[nodiscard]] double worst_inside(const Stretch& stretch, Side side, const Line& line) const;

    /// Whether no interval inside the stretch is worse than the worst box.
    [[nodiscard]] bool sift(const Stretch& stretch, Side side, const Line& line,
                            const WorstBox& worst) const;

    /// Finds which points of a stretch may be ends of a worst interval for an h in [low, high].
    void mark(const Stretch& stretch, const Line& line, double low, double high);

    const BoxGrid& grid_;
    double scale_;
    double weight_;
    double rounding_;
    std::array<bool, longest_stretch> useful_{};  ///< of the points of a stretch
};

}  // namespace stipple::analyzers::extreme
