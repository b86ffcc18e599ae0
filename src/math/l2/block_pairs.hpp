// SPDX-License-Identifier: MIT
//
// Sums of products over all pairs of points, block by block. On some axes all points of one block
// come before those of another. The factors of such an axis are computed once for each point,
// instead of for each pair of points.
#pragma once

#include <cstddef>
#include <vector>

#include "core/machine/vectors.hpp"
#include "math/arithmetic/double_double.hpp"
#include "stipple/run.hpp"

namespace stipple::l2 {

constexpr std::size_t block_width = 64;  ///< points per block
constexpr std::size_t max_lanes = 8;     ///< doubles in the widest vector

/// Kernels of block_pair_kernels.hpp.
enum class PairForm { minimum, two_sided, bernoulli, linear, mixture, one_plus_minima };

/// Constants of a factor, the same for all points.
struct AxisConstants {
    double base = 0;
    double base_error = 0;
    double offset = 0;  ///< part of `base` that is subtracted again from the factor
    double vertex = 0;  ///< |x - y| at a parabola's vertex, or at mid-range for linear factors
};

/// Blocks of points, stored by column; the last column is 1 for points and 0 for padding. Work is
/// saved on each axis on which two blocks are separated.
class BlockTable {
  public:
    /// Smallest and largest position of a block's points on the axis of a factor.
    struct Range {
        double least = 1;
        double greatest = -1;
    };

    /// @param any_order true if factors may be multiplied in any order
    BlockTable(PairForm form, std::size_t count, std::vector<AxisConstants> factors,
               bool any_order);

    [[nodiscard]] PairForm form() const { return form_; }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] const std::vector<AxisConstants>& factors() const { return factors_; }
    [[nodiscard]] bool any_order() const { return any_order_; }
    [[nodiscard]] std::size_t height() const { return factors_.size() * columns_ + 1; }

    /// Stores the numbers of point i for a factor, one per column; `position` extends the block's
    /// range.
    void put(std::size_t i, std::size_t factor, const double* numbers, double position);

    [[nodiscard]] const double* block(std::size_t b) const {
        return lines_[b * height() * (block_width / max_lanes)].at;
    }
    [[nodiscard]] const Range& range(std::size_t b, std::size_t factor) const {
        return ranges_[b * factors_.size() + factor];
    }

  private:
    /// A cache line of doubles; vectors aligned to it never span two lines.
    struct alignas(64) Line {
        double at[max_lanes] = {};
    };

    double& at(std::size_t i, std::size_t column);

    PairForm form_;
    std::size_t count_;
    std::vector<AxisConstants> factors_;
    bool any_order_;
    std::size_t columns_;  ///< columns per factor
    std::vector<Line> lines_;
    std::vector<Range> ranges_;
};

/// Sum over all ordered pairs of points; the same for any number of threads and any vector width.
DoubleDouble sum_over_pairs(const BlockTable& table, Vectors widest, const RunContext& run);

}  // namespace stipple::l2
