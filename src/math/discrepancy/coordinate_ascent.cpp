// SPDX-License-Identifier: MIT
#include "math/discrepancy/coordinate_ascent.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "math/discrepancy/worst_interval.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple::discrepancy {
namespace {

/// Runs ascents from given boxes one at a time; reuses its buffers.
class BoxAscent {
  public:
    /// An ascent ends early if a limit is reached, or after `most` comparisons.
    BoxAscent(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run,
              std::uint64_t most = std::numeric_limits<std::uint64_t>::max())
        : grid_(grid), limits_(limits), run_(run), most_(most), outside_(grid.count) {}

    /// Ascends from `box` and returns the excess reached.
    double run(GridBox box, WorstBox& worst) {
        const std::uint64_t before = work_;
        box_ = std::move(box);
        count_outside();
        measure();
        std::size_t idle = 0;  // consecutive axes without improvement
        for (std::size_t axis = 0; idle < grid_.dimension();
             axis = (axis + 1) % grid_.dimension()) {
            idle = improve(axis) ? 0 : idle + 1;
            if (axis == 0) multiply();
            if (work_ - before > most_ || limits_.over(run_)) break;
        }
        worst.offer(box_, measure());
        return excess_;
    }

    /// Box in which the last ascent ended.
    [[nodiscard]] const GridBox& box() const { return box_; }

    /// Comparisons of coordinates so far.
    [[nodiscard]] std::uint64_t work() const { return work_; }

  private:
    struct Found {
        double excess;
        Interval interval;
    };

    void count_outside() {
        work_ += grid_.count * grid_.dimension();
        std::ranges::fill(outside_, 0U);
        for (std::size_t k = 0; k < grid_.dimension(); ++k) {
            const RankSet inside = grid_.inside(box_.axes[k], box_.side);
            for (std::size_t i = 0; i < grid_.count; ++i)
                outside_[i] += inside.contains(grid_.ranks[k][i]) ? 0U : 1U;
        }
    }

    /// Recomputes the volume, in which moves accumulate rounding errors.
    void multiply() {
        volume_ = 1;
        for (std::size_t k = 0; k < grid_.dimension(); ++k)
            volume_ *= grid_.length(k, box_.axes[k], box_.side);
    }

    /// Recomputes volume and excess; returns the number of points inside.
    std::uint64_t measure() {
        multiply();
        const auto inside = static_cast<std::uint64_t>(std::ranges::count(outside_, 0U));
        const double share = static_cast<double>(inside * grid_.weight);
        const double all = static_cast<double>(grid_.scale) * volume_;
        excess_ = box_.side == Side::open ? all - share : share - all;
        return inside;
    }

    /// Product of the box's lengths on all axes except one, by division if possible: in many
    /// dimensions, multiplying would take longer than counting the points.
    [[nodiscard]] double section(std::size_t axis) const {
        constexpr double tiny = 1e-280;
        if (volume_ > tiny) return volume_ / grid_.length(axis, box_.axes[axis], box_.side);
        double section = 1;
        for (std::size_t k = 0; k < grid_.dimension(); ++k)
            if (k != axis) section *= grid_.length(k, box_.axes[k], box_.side);
        return section;
    }

    /// Replaces the box's interval on the axis by the worst one; returns false if none is worse.
    bool improve(std::size_t axis) {
        work_ += 2 * grid_.count + grid_.values[axis].size();
        const auto& ranks = grid_.ranks[axis];
        const RankSet from = grid_.inside(box_.axes[axis], box_.side);
        points_at_.assign(grid_.values[axis].size(), 0);
        for (std::size_t i = 0; i < grid_.count; ++i)
            points_at_[ranks[i]] += outside_[i] == (from.contains(ranks[i]) ? 0U : 1U) ? 1U : 0U;
        const double across = section(axis);
        const double all = static_cast<double>(grid_.scale) * across;
        const auto [excess, interval] =
            grid_.anchored() ? worst_end(axis, all) : worst_ends(axis, all);
        const double noise = static_cast<double>(grid_.scale) * 1e-12 + grid_.rounding();
        if (excess - excess_ <= noise) return false;
        const RankSet to = grid_.inside(interval, box_.side);
        for (std::size_t i = 0; i < grid_.count; ++i) {
            outside_[i] += to.contains(ranks[i]) ? 0U : 1U;
            outside_[i] -= from.contains(ranks[i]) ? 0U : 1U;
        }
        box_.axes[axis] = interval;
        excess_ = excess;
        volume_ = across * grid_.length(axis, interval, box_.side);
        return true;
    }

    /// Worst interval that begins at 0. `all` is grid_.scale * section(axis).
    [[nodiscard]] Found worst_end(std::size_t axis, double all) const {
        const auto& values = grid_.values[axis];
        const auto weight = static_cast<double>(grid_.weight);
        Found worst{-std::numeric_limits<double>::infinity(), {}};
        std::uint64_t below = 0;
        for (std::uint32_t y = 0; y < values.size(); ++y) {
            const std::uint64_t up_to = below + points_at_[y];
            const double excess = box_.side == Side::open
                                      ? all * values[y] - weight * static_cast<double>(below)
                                      : weight * static_cast<double>(up_to) - all * values[y];
            if (excess > worst.excess) worst = {excess, {0, y}};
            below = up_to;
        }
        return worst;
    }

    /// Worst interval anywhere on the axis. `all` is the box's scaled volume per length along it.
    [[nodiscard]] Found worst_ends(std::size_t axis, double all) {
        const auto& values = grid_.values[axis];
        line_.clear();
        for (std::uint32_t y = 0; y < values.size(); ++y)
            line_.insert(line_.end(), points_at_[y], y);
        const auto weight = static_cast<double>(grid_.weight);
        const LineTerms<double> terms{.all = all,
                                      .weight = weight,
                                      .points = weight * static_cast<double>(line_.size()),
                                      .side = box_.side,
                                      .torus = grid_.torus()};
        const auto found = worst_interval(
            line_.size(), terms, [&](std::size_t i) { return all * values[line_[i]]; },
            [&](std::size_t i) { return weight * static_cast<double>(i); });
        const auto last = static_cast<std::uint32_t>(grid_.torus() ? 0 : values.size() - 1);
        return {found.excess,
                {found.lower == line_end ? 0 : line_[found.lower],
                 found.upper == line_end ? last : line_[found.upper]}};
    }

    const BoxGrid& grid_;
    const SearchLimits& limits_;
    const RunContext& run_;
    std::uint64_t most_;
    std::uint64_t work_ = 0;
    double volume_ = 1;
    double excess_ = 0;
    GridBox box_;
    std::vector<std::uint32_t> outside_;  ///< by point: number of axes on which it is outside
    /// By rank on the current axis: number of points that are inside on all other axes.
    std::vector<std::uint32_t> points_at_;
    std::vector<std::uint32_t> line_;  ///< ranks of points inside on all other axes, ascending
};

/// Maximum of the d uniform numbers of `rng` from index `first` on; for large d, one draw from the
/// distribution of this maximum.
double largest_of(std::size_t d, const Rng& rng, std::uint64_t first) {
    constexpr std::size_t many = 64;
    if (d > many) return real_power(rng.uniform(first), 1 / static_cast<double>(d));
    double most = 0;
    for (std::size_t j = 0; j < d; ++j) most = std::max(most, rng.uniform(first + j));
    return most;
}

/// Draws an anchored box with upper coordinates u^(1/d), u uniform, so that its volume is not tiny.
GridBox random_anchored_box(const BoxGrid& grid, Side side, std::uint64_t stream) {
    const std::size_t d = grid.dimension();
    const Rng rng(0, stream);
    GridBox box{.side = side, .axes = {}};
    for (std::size_t k = 0; k < d; ++k) {
        const double most = largest_of(d, rng, k * d);
        const auto& values = grid.values[k];
        const auto rank = std::ranges::lower_bound(values, most) - values.begin();
        box.axes.push_back({0, static_cast<std::uint32_t>(rank)});
    }
    return box;
}

/// Draws a random box. In many dimensions, random ends mostly give tiny volumes. So the open box of
/// stream 0 is the largest possible, and a closed box has two points as opposite corners.
GridBox random_free_box(const BoxGrid& grid, Side side, std::uint64_t stream) {
    const Rng rng(0, stream);
    const std::uint64_t one = rng.below(0, grid.count);
    const std::uint64_t other = rng.below(1, grid.count);
    GridBox box{.side = side, .axes = {}};
    for (std::size_t k = 0; k < grid.dimension(); ++k) {
        const auto ranks = static_cast<std::uint32_t>(grid.values[k].size());
        auto lower = static_cast<std::uint32_t>(rng.below(2 * k + 2, ranks));
        auto upper = static_cast<std::uint32_t>(rng.below(2 * k + 3, ranks));
        if (side == Side::closed) {
            lower = grid.ranks[k][one];
            upper = grid.ranks[k][other];
        } else if (stream == 0) {
            lower = 0;
            upper = grid.torus() ? 0 : ranks - 1;
        }
        if (!grid.torus() && lower > upper) std::swap(lower, upper);
        // An open interval of the cube needs two different ends.
        if (!grid.torus() && side == Side::open && lower == upper) lower == 0 ? ++upper : --lower;
        box.axes.push_back({lower, upper});
    }
    return box;
}

GridBox random_box(const BoxGrid& grid, Side side, std::uint64_t stream) {
    return grid.anchored() ? random_anchored_box(grid, side, stream)
                           : random_free_box(grid, side, stream);
}

/// Number of ascents, and the limit on the work of each.
struct Plan {
    std::uint64_t starts;
    std::uint64_t most;

    Plan(const BoxGrid& grid, const SearchLimits& limits) {
        constexpr std::uint64_t effort = 1U << 24;  // wanted starts * size: under a second of work
        const std::uint64_t size = grid.count * grid.dimension();
        constexpr std::uint64_t share = 8;    // ascents may use limits.work / share
        constexpr std::uint64_t ascent = 16;  // a start takes about ascent * size comparisons
        const std::uint64_t affordable = limits.work / (share * ascent * size);
        const std::uint64_t wanted = std::clamp<std::uint64_t>(effort / size, 8, 200);
        starts = std::clamp<std::uint64_t>(affordable, 1, wanted);
        most = limits.work / (2 * share * starts);
    }
};

/// Moves the corner of an anchored box by up to about an eighth of the ranks on two to four axes,
/// possibly on the same axis twice. Uses the numbers of `rng` from `drawn` on.
void perturb(const BoxGrid& grid, const Rng& rng, std::uint64_t drawn, GridBox& box) {
    const std::size_t d = grid.dimension();
    const std::uint64_t axes = 2 + rng.below(drawn, 3);
    for (std::uint64_t i = 0; i < axes; ++i) {
        const std::size_t axis = rng.below(drawn + 1 + 2 * i, d);
        const std::uint64_t last = grid.values[axis].size() - 1;
        const std::uint64_t reach = last / 8 + 1;
        std::uint32_t& end = box.axes[axis].upper;
        const std::uint64_t moved = end + rng.below(drawn + 2 + 2 * i, 2 * reach + 1);
        end = static_cast<std::uint32_t>(std::clamp(moved, reach, last + reach) - reach);
    }
}

constexpr std::uint64_t draws_of_a_perturbation = 9;

void walk(const BoxGrid& grid, BoxAscent& ascent, Side side, std::uint64_t number, WorstBox& worst,
          const SearchLimits& limits, const RunContext& run) {
    constexpr std::uint64_t effort = 1U << 23;
    const std::uint64_t size = grid.count * grid.dimension();
    const std::uint64_t steps = std::clamp<std::uint64_t>(effort / size, 4, 64);
    constexpr std::uint64_t other_streams = 1U << 20;  // above the streams of ascend()
    double here = ascent.run(random_anchored_box(grid, side, other_streams + number), worst);
    GridBox box = ascent.box();
    const Rng rng(1, number);
    for (std::uint64_t step = 0; step < steps && !limits.over(run); ++step) {
        GridBox next = box;
        perturb(grid, rng, step * draws_of_a_perturbation, next);
        const double reached = ascent.run(std::move(next), worst);
        const double left = 1 - static_cast<double>(step + 1) / static_cast<double>(steps);
        if (reached < here - 0.1 * left * here) continue;  // 0.1 was found by trial
        here = reached;
        box = ascent.box();
    }
}

}  // namespace

Ascent ascend(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run) {
    const Plan plan(grid, limits);
    constexpr std::size_t together = 4;  // starts per block
    Ascent all{WorstBox(grid), 0};
    std::vector<Ascent> found(block_count(plan.starts, together), all);
    const auto ascend_all = [&](const Block& block, Side side) {
        BoxAscent ascent(grid, limits, run, plan.most);
        Ascent& mine = found[block.index];
        for (std::uint64_t start = block.first; start < block.last; ++start) {
            if (start > 0 && limits.over(run)) break;  // start 0 always runs: a box is needed
            ascent.run(random_box(grid, side, start), mine.worst);
        }
        mine.work += ascent.work();
    };
    // The loop itself ignores stops: each ascent checks for a stop, and keeps its result.
    for_each_block(silent(unstopped(run)), plan.starts, together, [&](const Block& block) {
        ascend_all(block, Side::open);
        if (grid.measure == Measure::discrepancy) ascend_all(block, Side::closed);
    });
    for (const Ascent& part : found) {
        all.worst.offer(part.worst);
        all.work += part.work;
    }
    return all;
}

std::uint64_t accept_thresholds(const BoxGrid& grid, std::uint64_t round, WorstBox& worst,
                                const SearchLimits& limits, const RunContext& run) {
    constexpr std::size_t walks = 8;
    std::vector<WorstBox> found(walks, WorstBox(grid));
    std::vector<std::uint64_t> work(walks);
    for_each_block(silent(run), walks, 1, [&](const Block& block) {
        BoxAscent ascent(grid, limits, run);
        walk(grid, ascent, block.index % 2 == 0 ? Side::open : Side::closed,
             round * walks + block.index, found[block.index], limits, run);
        work[block.index] = ascent.work();
    });
    for (const WorstBox& box : found) worst.offer(box);
    return std::accumulate(work.begin(), work.end(), std::uint64_t{0});
}

}  // namespace stipple::discrepancy
