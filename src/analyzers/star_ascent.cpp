// SPDX-License-Identifier: MIT
#include "analyzers/star_ascent.hpp"

#include <algorithm>
#include <numeric>

#include "core/parallel.hpp"
#include "core/rng.hpp"

namespace stipple::analyzers::star {

/// One climb at a time from given corners; keeps its buffers between climbs.
class Climber {
  public:
    Climber(const CornerGrid& grid, Side side, const RunContext& run)
        : grid_(grid), side_(side), run_(run), outside_(grid.count) {}

    /// Gives how bad the box is that it reaches.
    double climb(Corner corner, WorstBox& worst) {
        corner_ = std::move(corner);
        count_outside();
        std::size_t idle = 0;  // axes in a row that gave nothing
        for (std::size_t axis = 0; idle < grid_.dimension(); axis = (axis + 1) % corner_.size()) {
            run_.check_stop();
            idle = improve(axis) ? 0 : idle + 1;
        }
        const auto inside = std::ranges::count(outside_, 0U);
        worst.offer(side_, corner_, static_cast<std::uint64_t>(inside));
        double volume = 1;
        for (std::size_t k = 0; k < corner_.size(); ++k) volume *= grid_.values[k][corner_[k]];
        const double share = static_cast<double>(inside) / static_cast<double>(grid_.count);
        return side_ == Side::open ? volume - share : share - volume;
    }

    /// Where the last climb ended.
    [[nodiscard]] const Corner& corner() const { return corner_; }

    /// Comparisons of coordinates until now.
    [[nodiscard]] std::uint64_t work() const { return work_; }

  private:
    /// Whether a place is outside a box that ends at `end` on the same axis.
    [[nodiscard]] bool beyond(std::uint32_t place, std::uint32_t end) const {
        return side_ == Side::open ? place >= end : place > end;
    }

    void count_outside() {
        work_ += grid_.count * corner_.size();
        std::ranges::fill(outside_, 0U);
        for (std::size_t k = 0; k < corner_.size(); ++k)
            for (std::size_t i = 0; i < grid_.count; ++i)
                outside_[i] += beyond(grid_.ranks[k][i], corner_[k]) ? 1U : 0U;
    }

    /// Moves the corner to the best place on the axis; false if it is there already.
    bool improve(std::size_t axis) {
        work_ += 2 * grid_.count + grid_.values[axis].size();
        const auto& ranks = grid_.ranks[axis];
        const std::uint32_t from = corner_[axis];
        points_at_.assign(grid_.values[axis].size(), 0);
        for (std::size_t i = 0; i < grid_.count; ++i)
            points_at_[ranks[i]] += outside_[i] == (beyond(ranks[i], from) ? 1U : 0U) ? 1U : 0U;
        const std::uint32_t to = best_place(axis);
        if (to == from) return false;
        for (std::size_t i = 0; i < grid_.count; ++i) {
            outside_[i] += beyond(ranks[i], to) ? 1U : 0U;
            outside_[i] -= beyond(ranks[i], from) ? 1U : 0U;
        }
        corner_[axis] = to;
        return true;
    }

    /// The place where a box with the corner's other coordinates is worst; the present one if that
    /// is as good.
    [[nodiscard]] std::uint32_t best_place(std::size_t axis) const {
        const auto& values = grid_.values[axis];
        const double n = static_cast<double>(grid_.count);
        double area = 1;
        for (std::size_t k = 0; k < corner_.size(); ++k)
            if (k != axis) area *= grid_.values[k][corner_[k]];
        std::uint32_t best = corner_[axis];
        double highest = -2;
        double here = -2;
        std::uint64_t below = 0;
        for (std::uint32_t y = 0; y < values.size(); ++y) {
            const std::uint64_t up_to = below + points_at_[y];
            const double value = side_ == Side::open
                                     ? area * values[y] - static_cast<double>(below) / n
                                     : static_cast<double>(up_to) / n - area * values[y];
            if (value > highest) {
                highest = value;
                best = y;
            }
            if (y == corner_[axis]) here = value;
            below = up_to;
        }
        return here >= highest ? corner_[axis] : best;
    }

    const CornerGrid& grid_;
    Side side_;
    const RunContext& run_;
    std::uint64_t work_ = 0;
    Corner corner_;
    std::vector<std::uint32_t> outside_;    ///< for each point, axes on which it is outside
    std::vector<std::uint32_t> points_at_;  ///< inside on the other axes, at each place of this one
};

namespace {

/// Each coordinate is distributed as u^(1/d), so that the box's volume is not tiny.
Corner random_corner(const CornerGrid& grid, std::uint64_t stream) {
    const std::size_t d = grid.dimension();
    const Rng rng(0, stream);
    Corner corner;
    for (std::size_t k = 0; k < d; ++k) {
        double most = 0;
        for (std::size_t j = 0; j < d; ++j) most = std::max(most, rng.uniform(k * d + j));
        const auto& values = grid.values[k];
        const auto place = std::ranges::lower_bound(values, most) - values.begin();
        corner.push_back(static_cast<std::uint32_t>(place));
    }
    return corner;
}

/// Moves the corner a bit on two to four axes, one of them maybe twice; the first of `drawn`
/// numbers of the generator are used.
void shake(const CornerGrid& grid, const Rng& rng, std::uint64_t drawn, Corner& corner) {
    const std::size_t d = grid.dimension();
    const std::uint64_t axes = 2 + rng.below(drawn, 3);
    for (std::uint64_t i = 0; i < axes; ++i) {
        const std::size_t axis = rng.below(drawn + 1 + 2 * i, d);
        const std::uint64_t last = grid.values[axis].size() - 1;
        const std::uint64_t reach = last / 8 + 1;
        const std::uint64_t moved = corner[axis] + rng.below(drawn + 2 + 2 * i, 2 * reach + 1);
        corner[axis] = static_cast<std::uint32_t>(std::clamp(moved, reach, last + reach) - reach);
    }
}

constexpr std::uint64_t draws_of_a_shake = 9;

}  // namespace

void BoxHunt::walk(Climber& climber, std::uint64_t number, WorstBox& worst,
                   const Late& late) const {
    constexpr std::uint64_t effort = 1U << 23;
    const std::uint64_t size = grid_.count * grid_.dimension();
    const std::uint64_t steps = std::clamp<std::uint64_t>(effort / size, 4, 64);
    constexpr std::uint64_t other_streams = 1U << 20;  // than those of ascend()
    double here = climber.climb(random_corner(grid_, other_streams + number), worst);
    Corner corner = climber.corner();
    const Rng rng(1, number);
    for (std::uint64_t step = 0; step < steps && !(late && late()); ++step) {
        Corner next = corner;
        shake(grid_, rng, step * draws_of_a_shake, next);
        const double reached = climber.climb(std::move(next), worst);
        const double left = 1 - static_cast<double>(step + 1) / static_cast<double>(steps);
        if (reached < here - 0.1 * left * here) continue;  // the first threshold found by trial
        here = reached;
        corner = climber.corner();
    }
}

std::uint64_t BoxHunt::go(WorstBox& worst, const RunContext& run, const Late& late) {
    constexpr std::size_t chains = 8;
    std::vector<WorstBox> found(chains, WorstBox(grid_));
    std::vector<std::uint64_t> work(chains);
    constexpr bool silent = true;
    for_each_block(
        run, chains, 1,
        [&](const Block& block) {
            Climber climber(grid_, block.index % 2 == 0 ? Side::open : Side::closed, run);
            walk(climber, round_ * chains + block.index, found[block.index], late);
            work[block.index] = climber.work();
        },
        silent);
    ++round_;
    for (const WorstBox& box : found) worst.offer(box);
    return std::accumulate(work.begin(), work.end(), std::uint64_t{0});
}

WorstBox ascend(const CornerGrid& grid, const RunContext& run, const Late& late) {
    constexpr std::uint64_t effort = 1U << 24;  // a fraction of a second
    const std::uint64_t starts =
        std::clamp<std::uint64_t>(effort / (grid.count * grid.dimension()), 8, 200);
    constexpr std::size_t together = 4;  // starts in one block
    std::vector<WorstBox> found(block_count(starts, together), WorstBox(grid));
    const auto climb_all = [&](const Block& block, Side side) {
        Climber climber(grid, side, run);
        for (std::uint64_t start = block.first; start < block.last; ++start) {
            if (start > 0 && late && late()) return;  // one box there must be
            climber.climb(random_corner(grid, start), found[block.index]);
        }
    };
    constexpr bool silent = true;
    for_each_block(
        run, starts, together,
        [&](const Block& block) {
            climb_all(block, Side::open);
            climb_all(block, Side::closed);
        },
        silent);
    WorstBox worst(grid);
    for (const WorstBox& box : found) worst.offer(box);
    return worst;
}

}  // namespace stipple::analyzers::star
