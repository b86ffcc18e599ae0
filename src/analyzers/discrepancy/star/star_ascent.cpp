// SPDX-License-Identifier: MIT
#include "analyzers/discrepancy/star/star_ascent.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "core/parallel.hpp"
#include "core/rng.hpp"

namespace stipple::analyzers::star {

/// Whether it is time to end.
using Late = std::function<bool()>;

/// One climb at a time from given corners; keeps its buffers between climbs.
class Climber {
  public:
    /// Climbs end where they are when `late` says so or, each, after `most` comparisons.
    Climber(const CornerGrid& grid, Side side, Late late,
            std::uint64_t most = std::numeric_limits<std::uint64_t>::max())
        : grid_(grid), side_(side), late_(std::move(late)), most_(most), outside_(grid.count) {}

    /// Gives how bad the box is that it reaches.
    double climb(Corner corner, WorstBox& worst) {
        const std::uint64_t before = work_;
        corner_ = std::move(corner);
        count_outside();
        std::size_t idle = 0;  // axes in a row that gave nothing
        for (std::size_t axis = 0; idle < grid_.dimension(); axis = (axis + 1) % corner_.size()) {
            if (axis == 0) measure();
            idle = improve(axis) ? 0 : idle + 1;
            if (work_ - before > most_ || late_()) break;
        }
        const auto inside = std::ranges::count(outside_, 0U);
        worst.offer(side_, corner_, static_cast<std::uint64_t>(inside));
        measure();
        const double share = static_cast<double>(inside) / static_cast<double>(grid_.count);
        return side_ == Side::open ? volume_ - share : share - volume_;
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

    /// The box's volume anew, without the rounding of all the moves.
    void measure() {
        volume_ = 1;
        for (std::size_t k = 0; k < corner_.size(); ++k) volume_ *= grid_.values[k][corner_[k]];
    }

    /// Volume of the box on the other axes. In many dimensions a product each time would take
    /// longer than the counting.
    [[nodiscard]] double area(std::size_t axis) const {
        constexpr double tiny = 1e-280;
        if (volume_ > tiny) return volume_ / grid_.values[axis][corner_[axis]];
        double area = 1;
        for (std::size_t k = 0; k < corner_.size(); ++k)
            if (k != axis) area *= grid_.values[k][corner_[k]];
        return area;
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
        const double across = area(axis);
        const std::uint32_t to = best_place(axis, across);
        if (to == from) return false;
        for (std::size_t i = 0; i < grid_.count; ++i) {
            outside_[i] += beyond(ranks[i], to) ? 1U : 0U;
            outside_[i] -= beyond(ranks[i], from) ? 1U : 0U;
        }
        corner_[axis] = to;
        volume_ = across * grid_.values[axis][to];
        return true;
    }

    /// The place where a box with the corner's other coordinates is worst; the present one if that
    /// is as good.
    [[nodiscard]] std::uint32_t best_place(std::size_t axis, double area) const {
        const auto& values = grid_.values[axis];
        const double n = static_cast<double>(grid_.count);
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
    Late late_;
    std::uint64_t most_;
    std::uint64_t work_ = 0;
    double volume_ = 1;
    Corner corner_;
    std::vector<std::uint32_t> outside_;    ///< for each point, axes on which it is outside
    std::vector<std::uint32_t> points_at_;  ///< inside on the other axes, at each place of this one
};

namespace {

/// The largest of d numbers of the generator, those from `first` on; of so many it takes one, drawn
/// by the law of the largest.
double largest_of(std::size_t d, const Rng& rng, std::uint64_t first) {
    constexpr std::size_t many = 64;
    if (d > many) return std::pow(rng.uniform(first), 1 / static_cast<double>(d));
    double most = 0;
    for (std::size_t j = 0; j < d; ++j) most = std::max(most, rng.uniform(first + j));
    return most;
}

/// Each coordinate is distributed as u^(1/d), so that the box's volume is not tiny.
Corner random_corner(const CornerGrid& grid, std::uint64_t stream) {
    const std::size_t d = grid.dimension();
    const Rng rng(0, stream);
    Corner corner;
    for (std::size_t k = 0; k < d; ++k) {
        const double most = largest_of(d, rng, k * d);
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
                   const std::function<bool()>& late) const {
    constexpr std::uint64_t effort = 1U << 23;
    const std::uint64_t size = grid_.count * grid_.dimension();
    const std::uint64_t steps = std::clamp<std::uint64_t>(effort / size, 4, 64);
    constexpr std::uint64_t other_streams = 1U << 20;  // than those of ascend()
    double here = climber.climb(random_corner(grid_, other_streams + number), worst);
    Corner corner = climber.corner();
    const Rng rng(1, number);
    for (std::uint64_t step = 0; step < steps && !late(); ++step) {
        Corner next = corner;
        shake(grid_, rng, step * draws_of_a_shake, next);
        const double reached = climber.climb(std::move(next), worst);
        const double left = 1 - static_cast<double>(step + 1) / static_cast<double>(steps);
        if (reached < here - 0.1 * left * here) continue;  // the first threshold found by trial
        here = reached;
        corner = climber.corner();
    }
}

std::uint64_t BoxHunt::go(WorstBox& worst, const SearchLimits& limits, const RunContext& run) {
    constexpr std::size_t chains = 8;
    const Late late = [&] { return limits.over(run); };
    std::vector<WorstBox> found(chains, WorstBox(grid_));
    std::vector<std::uint64_t> work(chains);
    constexpr bool silent = true;
    for_each_block(
        run, chains, 1,
        [&](const Block& block) {
            Climber climber(grid_, block.index % 2 == 0 ? Side::open : Side::closed, late);
            walk(climber, round_ * chains + block.index, found[block.index], late);
            work[block.index] = climber.work();
        },
        silent);
    ++round_;
    for (const WorstBox& box : found) worst.offer(box);
    return std::accumulate(work.begin(), work.end(), std::uint64_t{0});
}

namespace {

/// How many climbs a set is worth, and how much each may cost.
struct Plan {
    std::uint64_t starts;
    std::uint64_t most;

    Plan(const CornerGrid& grid, const SearchLimits& limits, bool hinted) {
        constexpr std::uint64_t effort = 1U << 24;  // a fraction of a second
        const std::uint64_t size = grid.count * grid.dimension();
        constexpr std::uint64_t share = 8;   // of the work, at most
        constexpr std::uint64_t climb = 16;  // what one costs, in sizes, for both sides
        const std::uint64_t affordable = limits.work / (share * climb * size);
        starts = std::clamp<std::uint64_t>(effort / size, 8, 200) / (hinted ? 8 : 1);
        starts = std::clamp<std::uint64_t>(starts, 1, std::max<std::uint64_t>(affordable, 1));
        most = limits.work / (2 * share * starts);
    }
};

/// Where the corner of another set's box is among these places, or next to it above.
Corner corner_near(const CornerGrid& grid, const std::vector<double>& like) {
    Corner corner;
    for (std::size_t k = 0; k < grid.dimension(); ++k) {
        const auto& values = grid.values[k];
        const auto at = std::ranges::lower_bound(values, like[k]) - values.begin();
        corner.push_back(static_cast<std::uint32_t>(at));
    }
    return corner;
}

}  // namespace

Ascent ascend(const CornerGrid& grid, const SearchLimits& limits, const RunContext& run,
              const Hint* hint) {
    const Plan plan(grid, limits, hint != nullptr);
    constexpr std::size_t together = 4;  // starts in one block
    Ascent all{WorstBox(grid), 0};
    std::vector<Ascent> found(block_count(plan.starts, together), all);
    const Late late = [&] { return limits.over(run); };
    const auto climb_all = [&](const Block& block, Side side) {
        Climber climber(grid, side, late, plan.most);
        Ascent& mine = found[block.index];
        if (hint && block.index == 0 && hint->side == side)
            climber.climb(corner_near(grid, hint->corner), mine.worst);
        for (std::uint64_t start = block.first; start < block.last; ++start) {
            if (start > 0 && late()) break;  // one box there must be
            climber.climb(random_corner(grid, start), mine.worst);
        }
        mine.work += climber.work();
    };
    RunContext unstopped = run;  // climbs end by themselves, with what they found
    unstopped.stop = {};
    constexpr bool silent = true;
    for_each_block(
        unstopped, plan.starts, together,
        [&](const Block& block) {
            climb_all(block, Side::open);
            climb_all(block, Side::closed);
        },
        silent);
    for (const Ascent& part : found) {
        all.worst.offer(part.worst);
        all.work += part.work;
    }
    return all;
}

}  // namespace stipple::analyzers::star
