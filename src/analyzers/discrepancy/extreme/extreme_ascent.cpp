// SPDX-License-Identifier: MIT
#include "analyzers/discrepancy/extreme/extreme_ascent.hpp"

#include <algorithm>
#include <functional>

#include "analyzers/discrepancy/extreme/extreme_line.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"

namespace stipple::analyzers::extreme {
namespace {

/// One climb at a time from given boxes; keeps its buffers between climbs.
class Climber {
  public:
    /// Climbs end where they are when it is over, or after `most` comparisons.
    Climber(const BoxGrid& grid, std::uint64_t most, std::function<bool()> over)
        : grid_(grid), most_(most), over_(std::move(over)), outside_(grid.count) {}

    void climb(GridBox box, WorstBox& worst) {
        const std::uint64_t before = work_;
        box_ = std::move(box);
        worth_ = -static_cast<double>(grid_.scale + grid_.weight * grid_.count);
        count_outside();
        std::size_t idle = 0;  // axes in a row that gave nothing
        for (std::size_t axis = 0; idle < grid_.dimension();
             axis = (axis + 1) % grid_.dimension()) {
            idle = improve(axis) ? 0 : idle + 1;
            if (work_ - before > most_ || over_()) break;
        }
        worst.offer(box_);
    }

    /// Comparisons of coordinates until now.
    [[nodiscard]] std::uint64_t work() const { return work_; }

  private:
    void count_outside() {
        work_ += grid_.count * grid_.dimension();
        std::ranges::fill(outside_, 0U);
        for (std::size_t k = 0; k < grid_.dimension(); ++k)
            for (std::size_t i = 0; i < grid_.count; ++i)
                outside_[i] += box_.axes[k].contains(grid_.ranks[k][i], box_.side) ? 0U : 1U;
    }

    /// Moves the box to the worst interval of the axis; false if that gains nothing.
    bool improve(std::size_t axis) {
        work_ += 3 * grid_.count;
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
    std::uint64_t most_;
    std::function<bool()> over_;
    std::uint64_t work_ = 0;
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

Ascent ascend(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run) {
    constexpr std::uint64_t effort = 1U << 24;  // a fraction of a second
    constexpr std::uint64_t share = 8;          // of the work, at most
    constexpr std::uint64_t cost = 16;          // of a climb, in sizes, for both sides
    const std::uint64_t size = grid.count * grid.dimension();
    const std::uint64_t affordable = limits.work / (share * cost * size);
    const std::uint64_t wanted = std::clamp<std::uint64_t>(effort / size, 8, 200);
    const std::uint64_t starts = std::clamp<std::uint64_t>(affordable, 1, wanted);
    const std::uint64_t most = limits.work / (2 * share * starts);
    constexpr std::size_t together = 8;  // starts in one block
    Ascent all{WorstBox(grid), 0};
    std::vector<Ascent> found(block_count(starts, together), all);
    const auto over = [&] { return limits.over(run); };
    RunContext unstopped = run;  // climbs end by themselves, with what they found
    unstopped.stop = {};
    constexpr bool silent = true;
    for_each_block(
        unstopped, starts, together,
        [&](const Block& block) {
            Climber climber(grid, most, over);
            Ascent& mine = found[block.index];
            for (std::uint64_t start = block.first; start < block.last; ++start) {
                if (start > 0 && over()) break;  // one box there must be
                climber.climb(first_box(grid, Side::open, start), mine.worst);
                if (grid.measure == Measure::emptiness) continue;
                climber.climb(first_box(grid, Side::closed, start), mine.worst);
            }
            mine.work = climber.work();
        },
        silent);
    for (const Ascent& part : found) {
        all.worst.offer(part.worst);
        all.work += part.work;
    }
    return all;
}

}  // namespace stipple::analyzers::extreme
