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
// that all have the same state before the next round. Every peer does all other work. A single
// process is its own only peer.
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
    double target;             ///< parts with bounds up to the target are left for later
    std::uint64_t budget;      ///< limit on `work`
    std::vector<Cell> rest{};  ///< parts that remain open
    std::uint64_t work = 0;
};

/// Proven bounds during a search.
struct Known {
    WorstBox worst;
    double upper = 1;
    std::uint64_t work = 0;  ///< comparisons of coordinates
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

    /// True if cells are explored only until their bounds reach a target. The bounds then converge
    /// steadily, but with more work in total, as later rounds select the points of a cell again.
    [[nodiscard]] virtual bool by_stages(const Known& /*known*/) const { return false; }

    /// Improves the known bounds by other searches before each round; `work` limits the total work.
    virtual void look_around(Known& /*known*/, std::uint64_t /*work*/) {}
};

/// Continues a search from known bounds. A requested stop ends it with the bounds so far. The
/// result does not depend on the number of threads or peers, unless a deadline or a stop ends the
/// search; all peers get the same result.
SearchResult branch_and_bound(Problem& problem, const BoxGrid& grid, Known known,
                              const SearchLimits& limits, const RunContext& run, Peers* peers);

/// Explores the cell of a task depth first. A bounder provides three functions. tighten(cell, from,
/// mine) selects the relevant points of a cell from those of a larger cell (`mine` may be `from`),
/// shrinks and bounds the cell, and offers boxes; it returns false if nothing is left to split.
/// split(cell) removes a part from the cell last tightened and returns it. work() counts
/// comparisons.
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

    /// Checks the clock and the stop token at intervals of work.
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
    std::deque<Points> points_;  ///< points of the current cell and those that contain it, by depth
    std::uint64_t next_look_ = 0;
    bool late_ = false;
};

}  // namespace stipple::discrepancy
