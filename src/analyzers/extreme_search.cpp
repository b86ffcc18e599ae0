// SPDX-License-Identifier: MIT
//
// Cells with the highest bounds are explored first, a few at a time, each depth first until its
// budget is used up; what is left goes back to the heap. Those few know of each other's finds only
// when all are done, so that what happens does not depend on the number of threads.

#include "analyzers/extreme_search.hpp"

#include <algorithm>
#include <queue>

#include "analyzers/extreme_cell.hpp"
#include "core/parallel.hpp"

namespace stipple::analyzers::extreme {
namespace {

/// A cell to explore, and what came of it.
struct Task {
    Cell cell;
    WorstBox worst;
    std::vector<Cell> rest;  ///< parts that are still open
    std::uint64_t work;
};

/// Explores the cell of a task depth first, within a budget.
class Explorer {
  public:
    Explorer(const BoxGrid& grid, Task& task, std::uint64_t budget, const RunContext& run)
        : grid_(grid), run_(run), bounder_(grid), task_(task), budget_(budget) {
        lines_.push_back(whole_line(grid));
    }

    void explore() { descend(task_.cell, 0); }

  private:
    /// Looks at a part of the cell whose line is at this depth.
    void descend(Cell cell, std::size_t depth) {
        if (depth > 0 && task_.work >= budget_) {
            task_.rest.push_back(std::move(cell));
            return;
        }
        if (!trim(cell)) return;
        if (lines_.size() < depth + 2) lines_.resize(depth + 2);
        refine(grid_, cell, lines_[depth], lines_[depth + 1]);
        spend(lines_[depth].entries.size());
        Line& line = lines_[depth + 1];
        cell.bound = std::min(cell.bound, bounder_.bound(cell, line));
        if (cell.bound <= task_.worst.worth() - bounder_.rounding()) return;
        if (!bounder_.settle(cell, line, task_.worst)) return;
        bounder_.shorten(cell, task_.worst, line);
        auto [larger, smaller] = split(grid_, cell);
        descend(std::move(larger), depth + 1);
        descend(std::move(smaller), depth + 1);
    }

    /// Counts two comparisons for each point and axis.
    void spend(std::size_t points) {
        constexpr std::uint64_t often = 1U << 18;
        const std::uint64_t before = task_.work;
        task_.work += 2 * grid_.dimension() * (points + 1);
        if (before / often != task_.work / often) run_.check_stop();
    }

    const BoxGrid& grid_;
    const RunContext& run_;
    CellBounder bounder_;
    Task& task_;
    std::uint64_t budget_;
    std::vector<Line> lines_;  ///< of the cells on the way down to this one
};

struct LowerBound {
    bool operator()(const Cell& a, const Cell& b) const { return a.bound < b.bound; }
};

using Cells = std::priority_queue<Cell, std::vector<Cell>, LowerBound>;

/// Progress is how much of the gap between the bounds is closed.
void report_gap(double lower, double upper, const RunContext& run) {
    constexpr std::uint64_t parts = 1'000'000;
    const double open = lower < 1 ? std::min((upper - lower) / (1 - lower), 1.0) : 0;
    run.tick(parts - static_cast<std::uint64_t>(open * static_cast<double>(parts)), parts);
}

/// Explores a few cells; returns the work that it took.
std::uint64_t explore_some(const BoxGrid& grid, Cells& cells, WorstBox& worst, std::uint64_t budget,
                           const RunContext& run) {
    constexpr std::size_t together = 16;
    std::vector<Task> tasks;
    for (; tasks.size() < together && !cells.empty(); cells.pop())
        tasks.push_back({cells.top(), worst, {}, 0});
    constexpr bool silent = true;
    for_each_block(
        run, tasks.size(), 1,
        [&](const Block& block) { Explorer(grid, tasks[block.index], budget, run).explore(); },
        silent);
    std::uint64_t work = 0;
    for (Task& task : tasks) {
        work += task.work;
        worst.offer(task.worst);
        for (Cell& cell : task.rest) cells.push(std::move(cell));
    }
    return work;
}

}  // namespace

SearchResult search(const BoxGrid& grid, WorstBox worst, std::uint64_t max_work,
                    const RunContext& run) {
    const std::uint64_t most =
        std::max<std::uint64_t>(1U << 24, 256 * grid.count * grid.dimension());
    Cells cells;
    cells.push(whole_cell(grid, Side::open));
    if (grid.measure == Measure::discrepancy) cells.push(whole_cell(grid, Side::closed));
    const auto scale = static_cast<double>(grid.scale);
    const auto bytes = static_cast<double>(sizeof(Cell) + grid.dimension() * sizeof(Ends));
    std::uint64_t work = 0;
    double upper = 1;
    while (!cells.empty() && work < max_work) {
        work += explore_some(grid, cells, worst, std::min(most, max_work - work), run);
        upper = worst.value();
        if (!cells.empty())
            upper = std::clamp((cells.top().bound + grid.rounding()) * (1 + 0x1p-50) / scale, upper,
                               1.0);
        report_gap(worst.value(), upper, run);
        run.need_memory(static_cast<double>(cells.size()) * bytes, "the open cells");
    }
    return {worst, upper, cells.empty()};
}

}  // namespace stipple::analyzers::extreme
