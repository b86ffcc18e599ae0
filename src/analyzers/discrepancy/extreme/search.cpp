// SPDX-License-Identifier: MIT
#include "analyzers/discrepancy/extreme/search.hpp"

#include "analyzers/discrepancy/coordinate_ascent.hpp"
#include "analyzers/discrepancy/extreme/cell.hpp"

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

    void explore(Task& task) const override {
        CellBounder bounder(grid_, task.worst);
        Explorer(bounder, line_, task, limits_, run_).explore();
    }

  private:
    const BoxGrid& grid_;
    const Line line_;
    const SearchLimits& limits_;
    const RunContext& run_;
};

}  // namespace

double search_memory(const PointSet& points, unsigned threads) {
    // The lines on the way down to a cell halve in length about every 2 d steps.
    const auto d = static_cast<double>(points.dimension());
    const double lines = 3 * d + 2;
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

}  // namespace stipple::discrepancy::extreme
