// SPDX-License-Identifier: MIT
//
// Sums over all pairs of points of products with corrections: blocks of points meet, and what is
// known of two blocks as a whole is not worked out for each pair of their points.
#pragma once

#include <cstddef>
#include <vector>

#include "analyzers/l2/l2_blocks.hpp"
#include "analyzers/l2/l2_carried.hpp"
#include "analyzers/l2/l2_terms.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::l2 {

/// The kernels of l2_lanes.hpp.
enum class Form {
    least,
    least_carried,
    around,
    bend,
    bend_fine,
    bend_shifted,
    bend_shifted_fine,
    mixture,
    mixture_fine,
    excess
};

/// Blocks of points, column after column in each; behind them one that is 1, and 0 where there are
/// no points. The fewer blocks lie across each other on an axis, the less work.
class Table {
  public:
    Table(Form form, std::size_t count, std::vector<AxisConstants> factors);

    [[nodiscard]] Form form() const { return form_; }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] const std::vector<AxisConstants>& factors() const { return factors_; }
    [[nodiscard]] std::size_t height() const { return factors_.size() * columns_ + 1; }

    /// Writes the numbers of a factor of a point, as many as the form has columns for it.
    /// @param place in the order of the factor's axis
    void put(std::size_t i, std::size_t factor, const double* numbers, double place);

    [[nodiscard]] const double* block(std::size_t b) const {
        return numbers_[b * height() * (block_width / spread)].at;
    }
    [[nodiscard]] const Range& range(std::size_t b, std::size_t factor) const {
        return ranges_[b * factors_.size() + factor];
    }

  private:
    double& at(std::size_t i, std::size_t column);

    Form form_;
    std::size_t count_;
    std::vector<AxisConstants> factors_;
    std::size_t columns_;  ///< of a factor
    std::vector<Line> numbers_;
    std::vector<Range> ranges_;  ///< of places
};

/// Sum over all ordered pairs of points, the same for any number of threads and any vectors.
Quad sum_over_pairs(const Table& table, Vectors widest, const RunContext& run);

}  // namespace stipple::analyzers::l2
