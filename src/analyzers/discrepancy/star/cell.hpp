// SPDX-License-Identifier: MIT
//
// Cells of upper corners and what is known of the anchored boxes that end in them: the bounds of
// the branch and bound search.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "analyzers/discrepancy/branch_and_bound.hpp"

namespace stipple::discrepancy::star {

/// All corners of one side. A cell has the corners lo <= y <= hi. On axis k, y stands for
/// values[k][y] for open boxes and for values[k][y - 1] for closed ones, so that on both sides a
/// point is inside if its rank is below y.
Cell whole_cell(const BoxGrid& grid, Side side);

/// The points that can matter in a cell, axis after axis, and the number of those that are inside
/// for sure and have been dropped.
struct Active {
    std::size_t size = 0;
    std::size_t inside = 0;  ///< so many, the first, are below hi; the rest lie on a face at hi
    std::uint64_t decided = 0;
    std::vector<std::int32_t> ranks;

    [[nodiscard]] const std::int32_t* axis(std::size_t k) const { return ranks.data() + k * size; }
};

/// All points.
Active all_points(const BoxGrid& grid);

/// The logarithms of the grid's values.
std::vector<std::vector<double>> logarithms(const BoxGrid& grid);

template <Side side>
class CellBounder {
  public:
    using Points = Active;

    /// Keeps references to all of them.
    CellBounder(const BoxGrid& grid, const std::vector<std::vector<double>>& logs, WorstBox& worst,
                const RunContext& run);

    /// Shrinks the cell to what may hold a box worse than the worst, offers boxes on the way, and
    /// keeps those points of `from` that matter in it; false if nothing is left to split.
    bool tighten(Cell& cell, const Active& from, Active& mine);

    /// Takes the lower half away from the cell, which was tightened last, on the axis that weighs
    /// most in its bound.
    Cell split(Cell& cell) const;

    /// Comparisons of coordinates and ranks until now.
    [[nodiscard]] std::uint64_t work() const { return work_; }

  private:
    using Axes = std::vector<std::vector<double>>;

    /// Ranks of an axis, from lo on, where a box may be worst, and signed counts of the points
    /// assigned to the axis up to there; room for more than `size`.
    struct Candidates {
        std::size_t size = 0;
        std::vector<std::int32_t> ranks;
        std::vector<std::int32_t> counts;
    };

    struct Anchor {
        double bound;
        double weight;  ///< of a step in the terms
        double margin;  ///< more than the rounding errors
    };

    [[nodiscard]] double value(std::size_t k, std::uint32_t y) const;
    void filter(const Cell& cell, const Active& from, Active& mine);
    void select(const Cell& cell, const Active& from, Active& mine);
    [[nodiscard]] bool ends_at_lo(const Cell& cell, const Active& from, std::size_t i) const;
    void count(const Cell& cell, const Active& active);
    void assign(const Cell& cell, const Active& active);
    void fill_bins(const Cell& cell, const Active& active, std::size_t k);
    void list_candidates(std::size_t k);
    void offer(const std::vector<std::uint32_t>& y, std::uint64_t points);
    [[nodiscard]] Anchor anchor(const Cell& cell) const;
    bool reduce(const Cell& seen, Cell& cell);
    [[nodiscard]] double chord(double low, double high) const;
    bool cut_ends(std::size_t k, double most, const Cell& seen, Cell& cell);
    [[nodiscard]] std::size_t split_axis(const Cell& cell) const;

    const BoxGrid& grid_;
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
    std::vector<std::vector<std::uint32_t>> bins_;  ///< see fill_bins
    std::vector<Candidates> candidates_;            ///< of each axis
    Axes terms_;                                    ///< of the bound, for each candidate
    std::vector<double> least_;                     ///< of the terms of each axis

    // Scratch space.
    std::vector<std::int32_t> state_;
    std::vector<std::uint32_t> kept_;
    std::vector<std::uint32_t> on_face_;
    std::vector<std::int32_t> packed_;
    std::vector<std::int32_t> axes_;
    std::vector<float> cost_;
    std::vector<std::uint32_t> corner_;
    Cell seen_{};
};

extern template class CellBounder<Side::open>;
extern template class CellBounder<Side::closed>;

}  // namespace stipple::discrepancy::star
