// SPDX-License-Identifier: MIT
#include "analyzers/l2/l2_meetings.hpp"

#include <algorithm>
#include <cstring>

#include "core/parallel.hpp"

// The vectors never leave a function that is not inlined.

namespace stipple::analyzers::l2 {
namespace {

constexpr std::size_t group = 4;      ///< points of rows that meet a block together
constexpr std::size_t together = 16;  ///< blocks whose sums are doubles

/// What is known of a block of rows and one of columns.
struct Pair {
    const double* rows = nullptr;
    const double* columns = nullptr;
    std::vector<Step> steps = {};
    bool full = true;  ///< no places without points
    // Of kernels that separate.
    std::vector<std::size_t> own_of_rows = {};
    std::vector<std::size_t> own_of_columns = {};
    Weights row_weights = {};
    Weights column_weights = {};
};

/// A kernel, by instructions of one width.
struct Work {
    void (*meet)(const Table&, const Pair&, Sums&);
    void (*weigh)(const Table&, const double*, const std::vector<std::size_t>&, Weights&);
    std::size_t columns;
    bool separates;
};

#define STIPPLE_LANES 4
namespace anywhere {
#include "analyzers/l2/l2_lanes.hpp"
}
#ifdef STIPPLE_PICKS_VECTORS
#define STIPPLE_FUSES
#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace fours {
#include "analyzers/l2/l2_lanes.hpp"
}
#pragma GCC pop_options
#undef STIPPLE_LANES
#define STIPPLE_LANES 8
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,prefer-vector-width=512")
namespace eights {
#include "analyzers/l2/l2_lanes.hpp"
}
#pragma GCC pop_options
#undef STIPPLE_FUSES
#endif
#undef STIPPLE_LANES

Work work_of(Form form, Vectors widest) {
    static const Vectors here = widest_vectors();
#ifdef STIPPLE_PICKS_VECTORS
    if (std::min(widest, here) == Vectors::eights) return eights::work_of(form);
    if (std::min(widest, here) == Vectors::fours) return fours::work_of(form);
#endif
    return anywhere::work_of(form);
}

Quad total_of(const Sums& sums) {
    DoubleDouble total;
    for (std::size_t l = 0; l < spread; ++l) total = total + exact_sum(sums.sum[l], sums.lost[l]);
    return Quad(total.high) + total.low;
}

/// Sums over pairs of a block's points with those of others.
class Rows {
  public:
    Rows(const Table& table, const Work& work, std::size_t block)
        : table_(table), work_(work), block_(block) {
        pair_.rows = table.block(block);
    }

    /// With blocks [first, last).
    Quad sum_with(std::size_t first, std::size_t last, const RunContext& run) {
        Sums sums;
        for (std::size_t b = first; b < last; ++b) {
            run.check_stop();
            meet_as_blocks(b);
            work_.meet(table_, pair_, sums);
        }
        return total_of(sums);
    }

  private:
    /// Finds what holds for all points of the two blocks.
    void meet_as_blocks(std::size_t b) {
        pair_.columns = table_.block(b);
        pair_.full = (std::max(block_, b) + 1) * block_width <= table_.count();
        pair_.steps.clear();
        pair_.own_of_rows.clear();
        pair_.own_of_columns.clear();
        for (std::size_t f = 0; f < table_.factors().size(); ++f) {
            const Range& rows = table_.range(block_, f);
            const Range& columns = table_.range(b, f);
            const Lie lie = table_.form() == Form::around ? lie_around(rows, columns)
                                                          : lie_in_order(rows, columns);
            if (work_.separates && lie == Lie::below)
                pair_.own_of_rows.push_back(f);
            else if (work_.separates && lie == Lie::above)
                pair_.own_of_columns.push_back(f);
            else if (lie != Lie::apart)
                pair_.steps.push_back({f, lie});
        }
        if (work_.separates) {
            work_.weigh(table_, table_.block(block_), pair_.own_of_rows, pair_.row_weights);
            work_.weigh(table_, pair_.columns, pair_.own_of_columns, pair_.column_weights);
        } else if (pair_.steps.empty()) {
            pair_.steps.push_back({0, Lie::mixed});
        }
        // The first is worked out as if nothing were known.
        const auto is_mixed = [](const Step& step) { return step.lie == Lie::mixed; };
        const auto mixed = std::ranges::find_if(pair_.steps, is_mixed);
        if (mixed != pair_.steps.end()) std::iter_swap(pair_.steps.begin(), mixed);
    }

    const Table& table_;
    const Work& work_;
    std::size_t block_;
    Pair pair_;
};

}  // namespace

Table::Table(Form form, std::size_t count, std::vector<AxisConstants> factors)
    : form_(form), count_(count), factors_(std::move(factors)) {
    columns_ = work_of(form, Vectors::anywhere).columns;
    const std::size_t blocks = block_count(count, block_width);
    numbers_.resize(blocks * height() * (block_width / spread));
    ranges_.resize(blocks * factors_.size());
    for (std::size_t i = 0; i < count; ++i) at(i, height() - 1) = 1;
}

void Table::put(std::size_t i, std::size_t factor, const double* numbers, double place) {
    for (std::size_t c = 0; c < columns_; ++c) at(i, factor * columns_ + c) = numbers[c];
    Range& range = ranges_[i / block_width * factors_.size() + factor];
    range.least = std::min(range.least, place);
    range.greatest = std::max(range.greatest, place);
}

double& Table::at(std::size_t i, std::size_t column) {
    const std::size_t line = (i / block_width * height() + column) * (block_width / spread);
    return numbers_[line + i % block_width / spread].at[i % spread];
}

Quad sum_over_pairs(const Table& table, Vectors widest, const RunContext& run) {
    const Work work = work_of(table.form(), widest);
    std::vector<Quad> totals(block_count(table.count(), block_width));
    for_each_block(run, table.count(), block_width, [&](const Block& block) {
        Rows rows(table, work, block.index);
        Quad below = 0;
        for (std::size_t b = 0; b < block.index; b += together)
            below += rows.sum_with(b, std::min<std::size_t>(b + together, block.index), run);
        totals[block.index] = 2 * below + rows.sum_with(block.index, block.index + 1, run);
    });
    Quad total = 0;
    for (const Quad& part : totals) total += part;
    return total;
}

}  // namespace stipple::analyzers::l2
