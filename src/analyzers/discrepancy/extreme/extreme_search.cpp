// SPDX-License-Identifier: MIT
//
// Cells with the highest bounds are explored first, a few at a time, each depth first until its
// budget is used up; what is left goes back to the heap. Those few know of each other's finds only
// when all are done, so that what happens does not depend on the number of threads.

#include "analyzers/discrepancy/extreme/extreme_search.hpp"

#include <algorithm>
#include <optional>
#include <queue>

#include "analyzers/discrepancy/extreme/extreme_ascent.hpp"
#include "analyzers/discrepancy/extreme/extreme_cell.hpp"
#include "core/error.hpp"
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
    Explorer(const BoxGrid& grid, Task& task, std::uint64_t budget, const SearchLimits& limits,
             const RunContext& run)
        : grid_(grid), run_(run), limits_(limits), bounder_(grid), task_(task), budget_(budget) {
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
        if (before / often == task_.work / often) return;
        run_.check_stop();
        if (limits_.late(run_)) budget_ = 0;
    }

    const BoxGrid& grid_;
    const RunContext& run_;
    const SearchLimits& limits_;
    CellBounder bounder_;
    Task& task_;
    std::uint64_t budget_;
    std::vector<Line> lines_;  ///< of the cells on the way down to this one
};

struct LowerBound {
    bool operator()(const Cell& a, const Cell& b) const { return a.bound < b.bound; }
};

using Cells = std::priority_queue<Cell, std::vector<Cell>, LowerBound>;

class Search {
  public:
    Search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits, const RunContext& run,
           double upper)
        : grid_(grid),
          limits_(limits),
          run_(run),
          most_(std::max<std::uint64_t>(1U << 24, 256 * grid.count * grid.dimension())),
          worst_(std::move(worst)),
          upper_(upper) {
        cells_.push(whole_cell(grid, Side::open));
        if (grid.measure == Measure::discrepancy) cells_.push(whole_cell(grid, Side::closed));
    }

    SearchResult go() {
        while (!ending()) try {
                explore_some();
                settle();
            } catch (const Error& e) {
                if (e.kind() != ErrorKind::cancelled) throw;
                return {worst_, upper_, Ending::stopped};
            }
        return {worst_, upper_, *ending()};
    }

  private:
    [[nodiscard]] std::optional<Ending> ending() const {
        const double lower = worst_.value();
        if (cells_.empty()) return Ending::complete;
        if (limits_.tolerance > 0 && upper_ - lower <= limits_.tolerance * lower)
            return Ending::tolerance;
        if (work_ >= limits_.work) return Ending::work;
        if (limits_.late(run_)) return Ending::time;
        return {};
    }

    void explore_some() {
        constexpr std::size_t together = 16;
        const std::uint64_t budget = std::min(most_, limits_.work - work_);
        std::vector<Task> tasks;
        for (; tasks.size() < together && !cells_.empty(); cells_.pop())
            tasks.push_back({cells_.top(), worst_, {}, 0});
        constexpr bool silent = true;
        for_each_block(
            run_, tasks.size(), 1,
            [&](const Block& block) {
                Explorer(grid_, tasks[block.index], budget, limits_, run_).explore();
            },
            silent);
        for (Task& task : tasks) {
            work_ += task.work;
            worst_.offer(task.worst);
            for (Cell& cell : task.rest) cells_.push(std::move(cell));
        }
    }

    /// Says what is certain now.
    void settle() {
        const auto scale = static_cast<double>(grid_.scale);
        const double bound =
            cells_.empty() ? 0 : (cells_.top().bound + grid_.rounding()) * (1 + 0x1p-50) / scale;
        upper_ = std::max(worst_.value(), std::min(bound, upper_));
        report_gap(worst_.value(), upper_, run_);
        const auto bytes = static_cast<double>(sizeof(Cell) + grid_.dimension() * sizeof(Ends));
        run_.need_memory(static_cast<double>(cells_.size()) * bytes, "the open cells");
    }

    const BoxGrid& grid_;
    const SearchLimits& limits_;
    const RunContext& run_;
    std::uint64_t most_;  ///< work on a cell at a time
    WorstBox worst_;
    Cells cells_;
    double upper_;
    std::uint64_t work_ = 0;
};

}  // namespace

SearchResult search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                    const RunContext& run) {
    return Search(grid, std::move(worst), limits, run, 1).go();
}

SearchResult find_worst(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run,
                        double upper) {
    const Ascent first = ascend(grid, limits, run);
    if (limits.over(run))
        return {first.worst, upper, limits.late(run) ? Ending::time : Ending::stopped};
    const SearchLimits left = limits.after(first.work);
    return Search(grid, first.worst, left, run, upper).go();
}

}  // namespace stipple::analyzers::extreme
