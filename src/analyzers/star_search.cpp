// SPDX-License-Identifier: MIT
//
// A cell is a box lo <= y <= hi of corners on the grid. Points below lo on all axes are in the box
// of every corner of the cell; points that are not all below hi are in none; the others are
// undecided, each on the axes on which it is not below lo. With O the number of points in the open
// box, C in the closed one, V the volume, and telescoping V over the axes,
//
//     V(y) - O(y)/n <= V(hi) - O(lo)/n - sum_j min over y_j of [(hi_j - y_j) W_j + c_j(y_j)/n],
//     W_j = prod_{k<j} lo_k * prod_{k>j} hi_k,
//
// where c_j(y_j) counts the points undecided on axis j alone and below y_j there, and
//
//     C(y)/n - V(y) <= C(lo)/n - V(lo) + sum_j max over y_j of [c_j(y_j)/n - (y_j - lo_j) W_j],
//     W_j = prod_{k!=j} lo_k,
//
// where each undecided point is counted on one of its undecided axes, the one on which reaching it
// costs most. Both sums are over the axes, so a y_j whose own term is further from the best one
// than the bound is from the worst box known is out, and the cell shrinks.
//
// On each axis only places matter where a point of the cell lies: an open box that is worst can't
// grow there without taking in a point (or reaches 1), a closed one can't shrink without losing
// one.
//
// Source  the bounds are this program's own; earlier exact methods are surveyed in C. Doerr,
//         M. Gnewuch, M. Wahlstroem, arXiv:1405.1653.

#include "analyzers/star_search.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "analyzers/star_ascent.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace stipple::analyzers::star {
namespace {

/// A box of corners. On axis k, y stands for values[k][y] for open boxes and values[k][y - 1] for
/// closed ones, so that on both sides a point is inside if its rank is below y.
struct Cell {
    Side side;
    double bound;  ///< no corner of the cell has a box worse than this
    Corner lo;
    Corner hi;
};

bool operator<(const Cell& a, const Cell& b) { return a.bound < b.bound; }

/// The points that can matter in a cell, axis after axis, and the number of those that are inside
/// for sure and have been dropped.
struct Active {
    std::size_t size = 0;
    std::uint64_t settled = 0;
    std::vector<std::uint32_t> ranks;

    [[nodiscard]] const std::uint32_t* axis(std::size_t k) const { return ranks.data() + k * size; }
};

/// Explores cells depth first within a budget; one for each task.
template <Side side>
class Explorer {
  public:
    Explorer(const CornerGrid& grid, WorstBox& worst, std::uint64_t budget, const RunContext& run)
        : grid_(grid),
          worst_(worst),
          budget_(budget),
          run_(run),
          d_(grid.dimension()),
          inverse_(1 / static_cast<double>(grid.count)),
          rounding_(static_cast<double>((d_ + 4) * (d_ + 4)) * 0x1p-52),
          bins_(d_),
          terms_(d_),
          weights_(d_),
          least_(d_) {}

    /// What is left of the cell when the budget is used up goes to `rest`.
    void explore(Cell cell, std::vector<Cell>& rest) {
        rest_ = &rest;
        frames_.resize(1);
        frames_[0].size = grid_.count;
        frames_[0].settled = 0;
        frames_[0].ranks.clear();
        for (const auto& ranks : grid_.ranks)
            frames_[0].ranks.insert(frames_[0].ranks.end(), ranks.begin(), ranks.end());
        descend(std::move(cell), 0);
    }

    [[nodiscard]] std::uint64_t work() const { return work_; }

  private:
    static constexpr std::uint32_t shift = side == Side::open ? 0 : 1;
    static constexpr std::uint32_t candidate = std::uint32_t{1} << 31;

    double value(std::size_t k, std::uint32_t y) const { return grid_.values[k][y - shift]; }

    void descend(Cell cell, std::size_t depth) {
        if (work_ >= budget_ && depth > 0) {
            rest_->push_back(std::move(cell));
            return;
        }
        if (frames_.size() < depth + 2) frames_.resize(depth + 2);
        if (!tighten(cell, frames_[depth], frames_[depth + 1])) return;
        const auto [axis, middle, below] = split(cell);
        Cell upper = cell;
        upper.lo[axis] = middle;
        descend(std::move(upper), depth + 1);
        cell.hi[axis] = below;
        descend(std::move(cell), depth + 1);
    }

    /// Shrinks the cell until nothing moves; false if nothing worse than the worst can be in it.
    bool tighten(Cell& cell, const Active& from, Active& mine) {
        filter(cell, from, mine);
        while (true) {
            run_.check_stop();
            count(cell, mine);
            cell.bound = std::min(cell.bound, bound(cell));
            if (cell.bound < worst_.value()) return false;
            bool moved = false;
            for (std::size_t k = 0; k < d_; ++k) {
                const int change = trim(cell, k);
                if (change < 0) return false;
                moved = moved || change > 0;
            }
            if (!moved) return cell.lo != cell.hi;
            filter(cell, mine, mine);
        }
    }

    /// Keeps the points of `from` that can matter in the cell. `from` and `mine` may be the same.
    void filter(const Cell& cell, const Active& from, Active& mine) {
        const std::size_t size = from.size;
        over_.assign(size, 0);
        alive_.assign(size, 0);
        for (std::size_t k = 0; k < d_; ++k) {
            const std::uint32_t* ranks = from.axis(k);
            const std::uint32_t lo = cell.lo[k];
            const std::uint32_t hi = cell.hi[k];
            for (std::size_t i = 0; i < size; ++i) {
                over_[i] += (ranks[i] >= hi ? 1U : 0U) + (ranks[i] > hi ? 1U : 0U);
                alive_[i] |= ranks[i] + shift >= lo ? 1U : 0U;
            }
        }
        work_ += size * d_;
        kept_.clear();
        mine.settled = from.settled;
        for (std::uint32_t i = 0; i < size; ++i) {
            // A point on the upper face on one axis is where an open box can't grow any more.
            if (over_[i] > (side == Side::open ? 1 : 0)) continue;
            if (alive_[i] == 0)
                ++mine.settled;
            else
                kept_.push_back(i);
        }
        if (&mine != &from) mine.ranks.resize(kept_.size() * d_);
        std::uint32_t* to = mine.ranks.data();
        for (std::size_t k = 0; k < d_; ++k) {
            const std::uint32_t* ranks = from.ranks.data() + k * size;
            for (const std::uint32_t i : kept_) *to++ = ranks[i];
        }
        mine.size = kept_.size();
    }

    /// Sorts the active points into bins: at bins_[k][y - lo], the points counted from y on, and
    /// whether y is a candidate. Offers the corner at which the count is known anyway.
    void count(const Cell& cell, const Active& active) {
        for (std::size_t k = 0; k < d_; ++k) bins_[k].assign(cell.hi[k] - cell.lo[k] + 1, 0);
        inside_lo_ = active.settled;
        std::uint64_t inside_hi = active.settled;
        weigh(cell);
        for (std::size_t i = 0; i < active.size; ++i) {
            std::uint32_t undecided = 0;
            bool inside = true;
            std::size_t axis = 0;
            double dearest = -1;
            for (std::size_t k = 0; k < d_; ++k) {
                const std::uint32_t rank = active.ranks[k * active.size + i];
                if (rank >= cell.hi[k]) inside = false;
                if (rank < cell.lo[k]) continue;
                ++undecided;
                const double cost = side == Side::open
                                        ? 0
                                        : (value(k, rank + 1) - value(k, cell.lo[k])) * weights_[k];
                if (cost > dearest) {
                    dearest = cost;
                    axis = k;
                }
            }
            for (std::size_t k = 0; k < d_; ++k) {
                const std::uint32_t y = active.ranks[k * active.size + i] + shift;
                if (y < cell.lo[k]) continue;
                if (inside || y == cell.hi[k]) bins_[k][y - cell.lo[k]] |= candidate;
            }
            if (!inside) continue;
            ++inside_hi;
            if (undecided == 0) ++inside_lo_;
            if (undecided == 1 || (side == Side::closed && undecided > 1))
                ++bins_[axis][active.ranks[axis * active.size + i] + 1 - cell.lo[axis]];
        }
        work_ += active.size * d_;
        for (std::size_t k = 0; k < d_; ++k)
            if (side == Side::open && cell.hi[k] + 1 == grid_.values[k].size())
                bins_[k].back() |= candidate;
        offer(side == Side::open ? cell.hi : cell.lo, side == Side::open ? inside_hi : inside_lo_);
    }

    void offer(const Corner& y, std::uint64_t points) {
        corner_ = y;
        for (auto& place : corner_) place -= shift;
        worst_.offer(side, corner_, points);
    }

    /// What a step on axis k costs at least (open) or saves at least (closed) in volume.
    void weigh(const Cell& cell) {
        double before = 1;
        for (std::size_t k = 0; k < d_; ++k) {
            weights_[k] = before;
            before *= value(k, cell.lo[k]);
        }
        double behind = 1;
        for (std::size_t k = d_; k-- > 0;) {
            weights_[k] *= behind;
            behind *= value(k, side == Side::open ? cell.hi[k] : cell.lo[k]);
        }
        volume_ = behind;
    }

    /// The bound of the header, rounded up; leaves the terms of every place, the lower the better.
    double bound(const Cell& cell) {
        const double share = static_cast<double>(inside_lo_) * inverse_;
        double sum = side == Side::open ? volume_ - share : share - volume_;
        for (std::size_t k = 0; k < d_; ++k) {
            const auto& bins = bins_[k];
            auto& terms = terms_[k];
            terms.resize(bins.size());
            const double* values = grid_.values[k].data() + cell.lo[k] - shift;
            std::uint32_t points = 0;
            double least = 2;
            for (std::size_t y = 0; y < bins.size(); ++y) {
                points += bins[y] & ~candidate;
                const double counted = points * inverse_;
                terms[y] = side == Side::open
                               ? (values[bins.size() - 1] - values[y]) * weights_[k] + counted
                               : (values[y] - values[0]) * weights_[k] - counted;
                if (bins[y] & candidate) least = std::min(least, terms[y]);
            }
            work_ += bins.size();
            least_[k] = least;
            sum -= least;
        }
        return sum + rounding_;
    }

    /// Moves lo and hi on axis k to the first and last candidate that the bound doesn't exclude:
    /// 1 if they moved, 0 if not, -1 if none is left.
    int trim(Cell& cell, std::size_t k) {
        const auto& bins = bins_[k];
        const double most = least_[k] + (cell.bound - worst_.value()) + rounding_;
        const auto out = [&](std::size_t y) {
            return !(bins[y] & candidate) || terms_[k][y] > most;
        };
        std::size_t first = 0;
        std::size_t last = bins.size();
        while (first < last && out(first)) ++first;
        if (first == last) return -1;
        while (out(last - 1)) --last;
        if (first == 0 && last == bins.size()) return 0;
        cell.hi[k] = cell.lo[k] + static_cast<std::uint32_t>(last - 1);
        cell.lo[k] += static_cast<std::uint32_t>(first);
        return 1;
    }

    struct Split {
        std::size_t axis;
        std::uint32_t middle;  ///< lowest place of the upper half
        std::uint32_t below;   ///< highest place of the lower half
    };

    /// Halves the axis that weighs most in the bound.
    Split split(const Cell& cell) const {
        Split best{};
        double most = -1;
        for (std::size_t k = 0; k < d_; ++k) {
            if (cell.lo[k] == cell.hi[k]) continue;
            std::uint32_t points = 0;
            for (const auto bin : bins_[k]) points += bin & ~candidate;
            const double slope = 1 - value(k, cell.lo[k]) / value(k, cell.hi[k]);
            const double weight = slope * volume_ + points * inverse_ / 2;
            if (weight > most) {
                most = weight;
                best.axis = k;
            }
        }
        const auto& bins = bins_[best.axis];
        const auto is_candidate = [](std::uint32_t bin) { return (bin & candidate) != 0; };
        auto half = std::ranges::count_if(bins, is_candidate) / 2;
        std::uint32_t y = 0;
        for (; half > 0 || !is_candidate(bins[y]); ++y)
            if (is_candidate(bins[y])) {
                --half;
                best.below = cell.lo[best.axis] + y;
            }
        best.middle = cell.lo[best.axis] + y;
        return best;
    }

    const CornerGrid& grid_;
    WorstBox& worst_;
    std::uint64_t budget_;
    const RunContext& run_;
    std::size_t d_;
    double inverse_;
    double rounding_;  ///< more than the rounding errors of a bound
    std::vector<std::vector<std::uint32_t>> bins_;
    std::vector<std::vector<double>> terms_;
    std::vector<double> weights_;
    std::vector<double> least_;
    std::vector<std::uint32_t> over_;
    std::vector<std::uint32_t> alive_;
    std::vector<std::uint32_t> kept_;
    std::vector<Active> frames_;
    Corner corner_;
    double volume_ = 0;
    std::uint64_t inside_lo_ = 0;
    std::uint64_t work_ = 0;
    std::vector<Cell>* rest_ = nullptr;
};

/// All corners of one side.
Cell whole(const CornerGrid& grid, Side side) {
    Cell cell{.side = side, .bound = 1, .lo = {}, .hi = {}};
    const std::uint32_t shift = side == Side::open ? 0 : 1;
    for (const auto& values : grid.values) {
        cell.lo.push_back(shift);
        cell.hi.push_back(static_cast<std::uint32_t>(values.size()) - 1 + shift);
    }
    return cell;
}

struct Task {
    Cell cell;
    WorstBox worst;
    std::vector<Cell> rest;
    std::uint64_t work;
};

void explore(const CornerGrid& grid, Task& task, std::uint64_t budget, const RunContext& run) {
    const auto with = [&](auto explorer) {
        explorer.explore(std::move(task.cell), task.rest);
        task.work = explorer.work();
    };
    if (task.cell.side == Side::open)
        with(Explorer<Side::open>(grid, task.worst, budget, run));
    else
        with(Explorer<Side::closed>(grid, task.worst, budget, run));
}

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

SearchResult search(const CornerGrid& grid, std::uint64_t max_work, const RunContext& run) {
    constexpr std::size_t together = 16;  // cells explored at once, whatever the number of threads
    const std::uint64_t size = grid.count * grid.dimension();
    const std::uint64_t budget = std::max(std::uint64_t{1} << 22, 16 * size);
    WorstBox worst = ascend(grid, std::clamp<std::uint64_t>((1U << 24) / size, 8, 200), run);
    std::priority_queue<Cell> cells;
    cells.push(whole(grid, Side::open));
    cells.push(whole(grid, Side::closed));
    std::uint64_t work = 0;
    double upper = 1;
    while (!cells.empty() && work < max_work) {
        std::vector<Task> tasks;
        for (; tasks.size() < together && !cells.empty(); cells.pop())
            tasks.push_back({cells.top(), worst, {}, 0});
        constexpr bool silent = true;
        for_each_block(
            run, tasks.size(), 1,
            [&](const Block& block) { explore(grid, tasks[block.index], budget, run); }, silent);
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
