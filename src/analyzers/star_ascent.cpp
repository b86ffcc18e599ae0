// SPDX-License-Identifier: MIT
#include "analyzers/star_ascent.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "core/rng.hpp"

namespace stipple::analyzers::star {
namespace {

/// One climb at a time from given corners; keeps its buffers between climbs.
class Climber {
  public:
    Climber(const CornerGrid& grid, Side side, const RunContext& run)
        : grid_(grid), side_(side), run_(run), outside_(grid.count) {}

    void climb(Corner corner, WorstBox& worst) {
        corner_ = std::move(corner);
        count_outside();
        std::size_t idle = 0;  // axes in a row that gave nothing
        for (std::size_t axis = 0; idle < grid_.dimension(); axis = (axis + 1) % corner_.size()) {
            run_.check_stop();
            idle = improve(axis) ? 0 : idle + 1;
        }
        const auto inside = std::ranges::count(outside_, 0U);
        worst.offer(side_, corner_, static_cast<std::uint64_t>(inside));
    }

  private:
    /// Whether a place is outside a box that ends at `end` on the same axis.
    [[nodiscard]] bool beyond(std::uint32_t place, std::uint32_t end) const {
        return side_ == Side::open ? place >= end : place > end;
    }

    void count_outside() {
        std::ranges::fill(outside_, 0U);
        for (std::size_t k = 0; k < corner_.size(); ++k)
            for (std::size_t i = 0; i < grid_.count; ++i)
                outside_[i] += beyond(grid_.ranks[k][i], corner_[k]) ? 1U : 0U;
    }

    /// Moves the corner to the best place on the axis; false if it is there already.
    bool improve(std::size_t axis) {
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
    Corner corner_;
    std::vector<std::uint32_t> outside_;    ///< for each point, axes on which it is outside
    std::vector<std::uint32_t> points_at_;  ///< inside on the other axes, at each place of this one
};

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

}  // namespace

WorstBox ascend(const CornerGrid& grid, const RunContext& run) {
    constexpr std::uint64_t effort = 1U << 24;  // a fraction of a second
    const std::uint64_t starts =
        std::clamp<std::uint64_t>(effort / (grid.count * grid.dimension()), 8, 200);
    constexpr std::size_t together = 8;  // starts in one block
    std::vector<WorstBox> found(block_count(starts, together), WorstBox(grid));
    constexpr bool silent = true;
    for_each_block(
        run, starts, together,
        [&](const Block& block) {
            for (const Side side : {Side::open, Side::closed}) {
                Climber climber(grid, side, run);
                for (std::uint64_t start = block.first; start < block.last; ++start)
                    climber.climb(random_corner(grid, start), found[block.index]);
            }
        },
        silent);
    WorstBox worst(grid);
    for (const WorstBox& box : found) worst.offer(box);
    return worst;
}

}  // namespace stipple::analyzers::star
