// SPDX-License-Identifier: MIT
#include "math/discrepancy/branch_and_bound.hpp"

#include <algorithm>
#include <optional>

#include "core/bytes/packed.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace stipple::discrepancy {
namespace {

bool lower_bound(const Cell& a, const Cell& b) { return a.bound < b.bound; }

void pack(const WorstBox& worst, Packer& to) {
    to.put(worst.points()).put(worst.box().side).put_all(worst.box().axes);
}

void offer_packed(Unpacker& from, WorstBox& worst) {
    const auto points = from.take<std::uint64_t>();
    const Side side = from.take<Side>();
    worst.offer({.side = side, .axes = from.take_all<Interval>()}, points);
}

/// Number of open cells that fit into a quarter of the memory limit, at most 1 GiB.
std::size_t most_cells(const Cell& cell, const RunContext& run) {
    constexpr std::size_t of_two_blocks = 32;
    const double bytes = static_cast<double>(sizeof(Cell) + of_two_blocks +
                                             2 * sizeof(std::uint32_t) * cell.lo.size());
    return static_cast<std::size_t>(std::min(0.25 * static_cast<double>(run.max_memory), 0x1p30) /
                                    bytes);
}

class Search {
  public:
    Search(Problem& problem, const BoxGrid& grid, Known known, const SearchLimits& limits,
           const RunContext& run, Peers& peers)
        : problem_(problem),
          grid_(grid),
          limits_(limits),
          run_(run),
          peers_(peers),
          known_(std::move(known)),
          cells_(problem.all_cells()),
          most_cells_(most_cells(cells_.front(), run)) {}

    /// Runs the search. A peer that was stopped or is out of time still exchanges messages, so that
    /// all peers end in the same round.
    SearchResult go() {
        agree();
        while (!stopped_ && !ending()) {
            std::vector<Task> tasks;
            unless_interrupted([&] { problem_.look_around(known_, limits_.work); });
            if (limits_.timed()) agree();  // bounds may depend on each peer's clock
            if (!stopped_) tasks = next_tasks();
            unless_interrupted([&] { explore_some(tasks); });
            exchange(tasks);
            if (!stopped_) unless_interrupted([&] { update_bounds(); });
        }
        return {known_.worst, known_.upper, stopped_ ? Ending::stopped : *ending()};
    }

  private:
    [[nodiscard]] std::optional<Ending> ending() const {
        const double lower = known_.worst.value();
        if (cells_.empty() || known_.upper <= lower) return Ending::complete;
        if (known_.upper - lower <= limits_.tolerance * lower) return Ending::tolerance;
        if (known_.work >= limits_.work) return Ending::work;
        if (late_) return Ending::time;
        return {};
    }

    /// Calls work() unless a peer was stopped; a stop request meanwhile only sets interrupted_.
    template <class Work>
    void unless_interrupted(const Work& work) {
        if (interrupted_ || stopped_) return;
        try {
            work();
        } catch (const Error& e) {
            if (e.kind() != ErrorKind::cancelled) throw;
            interrupted_ = true;
        }
    }

    /// Replaces the work limit and the bounds of every peer by those of the first peer.
    void agree() {
        Packer packer;
        packer.put(limits_.work).put(known_.upper).put(known_.work);
        pack(known_.worst, packer);
        const auto all = speak(packer);
        Unpacker first(all.front());
        limits_.work = first.take<std::uint64_t>();
        known_.upper = first.take<double>();
        known_.work = first.take<std::uint64_t>();
        known_.worst = WorstBox(grid_);
        offer_packed(first, known_.worst);
    }

    /// Exchanges a message with all peers. It ends with two flags: out of time, and stopped.
    std::vector<std::string> speak(Packer& packer) {
        packer.put(limits_.late(run_)).put(run_.stop.stop_requested() || interrupted_);
        const auto all = peers_.exchange(packer.take());
        for (const auto& text : all) {
            Unpacker end(std::string_view(text).substr(text.size() - 2));
            late_ = end.take<bool>() || late_;
            stopped_ = end.take<bool>() || stopped_;
        }
        return all;
    }

    void explore_some(std::vector<Task>& tasks) {
        const auto size = static_cast<std::size_t>(peers_.size());
        const auto rank = static_cast<std::size_t>(peers_.rank());
        const std::size_t some = (tasks.size() + size - 1 - rank) / size;
        for_each_block(silent(run_), some, 1, [&](const Block& block) {
            problem_.explore(tasks[block.index * size + rank]);
        });
    }

    /// Sends the results of this peer's tasks, and merges those of all peers in the order of tasks.
    void exchange(std::vector<Task>& tasks) {
        const auto size = static_cast<std::size_t>(peers_.size());
        Packer packer;
        for (std::size_t i = static_cast<std::size_t>(peers_.rank()); i < tasks.size(); i += size)
            pack_task(tasks[i], packer);
        const auto all = speak(packer);
        std::vector<Unpacker> found(all.begin(), all.end());
        if (stopped_) return;  // keeps the bounds: tasks may be unexplored
        for (std::size_t i = 0; i < tasks.size(); ++i) take_task(found[i % size]);
    }

    static void pack_task(const Task& task, Packer& to) {
        to.put(task.work);
        pack(task.worst, to);
        to.put<std::uint64_t>(task.rest.size());
        for (const Cell& cell : task.rest)
            to.put(cell.side).put(cell.bound).put_all(cell.lo).put_all(cell.hi);
    }

    void take_task(Unpacker& from) {
        known_.work += from.take<std::uint64_t>();
        offer_packed(from, known_.worst);
        for (auto left = from.take<std::uint64_t>(); left > 0; --left) {
            Cell cell{.side = from.take<Side>(), .bound = from.take<double>(), .lo = {}, .hi = {}};
            cell.lo = from.take_all<std::uint32_t>();
            cell.hi = from.take_all<std::uint32_t>();
            cells_.push_back(std::move(cell));
            std::ranges::push_heap(cells_, lower_bound);
        }
    }

    [[nodiscard]] bool full() const { return cells_.size() >= most_cells_; }

    /// Pops the cells with the highest bounds. Budgets are at most equal parts of the work left.
    std::vector<Task> next_tasks() {
        constexpr std::size_t together = 64;
        const std::uint64_t size = grid_.count * grid_.dimension();
        const double target = next_target();
        const bool to_the_end = full();
        std::vector<Task> tasks;
        while (tasks.size() < together && !cells_.empty() && cells_.front().bound > target)
            tasks.push_back({pop(), known_.worst, target, 0});
        const std::uint64_t left = limits_.work - std::min(known_.work, limits_.work);
        const std::uint64_t share = left / tasks.size();
        const std::uint64_t budget =
            (to_the_end ? 64 : 1) * std::max(std::uint64_t{1} << 22, 16 * size);
        for (Task& task : tasks) task.budget = std::min(budget, share);
        return tasks;
    }

    /// Bound below which parts of cells are left for later; 0 to explore cells to the end.
    [[nodiscard]] double next_target() const {
        constexpr double step = 0.6;
        constexpr double close = 0.1;  // below this relative gap, cells are explored to the end
        const double lower = known_.worst.value();
        const double gap = known_.upper - lower;
        if (!problem_.by_stages(known_) || full() || gap < close * lower) return 0;
        return lower + step * gap;
    }

    Cell pop() {
        std::ranges::pop_heap(cells_, lower_bound);
        Cell cell = std::move(cells_.back());
        cells_.pop_back();
        return cell;
    }

    /// Drops cells that cannot contain a worse box, and updates the upper bound.
    void update_bounds() {
        const double lower = known_.worst.value();
        if (!cells_.empty() && cells_.front().bound < lower) cells_.clear();
        known_.upper =
            cells_.empty() ? lower : std::max(lower, std::min(known_.upper, cells_.front().bound));
        report_gap(lower, known_.upper, run_);
    }

    Problem& problem_;
    const BoxGrid& grid_;
    SearchLimits limits_;
    const RunContext& run_;
    Peers& peers_;
    Known known_;
    std::vector<Cell> cells_;  ///< open cells; a heap with the highest bound first
    std::size_t most_cells_;   ///< at this number of open cells, cells are explored to the end

    bool interrupted_ = false;  ///< this peer was stopped
    bool stopped_ = false;      ///< some peer was stopped
    bool late_ = false;         ///< some peer is out of time
};

}  // namespace

SearchResult branch_and_bound(Problem& problem, const BoxGrid& grid, Known known,
                              const SearchLimits& limits, const RunContext& run, Peers* peers) {
    Peers alone;
    return Search(problem, grid, std::move(known), limits, run, peers ? *peers : alone).go();
}

}  // namespace stipple::discrepancy
