// SPDX-License-Identifier: MIT
//
// Branch and bound over cells: sets of boxes. Each round explores several cells with the highest
// bounds. It splits a cell depth first until the bounds of its parts are at most a target, which
// lies between the known lower and upper bound, or until the cell's work budget is used up.
// Remaining parts become open cells again. So the upper bound falls steadily, and cells needed only
// for an exact result are explored last. Cells of a round share results only at its end, so the
// search does not depend on the number of threads.
//
// Peer processes divide the cells of a round among themselves and then exchange the results, so
// that all have the same state before the next round. All other work is done by every peer. Without
// peers, a process explores all cells itself.
#pragma once

#include <deque>
#include <vector>

#include "core/peers.hpp"
#include "math/discrepancy/box_grid.hpp"
#include "math/discrepancy/search_limits.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy {

/// Set of open or closed boxes, given by ranges lo[i] to hi[i]; each Problem defines their meaning.
struct Cell {
    Side side;
    double bound;  ///< upper bound on the values of its boxes
    std::vector<std::uint32_t> lo;
    std::vector<std::uint32_t> hi;
};

struct Task {
    Cell cell;
    WorstBox worst;
    double target;             ///< parts with bounds <= target are left for later rounds
    std::uint64_t budget;      ///< limit on `work`
    std::vector<Cell> rest{};  ///< parts not yet explored
    std::uint64_t work = 0;
};

/// Proven bounds during a search.
struct Known {
    WorstBox worst;
    double upper = 1;
    std::uint64_t work = 0;  ///< comparisons of coordinates so far
};

/// Interface to a family of boxes to search.
class Problem {
  public:
    Problem() = default;
    Problem(const Problem&) = delete;
    Problem& operator=(const Problem&) = delete;
    virtual ~Problem() = default;

    /// Cells that together contain all boxes.
    [[nodiscard]] virtual std::vector<Cell> all_cells() const = 0;

    /// Explores a task; called concurrently by several threads.
    virtual void explore(Task& task) const = 0;

    /// True if cells are explored only until their bounds reach a target. The upper bound then
    /// falls steadily, but total work is larger: later rounds select the points of a cell again.
    [[nodiscard]] virtual bool by_stages(const Known& /*known*/) const { return false; }

    /// Improves the known bounds by other searches before each round; `work` limits the total work.
    virtual void look_around(Known& /*known*/, std::uint64_t /*work*/) {}
};

/// Continues a search from known bounds. A requested stop ends it with the bounds so far. The
/// result does not depend on the number of threads or peers, unless a deadline or a stop ends the
/// search; all peers get the same result.
SearchResult branch_and_bound(Problem& problem, const BoxGrid& grid, Known known,
                              const SearchLimits& limits, const RunContext& run, Peers* peers);

/// Explores the cell of a task depth first, by three functions of a Bounder. tighten(cell, from,
/// mine) selects the points that matter in a cell, `mine`, from those of a larger cell, `from`, or
/// in place. It shrinks and bounds the cell, offers boxes as the worst, and returns false if
/// nothing is left to split. split(cell) removes a part from the cell last tightened and returns
/// it. work() returns the number of comparisons so far.
template <class Bounder>
class Explorer {
  public:
    using Points = typename Bounder::Points;

    Explorer(Bounder& bounder, const Points& all, Task& task, const SearchLimits& limits,
             const RunContext& run)
        : bounder_(bounder), all_(all), task_(task), limits_(limits), run_(run) {}

    void explore() {
        descend(task_.cell, all_, 0);
        task_.work = bounder_.work();
    }

  private:
    /// Explores a cell. `from` has the points of a larger cell; points_[depth] is overwritten.
    void descend(Cell cell, const Points& from, std::size_t depth) {
        if (points_.size() < depth + 1) points_.emplace_back();
        Points& mine = points_[depth];
        for (const Points* source = &from;; source = &mine) {
            const bool whole = source == &all_;
            if ((bounder_.work() >= task_.budget && !whole) || late())
                return task_.rest.push_back(std::move(cell));
            if (!bounder_.tighten(cell, *source, mine)) return;
            if (cell.bound <= task_.target) return task_.rest.push_back(std::move(cell));
            descend(bounder_.split(cell), mine, depth + 1);
        }
    }

    /// True if the deadline has passed. Checks clock and stop token only after enough work.
    bool late() {
        constexpr std::uint64_t looks_apart = 1U << 14;
        if (bounder_.work() < next_look_) return late_;
        next_look_ = bounder_.work() + looks_apart;
        run_.check_stop();
        return late_ = limits_.late(run_);
    }

    Bounder& bounder_;
    const Points& all_;
    Task& task_;
    const SearchLimits& limits_;
    const RunContext& run_;
    std::deque<Points> points_;  ///< points of the cell at each depth of the descent
    std::uint64_t next_look_ = 0;
    bool late_ = false;
};

}  // namespace stipple::discrepancy
