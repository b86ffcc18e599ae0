// SPDX-License-Identifier: MIT
#include "analyzers/discrepancy/star/star_scout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/large_pages.hpp"
#include "core/parallel.hpp"

namespace stipple::analyzers::star {
namespace {

using Place = std::array<std::uint32_t, 2>;

constexpr std::size_t checks_apart = 1 << 16;  // points between two looks at the stop token

/// How much a box is too empty or too full, in points.
double badness(Side side, double volume, double points) {
    return side == Side::open ? volume - points : points - volume;
}

/// The points in cells of as many places each, four points to a cell or more.
class Coarse {
  public:
    Coarse(const CornerGrid& grid, const RunContext& run)
        : grid_(grid), cells_(cells_along(grid.count)), points_(cells_ * cells_) {
        for (std::size_t i = 0; i < grid.count; ++i) {
            if (i % checks_apart == 0) run.check_stop();
            ++points_[cell(0, grid.ranks[0][i]) * cells_ + cell(1, grid.ranks[1][i])];
        }
        for (std::size_t c = 0; c < points_.size(); ++c)  // sums of rows, then of columns
            if (c % cells_ != 0) points_[c] += points_[c - 1];
        for (std::size_t c = cells_; c < points_.size(); ++c) points_[c] += points_[c - cells_];
    }

    /// The worst of the boxes that end where the cells do.
    [[nodiscard]] Place worst(Side side) const {
        Place worst{};
        double most = -1;
        for (std::size_t a = 0; a < cells_; ++a)
            for (std::size_t b = 0; b < cells_; ++b) {
                const Place corner{last_place(0, a), last_place(1, b)};
                const double volume = static_cast<double>(grid_.count) *
                                      grid_.values[0][corner[0]] * grid_.values[1][corner[1]];
                const double bad = badness(side, volume, points_[a * cells_ + b]);
                if (bad > most) worst = corner;
                most = std::max(most, bad);
            }
        return worst;
    }

  private:
    static std::size_t cells_along(std::size_t count) {
        constexpr double most = 256;
        const double root = std::sqrt(static_cast<double>(count)) / 2;
        return static_cast<std::size_t>(std::clamp(root, 1.0, most));
    }

    [[nodiscard]] std::size_t cell(std::size_t axis, std::uint32_t place) const {
        return place * cells_ / grid_.values[axis].size();
    }

    /// Of the places in a cell, and of those before if it has none.
    [[nodiscard]] std::uint32_t last_place(std::size_t axis, std::size_t cell) const {
        const std::size_t behind = ((cell + 1) * grid_.values[axis].size() + cells_ - 1) / cells_;
        return static_cast<std::uint32_t>(behind - 1);
    }

    const CornerGrid& grid_;
    std::size_t cells_;  ///< along each axis
    std::vector<std::uint32_t> points_;
};

struct Climb {
    Place corner;
    std::uint64_t points;  ///< in the box
    double badness;
};

/// Moves the corner along one axis to where its box is worst.
void improve(const CornerGrid& grid, Side side, std::size_t axis, Climb& climb,
             const RunContext& run) {
    const auto& ranks = grid.ranks[axis];
    const auto& others = grid.ranks[1 - axis];
    constexpr std::size_t ahead = 16;  // places are seldom in a cache
    const std::uint32_t end = climb.corner[1 - axis] + (side == Side::open ? 0 : 1);
    std::vector<std::uint32_t> points_at;
    fill_with_zeros(points_at, grid.values[axis].size());
    for (std::size_t i = 0; i < grid.count; ++i) {
        if (i % checks_apart == 0) run.check_stop();
        if (i + ahead < grid.count) __builtin_prefetch(&points_at[ranks[i + ahead]], 1);
        points_at[ranks[i]] += others[i] < end ? 1 : 0;
    }
    const double across =
        static_cast<double>(grid.count) * grid.values[1 - axis][climb.corner[1 - axis]];
    std::uint64_t below = 0;
    for (std::uint32_t place = 0; place < points_at.size(); ++place) {
        const std::uint64_t points = below + (side == Side::open ? 0 : points_at[place]);
        const double bad =
            badness(side, across * grid.values[axis][place], static_cast<double>(points));
        below += points_at[place];
        if (bad <= climb.badness) continue;
        climb.corner[axis] = place;
        climb.points = points;
        climb.badness = bad;
    }
}

void climb_from(const Place& from, const CornerGrid& grid, Side side, WorstBox& worst,
                const RunContext& run) {
    constexpr int rounds = 4;
    Climb climb{from, 0, -static_cast<double>(grid.count) - 1};
    double before = climb.badness;
    for (int round = 0; round < rounds; ++round) {
        improve(grid, side, 0, climb, run);
        improve(grid, side, 1, climb, run);
        if (climb.badness == std::exchange(before, climb.badness)) break;
    }
    worst.offer(side, climb.corner, climb.points);
}

}  // namespace

WorstBox scout(const CornerGrid& grid, const RunContext& run) {
    const Coarse coarse(grid, run);
    std::vector<WorstBox> worst(2, WorstBox(grid));
    constexpr bool silent = true;
    for_each_block(
        worth_threads(run, 1e-7 * static_cast<double>(grid.count)), 2, 1,
        [&](const Block& block) {
            const Side side = block.index == 0 ? Side::open : Side::closed;
            climb_from(coarse.worst(side), grid, side, worst[block.index], run);
        },
        silent);
    worst[0].offer(worst[1]);
    return worst[0];
}

}  // namespace stipple::analyzers::star
