// SPDX-License-Identifier: MIT
#include "analyzers/extreme_discrepancy.hpp"

#include "analyzers/extreme_cell.hpp"
#include "analyzers/extreme_search.hpp"

namespace stipple::analyzers::extreme {

double search_memory(const PointSet& points, unsigned threads) {
    // The lines on the way down to a cell halve in length every few steps.
    constexpr double lines = 24;
    const double per_point = static_cast<double>(points.dimension() * axis_bytes) + 40 +
                             lines * static_cast<double>(sizeof(Entry) * threads);
    return static_cast<double>(points.count()) * per_point;
}

Findings discrepancy(const PointSet& points, Space space, const SearchLimits& limits,
                     const RunContext& run) {
    run.need_memory(search_memory(points, run.thread_count()), "the search for the worst box");
    const BoxGrid grid = box_grid(points, space, Measure::discrepancy, run);
    const SearchResult found = find_worst(grid, limits, run);
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
