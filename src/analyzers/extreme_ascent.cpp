// SPDX-License-Identifier: MIT
#include "analyzers/extreme_ascent.hpp"

#include <algorithm>

#include "analyzers/extreme_line.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"

namespace stipple::analyzers::extreme {
namespace {

/// One climb at a time from given boxes; keeps its buffers between climbs.
class Climber {
  public:
    Climber(const BoxGrid& grid, const RunContext& run)
        : grid_(grid), run_(run), outside_(grid.count) {}

    void climb(GridBox box, WorstBox& worst) {
        box_ = std::move(box);
        worth_ = -static_cast<double>(grid_.scale + grid_.weight * grid_.count);
        count_outside();
        std::size_t idle = 0;  // axes in a row that gave nothing
        for (std::size_t axis = 0; idle < grid_.dimension();
             axis = (axis + 1) % grid_.dimension()) {
            run_.check_stop();
            idle = improve(axis) ? 0 : idle + 1;
        }
        worst.offer(box_);
    }

  private:
    void count_outside() {
        std::ranges::fill(outside_, 0U);
        for (std::size_t k = 0; k < grid_.dimension(); ++k)
            for (std::size_t i = 0; i < grid_.count; ++i)
                outside_[i] += box_.axes[k].contains(grid_.ranks[k][i], box_.side) ? 0U : 1U;
    }

    /// Moves the box to the worst interval of the axis; false if that gains nothing.
    bool improve(std::size_t axis) {
        const auto& ranks = grid_.ranks[axis];
        const Interval from = box_.axes[axis];
        const auto elsewhere = [&](std::uint32_t i, Interval interval) {
            return interval.contains(ranks[i], box_.side) ? 0U : 1U;
        };
        line_.clear();
        for (const std::uint32_t i : grid_.order[axis])
            if (outside_[i] == elsewhere(i, from)) line_.push_back(ranks[i]);
        const auto [worth, to] = worst_on(axis);
        const double gain = worth - worth_;
        if (gain <= static_cast<double>(grid_.scale) * 1e-12 + grid_.rounding()) return false;
        worth_ = worth;
        for (std::uint32_t i = 0; i < grid_.count; ++i)
            outside_[i] += elsewhere(i, to) - elsewhere(i, from);
        box_.axes[axis] = to;
        return true;
    }

    [[nodiscard]] std::pair<double, Interval> worst_on(std::size_t axis) const {
        const auto& values = grid_.values[axis];
        auto all = static_cast<double>(grid_.scale);
        for (std::size_t k = 0; k < grid_.dimension(); ++k)
            if (k != axis) all *= length(grid_, k, box_.axes[k], box_.side);
        const auto weight = static_cast<double>(grid_.weight);
        const LineLaw<double> law{.all = all,
                                  .weight = weight,
                                  .points = weight * static_cast<double>(line_.size()),
                                  .side = box_.side,
                                  .space = grid_.space};
        const auto found = worst_interval(
            line_.size(), law, [&](std::size_t i) { return all * values[line_[i]]; },
            [&](std::size_t i) { return weight * static_cast<double>(i); });
        const auto last = grid_.space == Space::torus ? 0 : values.size() - 1;
        return {found.worth,
                {found.lower == line_end ? 0 : line_[found.lower],
                 found.upper == line_end ? static_cast<std::uint32_t>(last) : line_[found.upper]}};
    }

    const BoxGrid& grid_;
    const RunContext& run_;
    GridBox box_;
    double worth_ = 0;
    std::vector<std::uint32_t> outside_;  ///< for each point, axes on which it is outside
    std::vector<std::uint32_t> line_;     ///< places on an axis of points inside on the others
};

/// Where a climb starts: an open box between any places, the first one as large as can be, as most
/// have no volume to speak of in many dimensions; a closed one around two points, for the same
/// reason.
GridBox first_box(const BoxGrid& grid, Side side, std::uint64_t stream) {
    const Rng rng(0, stream);
    const bool cube = grid.space == Space::cube;
    const std::uint64_t one = rng.below(0, grid.count);
    const std::uint64_t other = rng.below(1, grid.count);
    GridBox box{.side = side, .axes = {}};
    for (std::size_t k = 0; k < grid.dimension(); ++k) {
        const auto places = static_cast<std::uint32_t>(grid.values[k].size());
        auto lower = static_cast<std::uint32_t>(rng.below(2 * k + 2, places));
        auto upper = static_cast<std::uint32_t>(rng.below(2 * k + 3, places));
        if (side == Side::closed) {
            lower = grid.ranks[k][one];
            upper = grid.ranks[k][other];
        } else if (stream == 0) {
            lower = 0;
            upper = cube ? places - 1 : 0;
        }
        if (cube && lower > upper) std::swap(lower, upper);
        // On the cube an open interval needs two ends.
        if (cube && side == Side::open && lower == upper) lower == 0 ? ++upper : --lower;
        box.axes.push_back({lower, upper});
    }
    return box;
}

}  // namespace

WorstBox ascend(const BoxGrid& grid, const RunContext& run) {
    constexpr std::uint64_t effort = 1U << 24;  // a fraction of a second
    const std::uint64_t starts =
        std::clamp<std::uint64_t>(effort / (grid.count * grid.dimension()), 8, 200);
    constexpr std::size_t together = 8;  // starts in one block
    std::vector<WorstBox> found(block_count(starts, together), WorstBox(grid));
    constexpr bool silent = true;
    for_each_block(
        run, starts, together,
        [&](const Block& block) {
            Climber climber(grid, run);
            for (std::uint64_t start = block.first; start < block.last; ++start) {
                climber.climb(first_box(grid, Side::open, start), found[block.index]);
                if (grid.measure == Measure::emptiness) continue;
                climber.climb(first_box(grid, Side::closed, start), found[block.index]);
            }
        },
        silent);
    WorstBox worst(grid);
    for (const WorstBox& box : found) worst.offer(box);
    return worst;
}

}  // namespace stipple::analyzers::extreme
