// SPDX-License-Identifier: MIT
#include "math/discrepancy/extreme/search.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "math/discrepancy/coordinate_ascent.hpp"
#include "math/discrepancy/extreme/cell.hpp"
#include "math/discrepancy/star/search.hpp"

namespace stipple::discrepancy::extreme {
namespace {

class FreeBoxes final : public Problem {
  public:
    FreeBoxes(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run)
        : grid_(grid), line_(whole_line(grid)), limits_(limits), run_(run) {}

    [[nodiscard]] std::vector<Cell> all_cells() const override {
        std::vector<Cell> cells{whole_cell(grid_, Side::open)};
        if (grid_.measure == Measure::discrepancy) cells.push_back(whole_cell(grid_, Side::closed));
        return cells;
    }

    void explore(Task& task) const override { extreme::explore(grid_, line_, task, limits_, run_); }

  private:
    const BoxGrid& grid_;
    const Line line_;
    const SearchLimits& limits_;
    const RunContext& run_;
};

// The indicator function of a box is a signed sum of the indicator functions of up to 2^d anchored
// boxes, or 3^d - 1 on the torus: an interval is the difference of two intervals that begin at 0,
// plus the whole axis if it wraps, and the whole space has no discrepancy. So a multiple of the
// star discrepancy bounds the other discrepancies.

/// Grid for anchored boxes; on the torus, coordinates 1 become 0.
BoxGrid anchored_grid(const PointSet& points, Family family, const RunContext& run) {
    PointSet moved = points;
    if (family == Family::torus)
        for (double& x : moved.flat())
            if (x == 1) x = 0;
    return box_grid(moved, Family::anchored, run);
}

/// Upper bound on the ratio of a family's discrepancy to the star discrepancy, rounded up.
double factor(Family family, double dimension) {
    return (family == Family::cube ? std::pow(2, dimension) : std::pow(3, dimension) - 1) *
           (1 + 0x1p-50);
}

/// Upper bound from an upper bound of the star discrepancy, computed within a small part of the
/// search's work and time.
double star_bound(const PointSet& points, Family family, const SearchLimits& share,
                  const RunContext& run) {
    const auto d = static_cast<double>(points.dimension());
    const auto n = static_cast<double>(points.count());
    if (d < 2) return 1;
    const BoxGrid grid = anchored_grid(points, family, run);
    const double known = star::quick_bound(grid, run, factor(family, 1), factor(family, d));
    const double promised = 0.6 * std::sqrt(d / n);  // approximate value for random points
    if ((d > 2 && factor(family, d) * promised >= 1) || run.stop.stop_requested()) return known;
    const SearchResult found =
        d > 2 ? star::find_worst(grid, share, run) : star::sweep_2d(grid, share, run);
    return std::min(known, factor(family, d) * found.upper);
}

/// Limits for star_bound: a fraction of a long search, and little work if there is no deadline.
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

double search_memory(const PointSet& points, unsigned threads) {
    // From a cell to its parts, lines halve in length about every 2 d steps.
    const auto d = static_cast<double>(points.dimension());
    const double lines = std::min(3 * d + 2, 24.0);
    const double per_point = d * static_cast<double>(axis_bytes(false)) + 40 +
                             lines * static_cast<double>(sizeof(Entry) * threads);
    return static_cast<double>(points.count()) * per_point;
}

SearchResult search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                    const RunContext& run, double upper) {
    FreeBoxes problem(grid, limits, run);
    return branch_and_bound(problem, grid, {.worst = std::move(worst), .upper = upper}, limits, run,
                            nullptr);
}

SearchResult find_worst(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run,
                        double upper) {
    const Ascent first = ascend(grid, limits, run);
    return search(grid, first.worst, limits.after(first.work), run, upper);
}

SearchResult find_worst(const PointSet& points, const BoxGrid& grid, const SearchLimits& limits,
                        const RunContext& run) {
    const SearchLimits share = share_for_bound(limits, run);
    const double upper = star_bound(points, grid.family, share, silent(run));
    return find_worst(grid, limits.after(share.work), run, upper);
}

double quick_bound(const PointSet& points, Family family, const RunContext& run) {
    const BoxGrid grid = anchored_grid(points, family, unstopped(run));
    const auto d = static_cast<double>(points.dimension());
    return star::quick_bound(grid, run, factor(family, 1), factor(family, d));
}

}  // namespace stipple::discrepancy::extreme
