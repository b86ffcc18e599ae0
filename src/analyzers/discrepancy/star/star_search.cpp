// SPDX-License-Identifier: MIT
//
// The cells with the highest bounds are explored first, some at a time: each is split, depth first,
// until its parts have bounds below a target between the known bounds of the discrepancy, or its
// budget is used up; what is left goes back to the heap. So the upper bound falls steadily, and
// cells that only an exact answer asks for come last. Those explored together know of each other's
// finds only when all are done, so that what happens does not depend on the number of threads.
//
// Peers share the cells of a round out among themselves and then tell each other what came of them,
// so that all of them know the same before the next round; all else each of them does by itself.
//
// A cover by a grid, or that the points are a net, gives a first upper bound where there are many
// points: cells of these take long to get small. From time to time climbs look for a worse box: one
// that the cells would give only late.
//
// Source  the bounds are this program's own; earlier exact methods are surveyed in C. Doerr,
//         M. Gnewuch, M. Wahlstroem, arXiv:1405.1653.

#include "analyzers/discrepancy/star/star_search.hpp"

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

#include "analyzers/discrepancy/star/star_blocks.hpp"
#include "analyzers/discrepancy/star/star_cell.hpp"
#include "analyzers/discrepancy/star/star_cover.hpp"
#include "analyzers/discrepancy/star/star_net.hpp"
#include "core/error.hpp"
#include "core/packed.hpp"
#include "core/parallel.hpp"

namespace stipple::analyzers::star {
namespace {

using Logs = std::vector<std::vector<double>>;

/// What all tasks share.
struct Field {
    const CornerGrid& grid;
    const Logs logs;
    const Active points;
    const RunContext& run;
    const SearchLimits& limits;

    [[nodiscard]] bool late() const { return limits.late(run); }
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

/// Explores the cell of a task depth first.
template <Side side>
class Explorer {
  public:
    Explorer(const Field& field, Task& task)
        : field_(field), bounder_(field.grid, field.logs, task.worst, field.run), task_(task) {}

    void explore() {
        descend(task_.cell, field_.points, 0);
        task_.work = bounder_.work();
    }

  private:
    /// `from` is this call's to use up, but for the points of the field.
    void descend(Cell cell, const Active& from, std::size_t depth) {
        if (points_.size() < depth + 1) points_.emplace_back();
        Active& mine = points_[depth];
        for (const Active* source = &from;; source = &mine) {
            const bool whole = source == &field_.points;
            if ((bounder_.work() >= task_.budget && !whole) || field_.late())
                return task_.rest.push_back(std::move(cell));
            if (!bounder_.tighten(cell, *source, mine)) return;
            if (cell.bound <= task_.target) return task_.rest.push_back(std::move(cell));
            const auto [axis, middle, below] = bounder_.split(cell);
            Cell lower = cell;
            lower.hi[axis] = below;
            descend(std::move(lower), mine, depth + 1);
            cell.lo[axis] = middle;
        }
    }

    const Field& field_;
    CellBounder<side> bounder_;
    Task& task_;
    std::deque<Active> points_;  ///< of the cells on the way down to this one
};

void explore(const Field& field, Task& task) {
    if (task.cell.side == Side::open)
        Explorer<Side::open>(field, task).explore();
    else
        Explorer<Side::closed>(field, task).explore();
}

bool lower_bound(const Cell& a, const Cell& b) { return a.bound < b.bound; }

std::size_t cell_bytes(const CornerGrid& grid) {
    constexpr std::size_t of_two_blocks = 32;
    return sizeof(Cell) + of_two_blocks + 2 * sizeof(std::uint32_t) * grid.dimension();
}

class Search {
  public:
    Search(const CornerGrid& grid, WorstBox worst, const SearchLimits& limits,
           const RunContext& run, Peers* peers)
        : peers_(peers),
          limits_(limits),
          run_(run),
          field_{grid, logarithms(grid), all_points(grid), run_, limits_},
          worst_(std::move(worst)),
          hunt_(grid),
          cells_{whole_cell(grid, Side::open), whole_cell(grid, Side::closed)} {
        const double room = std::min(0.25 * static_cast<double>(run.max_memory), 0x1p30);
        most_cells_ = static_cast<std::size_t>(room / static_cast<double>(cell_bytes(grid)));
    }

    SearchResult go() {
        if (peers_ != nullptr) return go_together();
        while (!ending()) try {
                round();
            } catch (const Error& e) {
                if (e.kind() != ErrorKind::cancelled) throw;
                return certain(Ending::stopped);
            }
        return certain(*ending());
    }

  private:
    /// Comparisons; a quarter of a second of them.
    static constexpr std::uint64_t short_work = 1U << 28;

    SearchResult certain(Ending ending) {
        if (ending != Ending::complete) look_quickly();
        return {worst_, upper_, ending};
    }

    /// The bounds that cost next to nothing, once.
    void look_quickly() {
        if (std::exchange(looked_, true)) return;
        offer_slabs(field_.grid, worst_);
        upper_ = std::max(worst_.value(), std::min(upper_, quick_bound(field_.grid, run_)));
    }

    [[nodiscard]] std::optional<Ending> ending() const {
        if (cells_.empty() || upper_ <= worst_.value()) return Ending::complete;
        if (upper_ - worst_.value() <= limits_.tolerance * worst_.value()) return Ending::tolerance;
        if (work_ >= limits_.work) return Ending::work;
        if (peers_ != nullptr ? late_ : field_.late()) return Ending::time;
        return {};
    }

    /// A peer that was told to stop, or whose time is over, still speaks with the others, so that
    /// all of them end in the same round.
    SearchResult go_together() {
        agree();
        while (!stopped_ && !ending()) {
            std::vector<Task> tasks;
            const bool mine = unless_stopped([&] { look_around(); });
            if (limits_.timed()) agree();  // how far each came depends on its clock
            if (!stopped_) tasks = next_tasks();
            if (mine && !stopped_) unless_stopped([&] { explore_some(tasks); });
            tell(tasks);
            unless_stopped([&] { settle(); });
        }
        return certain(stopped_ ? Ending::stopped : *ending());
    }

    /// Does it, or has it interrupted. True: it is done.
    template <class Work>
    bool unless_stopped(const Work& work) {
        try {
            work();
        } catch (const Error& e) {
            if (e.kind() != ErrorKind::cancelled) throw;
            interrupted_ = true;
        }
        return !interrupted_;
    }

    /// From now on all peers know what the first one knows.
    void agree() {
        Packer packer;
        packer.put(limits_.work).put(upper_).put(work_).put(hunted_);
        packer.put(worst_.side()).put(worst_.points()).put_all(worst_.places());
        packer.put(field_.late()).put(run_.stop.stop_requested() || interrupted_);
        const auto all = peers_->exchange(packer.take());
        Unpacker first(all.front());
        limits_.work = first.take<std::uint64_t>();
        upper_ = first.take<double>();
        work_ = first.take<std::uint64_t>();
        hunted_ = first.take<std::uint64_t>();
        const Side side = first.take<Side>();
        const auto points = first.take<std::uint64_t>();
        worst_ = WorstBox(field_.grid);
        worst_.offer(side, first.take_all<std::uint32_t>(), points);
        for (const auto& text : all) heed(std::string_view(text).substr(text.size() - 2));
    }

    /// What a peer says last: whether its time is over, whether it was told to stop.
    void heed(std::string_view end) {
        Unpacker flags(end);
        late_ = flags.take<bool>() || late_;
        stopped_ = flags.take<bool>() || stopped_;
    }

    /// This peer's tasks.
    void explore_some(std::vector<Task>& tasks) {
        const auto size = static_cast<std::size_t>(peers_->size());
        const auto rank = static_cast<std::size_t>(peers_->rank());
        const std::size_t some = (tasks.size() + size - 1 - rank) / size;
        for_each_block(
            run_, some, 1,
            [&](const Block& block) { explore(field_, tasks[block.index * size + rank]); }, true);
    }

    /// Tells the others what came of this peer's tasks, and takes in all of them in their order.
    void tell(std::vector<Task>& tasks) {
        const auto size = static_cast<std::size_t>(peers_->size());
        Packer packer;
        for (std::size_t i = static_cast<std::size_t>(peers_->rank()); i < tasks.size(); i += size)
            pack(tasks[i], packer);
        packer.put(field_.late()).put(run_.stop.stop_requested() || interrupted_);
        const auto all = peers_->exchange(packer.take());
        std::vector<Unpacker> found(all.begin(), all.end());
        for (const auto& text : all) heed(std::string_view(text).substr(text.size() - 2));
        if (stopped_) {  // its cells may be unexplored: they stay what they were
            for (Task& task : tasks) push(std::move(task.cell));
            return;
        }
        for (std::size_t i = 0; i < tasks.size(); ++i) take(found[i % size]);
    }

    static void pack(const Task& task, Packer& to) {
        const WorstBox& worst = task.worst;
        to.put(task.work).put(worst.side()).put(worst.points()).put_all(worst.places());
        to.put<std::uint64_t>(task.rest.size());
        for (const Cell& cell : task.rest)
            to.put(cell.side).put(cell.bound).put_all(cell.lo).put_all(cell.hi);
    }

    /// What a peer packed of one task.
    void take(Unpacker& from) {
        work_ += from.take<std::uint64_t>();
        const Side side = from.take<Side>();
        const auto points = from.take<std::uint64_t>();
        worst_.offer(side, from.take_all<std::uint32_t>(), points);
        for (auto left = from.take<std::uint64_t>(); left > 0; --left) {
            Cell cell{.side = from.take<Side>(), .bound = from.take<double>(), .lo = {}, .hi = {}};
            cell.lo = from.take_all<std::uint32_t>();
            cell.hi = from.take_all<std::uint32_t>();
            push(std::move(cell));
        }
    }

    void look_around() {
        if (work_ > short_work / 4) look_quickly();
        constexpr std::uint64_t hunts_apart = 16;  // in units of what they cost
        if (work_ > short_work && hunts_apart * hunted_ < work_) hunt();
        if (!covered_ && (steadily() || work_ > short_work)) cover();
    }

    void round() {
        look_around();
        std::vector<Task> tasks = next_tasks();
        constexpr bool silent = true;
        for_each_block(
            run_, tasks.size(), 1, [&](const Block& block) { explore(field_, tasks[block.index]); },
            silent);
        for (Task& task : tasks) {
            work_ += task.work;
            worst_.offer(task.worst);
            for (Cell& cell : task.rest) push(std::move(cell));
        }
        settle();
    }

    /// The cells with the highest bounds, each with a share of what work is left.
    std::vector<Task> next_tasks() {
        constexpr std::size_t together = 64;
        const std::uint64_t size = field_.grid.count * field_.grid.dimension();
        const double target = next_target();
        std::vector<Task> tasks;
        while (tasks.size() < together && !cells_.empty() && cells_.front().bound > target)
            tasks.push_back({pop(), worst_, target, 0});
        const std::uint64_t share = (limits_.work - std::min(work_, limits_.work)) / tasks.size();
        const std::uint64_t budget = std::max(std::uint64_t{1} << 22, 16 * size);
        for (Task& task : tasks) task.budget = std::min(budget, share);
        return tasks;
    }

    /// Whether bounds may be all that is wanted.
    [[nodiscard]] bool steadily() const {
        return limits_.tolerance > 0 || limits_.work < 4 * short_work || limits_.timed();
    }

    /// 0 when cells are to be explored to the end: it is least work on the whole, but leaves the
    /// upper bound where it is.
    [[nodiscard]] double next_target() const {
        constexpr double step = 0.6;
        constexpr double close = 0.1;  // relative; not far from the end
        const double lower = worst_.value();
        const double gap = upper_ - lower;
        const bool may_be_short = !steadily() && work_ < short_work;
        if (may_be_short || cells_.size() >= most_cells_ || gap < close * lower) return 0;
        return lower + step * gap;
    }

    void push(Cell cell) {
        cells_.push_back(std::move(cell));
        std::ranges::push_heap(cells_, lower_bound);
    }

    Cell pop() {
        std::ranges::pop_heap(cells_, lower_bound);
        Cell cell = std::move(cells_.back());
        cells_.pop_back();
        return cell;
    }

    /// Drops what can't matter any more and says what is certain now.
    void settle() {
        if (!cells_.empty() && cells_.front().bound < worst_.value()) cells_.clear();
        upper_ = cells_.empty() ? worst_.value()
                                : std::max(worst_.value(), std::min(upper_, cells_.front().bound));
        report_gap(worst_.value(), upper_, run_);
    }

    /// An upper bound for about an eighth of the work or time that is left.
    void cover() {
        covered_ = true;
        constexpr double corners_a_second = 1e8;
        const std::uint64_t d = field_.grid.dimension();
        std::uint64_t corners = std::uint64_t{1} << 25;
        corners = std::min(corners, (limits_.work - std::min(work_, limits_.work)) / (16 * d));
        corners = std::min(corners, run_.max_memory / 16);
        if (!steadily()) corners = std::min(corners, work_ / (16 * d));
        if (steadily() && run_.seconds)
            corners = static_cast<std::uint64_t>(
                std::clamp((limits_.deadline - run_.seconds()) / 16 * corners_a_second, 0.0,
                           static_cast<double>(corners)));
        upper_ = std::min(upper_, cover_bound(field_.grid, corners, run_));
        upper_ = std::min(upper_, net_bound(field_.grid, upper_, corners * d, run_));
        work_ += 2 * corners * d;
    }

    /// Climbs, and what they cost.
    void hunt() {
        const std::uint64_t cost = hunt_.go(worst_, limits_, run_);
        hunted_ += cost;
        work_ += cost;
    }

    Peers* peers_;  ///< nullptr: alone
    SearchLimits limits_;
    const RunContext& run_;
    Field field_;
    WorstBox worst_;
    BoxHunt hunt_;
    std::vector<Cell> cells_;  ///< that are open; a heap, the highest bound first
    std::size_t most_cells_;   ///< to keep; with more, cells are explored to the end
    double upper_ = 1;
    bool looked_ = false;
    bool covered_ = false;
    std::uint64_t work_ = 0;
    std::uint64_t hunted_ = 0;  ///< part of work_

    // Of peers:
    bool interrupted_ = false;  ///< this one was told to stop
    bool stopped_ = false;      ///< one of them was
    bool late_ = false;         ///< the time of one of them is over
};

}  // namespace

SearchResult certain_at_once(const CornerGrid& grid, WorstBox worst, Ending ending,
                             const RunContext& run) {
    offer_slabs(grid, worst);
    const double upper = std::max(worst.value(), quick_bound(grid, run));
    return {std::move(worst), upper, ending};
}

SearchResult search(const CornerGrid& grid, WorstBox worst, const SearchLimits& limits,
                    const RunContext& run, Peers* peers) {
    return Search(grid, std::move(worst), limits, run, peers).go();
}

SearchResult find_worst(const CornerGrid& grid, const SearchLimits& limits, const RunContext& run,
                        const Hint* hint, Peers* peers) {
    const Ascent first = ascend(grid, limits, run, hint);
    if (peers == nullptr && limits.over(run))
        return certain_at_once(grid, first.worst, limits.late(run) ? Ending::time : Ending::stopped,
                               run);
    const SearchLimits left = limits.after(first.work);
    return search(grid, first.worst, left, run, peers);
}

double search_bytes(std::size_t count, std::size_t dimension, unsigned threads) {
    // On the way down to a cell, about as many points again as it has stay behind.
    constexpr double copies = 3;
    return (1 + copies * threads) * static_cast<double>(count) * static_cast<double>(dimension) *
           sizeof(std::int32_t);
}

}  // namespace stipple::analyzers::star
