// SPDX-License-Identifier: MIT
#include "analyzers/discrepancy/extreme/extreme_discrepancy.hpp"

#include <cmath>

#include "analyzers/discrepancy/extreme/extreme_cell.hpp"
#include "analyzers/discrepancy/extreme/extreme_search.hpp"
#include "analyzers/discrepancy/star/star_blocks.hpp"
#include "analyzers/discrepancy/star/star_search.hpp"
#include "analyzers/discrepancy/star/star_sweep.hpp"

namespace stipple::analyzers::extreme {

double search_memory(const PointSet& points, unsigned threads) {
    // The lines on the way down to a cell halve in length every few steps.
    constexpr double lines = 24;
    const double per_point = static_cast<double>(points.dimension() * axis_bytes) + 40 +
                             lines * static_cast<double>(sizeof(Entry) * threads);
    return static_cast<double>(points.count()) * per_point;
}

namespace {

/// The points, and on the torus those at 1 moved to 0.
PointSet on_space(const PointSet& points, Space space) {
    PointSet moved = points;
    if (space == Space::torus)
        for (double& x : moved.flat())
            if (x == 1) x = 0;
    return moved;
}

/// How many boxes from the origin a box is the sum and difference of. An interval is one from 0
/// less another; on the torus, if it wraps, the whole axis is added, and the whole space has no
/// discrepancy.
double boxes_on_cube(double dimension) { return std::pow(2, dimension); }
double boxes_on_torus(double dimension) { return std::pow(3, dimension) - 1; }

constexpr std::uint64_t few_corners = 1U << 18;

/// Goes on when a stop is requested.
double block_bound(const star::CornerGrid& grid, Space space, std::uint64_t corners,
                   const RunContext& run) {
    RunContext unstopped = run;
    unstopped.stop = {};
    const auto boxes = space == Space::cube ? boxes_on_cube : boxes_on_torus;
    return star::block_bound(grid, corners, unstopped, boxes);
}

/// An upper bound from the star discrepancies of the points and of their coordinates on a few axes.
double star_bound(const PointSet& points, Space space, const SearchLimits& limits,
                  const RunContext& run) {
    const auto d = static_cast<double>(points.dimension());
    const auto n = static_cast<double>(points.count());
    if (d < 2) return 1;
    const auto boxes = space == Space::cube ? boxes_on_cube : boxes_on_torus;
    const star::CornerGrid grid = star::corner_grid(on_space(points, space), run);
    const double known = block_bound(grid, space, std::min(few_corners, limits.work / 64), run);
    const double promised = 0.6 * std::sqrt(d / n);  // of random points, about
    const bool cheap = points.dimension() == 2;
    if ((!cheap && boxes(d) * promised >= known) || run.stop.stop_requested()) return known;
    double bound = 1;
    if (points.dimension() == 2) {
        const star::Sweep sweep = star::sweep_2d(grid, limits, run);
        if (sweep.complete) bound = sweep.worst.value();
    } else {
        bound = star::find_worst(grid, limits, run).upper;
    }
    return std::min(known, boxes(d) * bound * (1 + 0x1p-50));
}

/// What that bound may take: little of a long search, nothing to speak of where no end is set.
SearchLimits share_for_bound(const SearchLimits& limits, const RunContext& run) {
    constexpr double part = 0.1;
    constexpr std::uint64_t short_work = 1U << 27;
    SearchLimits share{.work = limits.work / 10, .deadline = limits.deadline, .tolerance = 0.05};
    if (limits.timed())
        share.deadline = run.seconds() + part * (limits.deadline - run.seconds());
    else
        share.work = std::min(share.work, short_work);
    return share;
}

}  // namespace

double quick_bound(const PointSet& points, Space space, const RunContext& run) {
    RunContext unstopped = run;
    unstopped.stop = {};
    const star::CornerGrid grid = star::corner_grid(on_space(points, space), unstopped);
    return block_bound(grid, space, few_corners, unstopped);
}

Findings discrepancy(const PointSet& points, Space space, const SearchLimits& limits,
                     const RunContext& run) {
    run.need_memory(search_memory(points, run.thread_count()), "the search for the worst box");
    const BoxGrid grid = box_grid(points, space, Measure::discrepancy, run);
    const SearchLimits share = share_for_bound(limits, run);
    RunContext silent = run;
    silent.progress = {};
    const double upper = star_bound(points, space, share, silent);
    const SearchResult found = find_worst(grid, limits.after(share.work), run, upper);
    const WorstBox& worst = found.worst;
    Report box;
    box.add("lower_corner", worst.lower_corner());
    box.add("corner", worst.upper_corner());
    box.add("closed", worst.box().side == Side::closed);
    box.add("points", worst.points());
    box.add("volume", worst.volume());
    Report results;
    results.add("value", worst.value());
    results.add("lower", worst.value());
    results.add("upper", found.upper);
    results.add("exact", found.upper == worst.value());
    results.add("method", grid.dimension() == 1 ? "sweep-1d" : "branch-and-bound");
    results.add("worst_box", std::move(box));
    return {std::move(results), {worst.value(), found.upper, found.ending}};
}

}  // namespace stipple::analyzers::extreme
