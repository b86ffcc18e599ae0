// SPDX-License-Identifier: MIT
//
// Branch and bound over cells of boxes. The cells with the highest bounds are explored first, some
// at a time: each is split, depth first, until its parts have bounds below a target between the
// known bounds of the value, or its budget is used up; what is left goes back to the heap. So the
// upper bound falls steadily, and cells that only an exact answer asks for come last. Those
// explored together know of each other's finds only when all are done, so that what happens does
// not depend on the number of threads.
//
// Peers share the cells of a round out among themselves and then tell each other what came of them,
// so that all of them know the same before the next round; all else each of them does by itself. A
// process without others is its own only peer.
#pragma once

#include <deque>
#include <vector>

#include "core/peers.hpp"
#include "math/discrepancy/box_grid.hpp"
#include "math/discrepancy/search_limits.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy {

/// Boxes of one side, given by ranges of some numbers, the meaning of which the kind of box knows.
struct Cell {
    Side side;
    double bound;  ///< no box of the cell has a value above this
    std::vector<std::uint32_t> lo;
    std::vector<std::uint32_t> hi;
};

/// A cell to explore, and what came of it.
struct Task {
    Cell cell;
    WorstBox worst;
    double target;             ///< parts with lower bounds are left for later
    std::uint64_t budget;      ///< of comparisons
    std::vector<Cell> rest{};  ///< parts that are still open
    std::uint64_t work = 0;
};

/// What is certain while a search goes on.
struct Known {
    WorstBox worst;
    double upper = 1;
    std::uint64_t work = 0;  ///< comparisons done
};

/// A kind of boxes to search.
class Problem {
  public:
    Problem() = default;
    Problem(const Problem&) = delete;
    Problem& operator=(const Problem&) = delete;
    virtual ~Problem() = default;

    /// All boxes.
    [[nodiscard]] virtual std::vector<Cell> all_cells() const = 0;

    /// Explores a task; called by several threads at once.
    virtual void explore(Task& task) const = 0;

    /// Whether cells are explored no further than to a target: more work on the whole, the more so
    /// the less a cell costs against finding its points anew, but bounds get closer steadily.
    [[nodiscard]] virtual bool by_stages(const Known& /*known*/) const { return false; }

    /// Improves bounds by other means; called before every round, with the work that may be done in
    /// all.
    virtual void look_around(Known& /*known*/, std::uint64_t /*work*/) {}
};

/// Searches on from what is known. Once a stop is requested, it ends with what is certain. The
/// result does not depend on the number of threads, nor of peers, unless a deadline or a stop ends
/// it; all peers get the same.
SearchResult branch_and_bound(Problem& problem, const BoxGrid& grid, Known known,
                              const SearchLimits& limits, const RunContext& run, Peers* peers);

/// Explores the cell of a task depth first. A bounder knows the points that matter in a cell:
/// tighten(cell, from, mine) finds them among those of a larger cell (`mine` may be `from`),
/// shrinks and bounds the cell, offers boxes, and is false where nothing is left to split;
/// split(cell) takes a part away from the cell that was tightened last; work() counts comparisons.
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
    /// `from` is this call's to use up, but for all points.
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

    /// Looks at the clock now and then, and at the stop token.
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
    std::deque<Points> points_;  ///< of the cells on the way down to this one
    std::uint64_t next_look_ = 0;
    bool late_ = false;
};

}  // namespace stipple::discrepancy
