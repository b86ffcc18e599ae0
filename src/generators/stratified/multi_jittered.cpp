// SPDX-License-Identifier: MIT
//
// Multi-jittered points in the plane: n points with one in each of n strips of equal width along
// either axis, and one in each of n cells.
//
//     n = a b   the cells are the a x b grid, a columns and b rows. The strips of a column are
//               assigned to its b points by a random permutation, a different one in each column;
//               likewise the strips of a row to its a points.
//     else      with a columns, b = floor(n / a) rows of a points, and one more row of height q / n
//               for the remaining q = n mod a points. Column c has the strips from
//               floor((c n + f) / a) to floor(((c + 1) n + f) / a) - 1, with a random f < a: b or,
//               in the q columns with a point in the last row, b + 1. Then all points are shifted
//               by a random number of strips along x (modulo n), so that every point is uniform.
//
// a is that of --shape, or the largest divisor of n in [sqrt(n / 2), sqrt(n)], or floor(sqrt(n)) if
// there is none.
//
// Cost    O(n); point i is found without the others. Tables of n entries up to n = 2^20.
// Promise one point in each strip, for every n; for n = a b one in each cell; for other n, before
//         the shift, one in each cell of the full rows and at most one in each cell of the last
//         row.
// Source  K. Chiu, P. Shirley, C. Wang, "Multi-jittered sampling", Graphics Gems IV (1994),
//         370-374 (n = a b). Other n: stipple's own.

#include "generators/stratified/stratified.hpp"
#include "math/combinatorics/permutation.hpp"

namespace stipple::generators::multi_jittered {
namespace {

class MultiJittered {
  public:
    MultiJittered(const Plan& plan, std::uint64_t columns)
        : count_(plan.count),
          columns_(columns),
          rows_(plan.count / columns),
          rest_(plan.count % columns),
          in_short_columns_(rows_, columns, stratified_numbers(plan, 0)),
          in_tall_columns_(rows_ + 1, rest_ > 0 ? columns : 0, stratified_numbers(plan, 1)),
          in_rows_(columns, rows_, stratified_numbers(plan, 2)),
          in_last_row_(rest_ > 0 ? rest_ : 1, stratified_numbers(plan, 3).bits(0)) {
        if (rest_ == 0) return;
        phase_ = stratified_numbers(plan, 3).below(1, columns);
        turn_ = stratified_numbers(plan, 3).below(2, plan.count);
    }

    std::uint64_t operator()(std::size_t coordinate, std::span<const double> index,
                             std::span<double> low) const {
        for (std::size_t j = 0; j < index.size(); ++j) {
            const auto i = static_cast<std::uint64_t>(index[j]);
            low[j] = static_cast<double>(coordinate == 0 ? x_strip(i) : y_strip(i));
        }
        return count_;
    }

  private:
    struct Cell {
        std::uint64_t column;
        std::uint64_t row;
    };

    /// Number of points of the last row in the columns before this one.
    [[nodiscard]] std::uint64_t extra_before(std::uint64_t column) const {
        return (column * rest_ + phase_) / columns_;
    }

    [[nodiscard]] Cell cell(std::uint64_t i) const {
        if (i < rows_ * columns_) return {i % columns_, i / columns_};
        // Column of point e of the last row: extra_before() is e for it and e + 1 for the next.
        const std::uint64_t e = i - rows_ * columns_;
        return {((e + 1) * columns_ - phase_ - 1) / rest_, rows_};
    }

    [[nodiscard]] std::uint64_t x_strip(std::uint64_t i) const {
        const auto [column, row] = cell(i);
        const std::uint64_t begin = column * rows_ + extra_before(column);
        const bool tall = extra_before(column + 1) > extra_before(column);
        const std::uint64_t strip =
            begin + (tall ? in_tall_columns_(column, row) : in_short_columns_(column, row)) + turn_;
        return strip < count_ ? strip : strip - count_;
    }

    [[nodiscard]] std::uint64_t y_strip(std::uint64_t i) const {
        const auto [column, row] = cell(i);
        const std::uint64_t begin = row * columns_;
        return begin + (row < rows_ ? in_rows_(row, column) : in_last_row_(i - begin));
    }

    std::uint64_t count_;
    std::uint64_t columns_;
    std::uint64_t rows_;  ///< number of full rows
    std::uint64_t rest_;  ///< number of points in the last, partial row; 0 if all are full
    std::uint64_t phase_ = 0;
    std::uint64_t turn_ = 0;
    PermutationFamily in_short_columns_;
    PermutationFamily in_tall_columns_;
    PermutationFamily in_rows_;
    Permutation in_last_row_;
};

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    return stratified_sequence(plan, style_of(options),
                               MultiJittered(plan, jitter_columns(plan.count, options)));
}

}  // namespace

Generator unit() {
    return {.name = "multi-jittered",
            .summary = "Multi-jittered points: one in each cell, and in each strip along both axes",
            .source =
                "Chiu, Shirley, Wang 1994, Graphics Gems IV, 370-374; counts other than a grid's: "
                "stipple's own",
            .traits = {.min_dimension = 2, .max_dimension = 2, .prefix = false},
            .options = Schema(shape_option, centered_option, order_option),
            .aliases = {"mj"},
            .plan = plan_jitter_grid,
            .sequence = make,
            .constants = column_constant};
}

}  // namespace stipple::generators::multi_jittered
