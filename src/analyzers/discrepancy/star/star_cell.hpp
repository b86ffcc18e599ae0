// SPDX-License-Identifier: MIT
//
// Cells of the corner grid and what is known of the boxes that end in them: the bounds of the
// branch and bound search.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "analyzers/discrepancy/star/star_box.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::star {

/// A box of corners lo <= y <= hi. On axis k, y stands for values[k][y] for open boxes and for
/// values[k][y - 1] for closed ones, so that on both sides a point is inside if its rank is below
/// y.
struct Cell {
    Side side;
    double bound;  ///< no corner of the cell has a box worse than this
    Corner lo;
    Corner hi;
};

/// All corners of one side.
Cell whole_cell(const CornerGrid& grid, Side side);

/// The points that can matter in a cell, axis after axis, and the number of those that are inside
/// for sure and have been dropped.
struct Active {
    std::size_t size = 0;
    std::size_t inside = 0;  ///< so many, the first, are below hi; the rest lie on a face at hi
    std::uint64_t settled = 0;
    std::vector<std::int32_t> ranks;

    [[nodiscard]] const std::int32_t* axis(std::size_t k) const { return ranks.data() + k * size; }
};

/// All points.
Active all_points(const CornerGrid& grid);

/// The logarithms of the grid's values.
std::vector<std::vector<double>> logarithms(const CornerGrid& grid);

template <Side side>
class CellBounder {
  public:
    /// Keeps references to all of them.
    CellBounder(const CornerGrid& grid, const std::vector<std::vector<double>>& logs,
                WorstBox& worst, const RunContext& run);

    /// Shrinks the cell to what may hold a box worse than the worst, offers boxes on the way, and
    /// keeps those points of `from` that matter in it; false if nothing is left to split.
    bool tighten(Cell& cell, const Active& from, Active& mine);

    struct Split {
        std::size_t axis;
        std::uint32_t middle;  ///< lowest place of the upper half
        std::uint32_t below;   ///< highest place of the lower half
    };

    /// How to halve the cell that was tightened last.
    [[nodiscard]] Split split(const Cell& cell) const;

    /// Comparisons of coordinates and places until now.
    [[nodiscard]] std::uint64_t work() const { return work_; }

  private:
    using Axes = std::vector<std::vector<double>>;

    /// Places of an axis, from lo on, where a box may be worst, and signed counts of the points
    /// charged up to there; room for more than `size`.
    struct Candidates {
        std::size_t size = 0;
        std::vector<std::int32_t> places;
        std::vector<std::int32_t> counts;
    };

    [[nodiscard]] double value(std::size_t k, std::uint32_t y) const;
    void filter(const Cell& cell, const Active& from, Active& mine);
    void select(const Cell& cell, const Active& from, Active& mine);
    [[nodiscard]] bool ends_at_lo(const Cell& cell, const Active& from, std::size_t i) const;
    void count(const Cell& cell, const Active& active);
    void assign(const Cell& cell, const Active& active);
    void fill_bins(const Cell& cell, const Active& active, std::size_t k);
    void list_candidates(std::size_t k);
    void offer(const Corner& y, std::uint64_t points);
    bool reduce(const Cell& seen, Cell& cell);
    void sort_axes(const Cell& cell);
    void weigh_plainly(const Cell& cell);
    void weigh_by_logarithms(const Cell& cell);
    [[nodiscard]] double chord(double low, double high) const;
    bool exclude(const Axes& values, const Cell& seen, Cell& cell);
    bool cut_ends(std::size_t k, double most, const Cell& seen, Cell& cell);

    const CornerGrid& grid_;
    const Axes& logs_;
    WorstBox& worst_;
    const RunContext& run_;
    std::size_t d_;
    double inverse_;   ///< 1 / n
    double rounding_;  ///< more than the rounding errors of a bound
    std::uint64_t work_ = 0;

    // What is known of the cell at hand.
    std::uint64_t inside_lo_ = 0;                   ///< points inside for all its corners
    std::uint64_t inside_hi_ = 0;                   ///< for its largest corner
    std::vector<std::vector<std::uint32_t>> bins_;  ///< see count
    std::vector<Candidates> candidates_;            ///< of each axis
    Axes terms_;                                    ///< of the bound, for each candidate
    std::vector<double> least_;                     ///< of the terms of each axis
    std::vector<double> weights_;                   ///< of a step on each axis
    double base_ = 0;                               ///< volume at the anchor of the bound
    double margin_ = 0;                             ///< rounding_ and more

    // Scratch space.
    std::vector<std::int32_t> state_;
    std::vector<std::uint32_t> kept_;
    std::vector<std::uint32_t> on_face_;
    std::vector<std::int32_t> packed_;
    std::vector<std::int32_t> axes_;
    std::vector<float> cost_;
    std::vector<std::size_t> order_;
    std::vector<double> narrowness_;  ///< of each axis: lo over hi
    Corner corner_;
    Cell seen_{};
};

extern template class CellBounder<Side::open>;
extern template class CellBounder<Side::closed>;

}  // namespace stipple::analyzers::star
