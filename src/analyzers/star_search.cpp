// SPDX-License-Identifier: MIT
//
// Cells with the highest bounds are explored first, a few at a time, each depth first until its
// budget is used up; what is left goes back to the heap. Those few know of each other's finds only
// when all are done, so that what happens does not depend on the number of threads.
//
// Source  the bounds are this program's own; earlier exact methods are surveyed in C. Doerr,
//         M. Gnewuch, M. Wahlstroem, arXiv:1405.1653.

#include "analyzers/star_search.hpp"

#include <algorithm>
#include <queue>

#include "analyzers/star_cell.hpp"
#include "core/parallel.hpp"

namespace stipple::analyzers::star {
namespace {

using Logs = std::vector<std::vector<double>>;

/// A cell to explore, and what came of it.
struct Task {
    Cell cell;
    WorstBox worst;
    std::vector<Cell> rest;  ///< parts that are still open
    std::uint64_t work;
};

/// Explores the cell of a task depth first, within a budget.
template <Side side>
class Explorer {
  public:
    Explorer(const CornerGrid& grid, const Logs& logs, Task& task, std::uint64_t budget,
             const RunContext& run)
        : bounder_(grid, logs, task.worst, run), task_(task), budget_(budget) {
        points_.push_back(all_points(grid));
    }

    void explore() {
        descend(std::move(task_.cell), 0);
        task_.work = bounder_.work();
    }

  private:
    void descend(Cell cell, std::size_t depth) {
        if (bounder_.work() >= budget_ && depth > 0) {
            task_.rest.push_back(std::move(cell));
            return;
        }
        if (points_.size() < depth + 2) points_.resize(depth + 2);
        if (!bounder_.tighten(cell, points_[depth], points_[depth + 1])) return;
        const auto [axis, middle, below] = bounder_.split(cell);
        Cell upper = cell;
        upper.lo[axis] = middle;
        descend(std::move(upper), depth + 1);
        cell.hi[axis] = below;
        descend(std::move(cell), depth + 1);
    }

    CellBounder<side> bounder_;
    Task& task_;
    std::uint64_t budget_;
    std::vector<Active> points_;  ///< of the cells on the way down to this one
};

void explore(const CornerGrid& grid, const Logs& logs, Task& task, std::uint64_t budget,
             const RunContext& run) {
    if (task.cell.side == Side::open)
        Explorer<Side::open>(grid, logs, task, budget, run).explore();
    else
        Explorer<Side::closed>(grid, logs, task, budget, run).explore();
}

struct LowerBound {
    bool operator()(const Cell& a, const Cell& b) const { return a.bound < b.bound; }
};

std::size_t cell_bytes(const CornerGrid& grid) {
    return sizeof(Cell) + 2 * sizeof(std::uint32_t) * grid.dimension();
}

/// Progress is how much of the gap between the bounds is closed.
void report_gap(double lower, double upper, const RunContext& run) {
    constexpr std::uint64_t parts = 1'000'000;
    const double open = lower < 1 ? (upper - lower) / (1 - lower) : 0;
    run.tick(parts - static_cast<std::uint64_t>(open * static_cast<double>(parts)), parts);
}

}  // namespace

SearchResult search(const CornerGrid& grid, WorstBox worst, std::uint64_t max_work,
                    const RunContext& run) {
    constexpr std::size_t together = 16;
    const std::uint64_t size = grid.count * grid.dimension();
    const std::uint64_t budget = std::max(std::uint64_t{1} << 22, 16 * size);
    const Logs logs = logarithms(grid);
    std::priority_queue<Cell, std::vector<Cell>, LowerBound> cells;
    cells.push(whole_cell(grid, Side::open));
    cells.push(whole_cell(grid, Side::closed));
    std::uint64_t work = 0;
    double upper = 1;
    while (!cells.empty() && work < max_work) {
        std::vector<Task> tasks;
        for (; tasks.size() < together && !cells.empty(); cells.pop())
            tasks.push_back({cells.top(), worst, {}, 0});
        constexpr bool silent = true;
        for_each_block(
            run, tasks.size(), 1,
            [&](const Block& block) { explore(grid, logs, tasks[block.index], budget, run); },
            silent);
        for (Task& task : tasks) {
            work += task.work;
            worst.offer(task.worst);
            for (Cell& cell : task.rest) cells.push(std::move(cell));
        }
        upper = cells.empty() ? worst.value() : std::max(worst.value(), cells.top().bound);
        report_gap(worst.value(), upper, run);
        run.need_memory(static_cast<double>(cells.size() * cell_bytes(grid)), "the open cells");
    }
    return {worst, upper, cells.empty()};
}

}  // namespace stipple::analyzers::star
