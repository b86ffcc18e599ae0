// SPDX-License-Identifier: MIT
//
// Sums of products over all pairs of points, block by block. On some axes all points of one block
// come before those of another; what is known of two blocks as a whole is not worked out for each
// pair of their points.
#pragma once

#include <cstddef>
#include <vector>

#include "core/machine/vectors.hpp"
#include "math/arithmetic/double_double.hpp"
#include "stipple/run.hpp"

namespace stipple::l2 {

constexpr std::size_t block_width = 64;  ///< points of a block
constexpr std::size_t max_lanes = 8;     ///< of the widest vector

/// The factors of block_pair_kernels.hpp.
enum class PairForm { minimum, two_sided, bernoulli, linear, mixture, one_plus_minima };

/// What is the same for all points on the axis of a factor.
struct AxisConstants {
    double base = 0;
    double base_error = 0;
    double offset = 0;  ///< that the base has been raised by
    double vertex = 0;  ///< of the parabola in |x - y|, or its middle
};

/// Blocks of points, column after column in each; behind them one that is 1, and 0 where there are
/// no points. The more blocks lie beside each other on an axis, the less work.
class BlockTable {
  public:
    /// Least and greatest position of a block's points in the order of a factor's axis.
    struct Range {
        double least = 1;
        double greatest = -1;
    };

    /// @param any_order whether factors may be multiplied in an order other than theirs
    BlockTable(PairForm form, std::size_t count, std::vector<AxisConstants> factors,
               bool any_order);

    [[nodiscard]] PairForm form() const { return form_; }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] const std::vector<AxisConstants>& factors() const { return factors_; }
    [[nodiscard]] bool any_order() const { return any_order_; }
    [[nodiscard]] std::size_t height() const { return factors_.size() * columns_ + 1; }

    /// Writes a point's numbers for a factor, as many as the form has columns.
    void put(std::size_t i, std::size_t factor, const double* numbers, double position);

    [[nodiscard]] const double* block(std::size_t b) const {
        return lines_[b * height() * (block_width / max_lanes)].at;
    }
    [[nodiscard]] const Range& range(std::size_t b, std::size_t factor) const {
        return ranges_[b * factors_.size() + factor];
    }

  private:
    /// Doubles in one line of the cache, so that no vector lies across two.
    struct alignas(64) Line {
        double at[max_lanes] = {};
    };

    double& at(std::size_t i, std::size_t column);

    PairForm form_;
    std::size_t count_;
    std::vector<AxisConstants> factors_;
    bool any_order_;
    std::size_t columns_;  ///< of a factor
    std::vector<Line> lines_;
    std::vector<Range> ranges_;
};

/// Sum over all ordered pairs of points, the same for any number of threads and any vectors.
DoubleDouble sum_over_pairs(const BlockTable& table, Vectors widest, const RunContext& run);

}  // namespace stipple::l2
