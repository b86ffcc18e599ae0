// SPDX-License-Identifier: MIT
#include "analyzers/discrepancy/star/star_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "analyzers/discrepancy/star/star_cover.hpp"

namespace stipple::analyzers::star {
namespace {

/// Points at each place of an axis.
std::vector<std::uint32_t> points_at(const CornerGrid& grid, std::size_t axis) {
    std::vector<std::uint32_t> points(grid.values[axis].size());
    for (const std::uint32_t place : grid.ranks[axis]) ++points[place];
    return points;
}

/// The discrepancy of the points' coordinates on an axis, or a little more.
double axis_bound(const CornerGrid& grid, std::size_t axis) {
    const auto n = static_cast<double>(grid.count);
    const auto points = points_at(grid, axis);
    double below = 0;
    double worst = 0;
    for (std::size_t a = 0; a < points.size(); ++a) {
        const double x = grid.values[axis][a];
        worst = std::max(worst, x - below / n);
        below += points[a];
        worst = std::max(worst, below / n - x);
    }
    return worst + 0x1p-50;
}

CornerGrid part_of(const CornerGrid& grid, std::size_t first, std::size_t last) {
    CornerGrid part{.count = grid.count, .values = {}, .ranks = {}};
    for (std::size_t k = first; k < last; ++k) {
        part.values.push_back(grid.values[k]);
        part.ranks.push_back(grid.ranks[k]);
    }
    return part;
}

/// A box that is whole on all axes but one.
struct Slab {
    double value = -1;
    std::uint32_t place = 0;  ///< where it ends on that one
    std::uint64_t points = 0;

    void take(const Slab& other) {
        if (other.value > value) *this = other;
    }
};

/// The worst slabs across an axis: an open and a closed one. Points in `at_end` have a coordinate
/// 1, so that they are in no open one.
std::array<Slab, 2> worst_slabs(const CornerGrid& grid, std::size_t axis,
                                const std::vector<bool>& at_end) {
    const auto n = static_cast<double>(grid.count);
    const auto points = points_at(grid, axis);
    std::vector<std::uint32_t> inside(points.size());
    for (std::size_t i = 0; i < grid.count; ++i)
        if (!at_end[i]) ++inside[grid.ranks[axis][i]];
    std::array<Slab, 2> worst;
    std::uint64_t below = 0;
    std::uint64_t within = 0;
    for (std::uint32_t a = 0; a < points.size(); ++a) {
        const double x = grid.values[axis][a];
        worst[0].take({x - static_cast<double>(below) / n, a, below});
        below += inside[a];
        within += points[a];
        worst[1].take({static_cast<double>(within) / n - x, a, within});
    }
    return worst;
}

/// The bound from those of the blocks.
double joined(const std::vector<double>& blocks) {
    if (blocks.size() == 1) return blocks[0];
    const auto m = static_cast<double>(blocks.size());
    const double full = (1 - 1 / m) * std::pow(m, -1 / (m - 1)) + std::ranges::max(blocks);
    const double empty =
        std::pow(1 - 1 / m, m) + std::accumulate(blocks.begin(), blocks.end(), 0.0);
    return std::max(full, empty) * (1 + 0x1p-48);
}

/// The bound from m blocks of neighbouring axes.
double bound_of(const CornerGrid& grid, std::size_t m, std::uint64_t most_corners,
                const RunContext& run, Factor factor) {
    const std::size_t d = grid.dimension();
    std::vector<double> blocks;
    for (std::size_t b = 0; b < m; ++b) {
        const std::size_t first = b * d / m;
        const std::size_t last = (b + 1) * d / m;
        const double star = last - first == 1
                                ? axis_bound(grid, first)
                                : cover_bound(part_of(grid, first, last), most_corners / m, run);
        blocks.push_back(factor(static_cast<double>(last - first)) * star);
    }
    return joined(blocks);
}

}  // namespace

double block_bound(const CornerGrid& grid, std::uint64_t most_corners, const RunContext& run,
                   Factor factor) {
    constexpr std::size_t most_together = 4;  // covers of more axes are coarse
    const std::size_t d = grid.dimension();
    double least = std::min(1.0, bound_of(grid, d, most_corners, run, factor));
    if (most_corners == 0) return least;
    for (std::size_t size = 2; size <= std::min(d, most_together); ++size)
        least = std::min(least, bound_of(grid, (d + size - 1) / size, most_corners, run, factor));
    if (d > most_together) least = std::min(least, bound_of(grid, 1, most_corners, run, factor));
    return least;
}

double quick_bound(const CornerGrid& grid, const RunContext& run) {
    constexpr std::uint64_t few_corners = 1U << 17;
    constexpr std::size_t many_numbers = 1U << 21;
    const bool many = grid.count * grid.dimension() > many_numbers;
    const Factor one = [](double) { return 1.0; };
    RunContext unstopped = run;
    unstopped.stop = {};
    return block_bound(grid, many ? 0 : few_corners, unstopped, one);
}

void offer_slabs(const CornerGrid& grid, WorstBox& worst) {
    std::vector<bool> at_end(grid.count);
    Corner whole;
    for (std::size_t k = 0; k < grid.dimension(); ++k) {
        whole.push_back(static_cast<std::uint32_t>(grid.values[k].size() - 1));
        for (std::size_t i = 0; i < grid.count; ++i)
            if (grid.ranks[k][i] == whole[k]) at_end[i] = true;
    }
    for (std::size_t k = 0; k < grid.dimension(); ++k) {
        Corner corner = whole;
        const auto [open, closed] = worst_slabs(grid, k, at_end);
        corner[k] = open.place;
        worst.offer(Side::open, corner, open.points);
        corner[k] = closed.place;
        worst.offer(Side::closed, corner, closed.points);
    }
}

}  // namespace stipple::analyzers::star
