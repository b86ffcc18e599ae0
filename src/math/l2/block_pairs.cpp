// SPDX-License-Identifier: MIT
#include "math/l2/block_pairs.hpp"

#include <algorithm>
#include <cstring>
#include <span>

#include "core/parallel.hpp"

// The ABI of vectors does not matter here: they are passed only between inlined functions.

namespace stipple::l2 {
namespace {

constexpr std::size_t group = 4;        ///< number of rows that are processed together
constexpr std::size_t batch_size = 16;  ///< blocks summed in lanes before adding to the total

/// Property of a factor that all pairs of points of two blocks share.
enum class Known {
    nothing,
    of_rows,     ///< depends only on the row's point: the rows come first on its axis
    of_columns,  ///< depends only on the column's point: the columns come first
    one          ///< equals 1: the blocks are on different sides of 1/2
};

/// Known property of a factor, for a kernel that depends on the order of two points.
Known known_in_order(const BlockTable::Range& rows, const BlockTable::Range& columns) {
    if (rows.greatest <= columns.least) return Known::of_rows;
    return columns.greatest <= rows.least ? Known::of_columns : Known::nothing;
}

/// Known property of a factor of the centered kernel: 1 if 1/2 is between the two blocks.
Known known_by_side(const BlockTable::Range& rows, const BlockTable::Range& columns) {
    const bool apart = std::min(rows.greatest, columns.greatest) <= 0.5 &&
                       std::max(rows.least, columns.least) >= 0.5;
    return apart ? Known::one : Known::nothing;
}

/// Products of the factors that depend on a single point, for a block's points; 0 for padding.
struct PointProducts {
    alignas(64) double value[block_width];
    alignas(64) double error[block_width];
};

struct LaneSums {
    double sum[max_lanes] = {};
    double error[max_lanes] = {};
};

/// A block of rows and a block of columns, with the factors sorted by Known.
struct BlockPair {
    const double* rows = nullptr;
    const double* columns = nullptr;
    std::vector<std::size_t> factors = {};  ///< factors that differ between pairs of points
    bool full = true;                       ///< neither block has padding
    // The following are used only by kernels whose factors can depend on one point of a pair.
    std::vector<std::size_t> row_factors = {};
    std::vector<std::size_t> column_factors = {};
    PointProducts row_products = {};
    PointProducts column_products = {};
};

/// A kernel, compiled for one vector width.
struct PairKernel {
    void (*add_pairs)(const BlockTable&, const BlockPair&, LaneSums&);
    void (*multiply_own)(const BlockTable&, const double*, const std::vector<std::size_t>&,
                         PointProducts&);
    std::size_t columns;
    bool separates;
};

#define STIPPLE_KERNELS "math/l2/block_pair_kernels.hpp"
#include "core/machine/vector_widths.hpp"

PairKernel kernel_of(PairForm form, Vectors widest) {
    return pick_vectors(&anywhere::kernel_for, &fours::kernel_for, &eights::kernel_for,
                        widest)(form);
}

DoubleDouble total_of(const LaneSums& sums) {
    DoubleDouble total;
    for (std::size_t l = 0; l < max_lanes; ++l)
        total = total + exact_sum(sums.sum[l], sums.error[l]);
    return total;
}

/// A block of rows, for sums over the pairs of its points with the points of other blocks.
class Rows {
  public:
    Rows(const BlockTable& table, const PairKernel& kernel, std::size_t block)
        : table_(table), kernel_(kernel), block_(block) {
        pair_.rows = table.block(block);
    }

    /// Sum over the pairs with the points of blocks [first, last).
    DoubleDouble sum_with(std::size_t first, std::size_t last, const RunContext& run) {
        LaneSums sums;
        for (std::size_t b = first; b < last; ++b) {
            run.check_stop();
            compare_with(b);
            kernel_.add_pairs(table_, pair_, sums);
        }
        return total_of(sums);
    }

  private:
    [[nodiscard]] Known known(std::size_t b, std::size_t factor) const {
        const auto& rows = table_.range(block_, factor);
        const auto& columns = table_.range(b, factor);
        if (table_.form() == PairForm::two_sided) return known_by_side(rows, columns);
        if (!kernel_.separates || !table_.any_order()) return Known::nothing;
        return known_in_order(rows, columns);
    }

    /// Sorts the factors by their Known property for the pair of this block with block b.
    void compare_with(std::size_t b) {
        pair_.columns = table_.block(b);
        pair_.full = (std::max(block_, b) + 1) * block_width <= table_.count();
        pair_.factors.clear();
        pair_.row_factors.clear();
        pair_.column_factors.clear();
        for (std::size_t f = 0; f < table_.factors().size(); ++f) {
            const Known what = known(b, f);
            if (what == Known::of_rows) pair_.row_factors.push_back(f);
            if (what == Known::of_columns) pair_.column_factors.push_back(f);
            if (what == Known::nothing) pair_.factors.push_back(f);
        }
        if (kernel_.separates) {
            kernel_.multiply_own(table_, pair_.rows, pair_.row_factors, pair_.row_products);
            kernel_.multiply_own(table_, pair_.columns, pair_.column_factors,
                                 pair_.column_products);
        } else if (pair_.factors.empty()) {
            pair_.factors.push_back(0);
        }
    }

    const BlockTable& table_;
    const PairKernel& kernel_;
    std::size_t block_;
    BlockPair pair_;
};

}  // namespace

BlockTable::BlockTable(PairForm form, std::size_t count, std::vector<AxisConstants> factors,
                       bool any_order)
    : form_(form),
      count_(count),
      factors_(std::move(factors)),
      any_order_(any_order),
      columns_(kernel_of(form, Vectors::anywhere).columns) {
    const std::size_t blocks = block_count(count, block_width);
    lines_.resize(blocks * height() * (block_width / max_lanes));
    ranges_.resize(blocks * factors_.size());
    for (std::size_t i = 0; i < count; ++i) at(i, height() - 1) = 1;
}

void BlockTable::put(std::size_t i, std::size_t factor, const double* numbers, double position) {
    for (std::size_t c = 0; c < columns_; ++c) at(i, factor * columns_ + c) = numbers[c];
    Range& range = ranges_[i / block_width * factors_.size() + factor];
    range.least = std::min(range.least, position);
    range.greatest = std::max(range.greatest, position);
}

double& BlockTable::at(std::size_t i, std::size_t column) {
    const std::size_t line = (i / block_width * height() + column) * (block_width / max_lanes);
    return lines_[line + i % block_width / max_lanes].at[i % max_lanes];
}

DoubleDouble sum_over_pairs(const BlockTable& table, Vectors widest, const RunContext& run) {
    const PairKernel kernel = kernel_of(table.form(), widest);
    std::vector<DoubleDouble> totals(block_count(table.count(), block_width));
    for_each_block(run, table.count(), block_width, [&](const Block& block) {
        Rows rows(table, kernel, block.index);
        DoubleDouble below;
        for (std::size_t b = 0; b < block.index; b += batch_size)
            below =
                below + rows.sum_with(b, std::min<std::size_t>(b + batch_size, block.index), run);
        totals[block.index] = below + below + rows.sum_with(block.index, block.index + 1, run);
    });
    DoubleDouble total;
    for (const DoubleDouble& part : totals) total = total + part;
    return total;
}

}  // namespace stipple::l2
