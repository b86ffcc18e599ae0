// SPDX-License-Identifier: MIT
#include "math/discrepancy/empty_rectangle.hpp"

#include <algorithm>

namespace stipple::discrepancy {
namespace {

/// Keys by position, with the maximum over a range of positions in O(log n).
class HighestKey {
  public:
    explicit HighestKey(std::size_t n) : n_(n), keys_(2 * n) {}

    void set(std::size_t position, std::uint32_t key) {
        for (std::size_t i = position + n_; i > 0 && keys_[i] < key; i /= 2) keys_[i] = key;
    }

    /// Maximum over positions in [first, last); 0 if empty.
    [[nodiscard]] std::uint32_t among(std::size_t first, std::size_t last) const {
        std::uint32_t highest = 0;
        for (first += n_, last += n_; first < last; first /= 2, last /= 2) {
            if (first % 2 == 1) highest = std::max(highest, keys_[first++]);
            if (last % 2 == 1) highest = std::max(highest, keys_[--last]);
        }
        return highest;
    }

  private:
    std::size_t n_;
    std::vector<std::uint32_t> keys_;
};

/// A range [first, last) of positions (see Sweep) and the ranks at its sides. On the torus the
/// range may extend past 0 or n, by at most one turn of n positions.
struct Width {
    std::int64_t first;
    std::int64_t last;
    Interval between;
};

/// Sweeps upwards over points. A point's position is its index in grid.order[0]. Points below the
/// current one have keys that increase with height. On the torus, points above it count as their
/// copies one turn down, with lower keys.
class Sweep {
  public:
    Sweep(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run)
        : grid_(grid),
          limits_(limits),
          run_(run),
          torus_(grid.torus()),
          n_(static_cast<std::int64_t>(grid.count)),
          end_(static_cast<std::uint32_t>(grid.values[0].size() - 1)),
          margin_(grid.all_digits <= 52 ? 0 : 0x1p-48),
          keys_(grid.count),
          first_at_(grid.values[0].size() + 1),
          position_of_(grid.count),
          worst_(grid) {
        for (const std::uint32_t rank : grid.ranks[0]) ++first_at_[rank + 1];
        for (std::size_t a = 1; a < first_at_.size(); ++a) first_at_[a] += first_at_[a - 1];
        for (std::size_t position = 0; position < grid.count; ++position)
            position_of_[grid.order[0][position]] = static_cast<std::uint32_t>(position);
    }

    SearchResult run() {
        const bool complete = sweep();
        if (!complete) offer_gaps();
        return result_of_sweep(worst_, complete, limits_, run_);
    }

  private:
    /// Offers all maximal rectangles; returns false if a deadline or a stop ended the sweep.
    bool sweep() {
        const auto& upward = grid_.order[1];
        const std::size_t n = upward.size();
        if (torus_) {
            for (std::size_t i = 0; i < n; ++i) enter(upward[i], i + 1);
            offer_full_heights();
        }
        const std::size_t ceiling = grid_.values[1].size() - 1;
        for (std::size_t first = 0, last = 0; first < n; first = last) {
            const std::uint32_t top = grid_.ranks[1][upward[first]];
            for (; last < n && grid_.ranks[1][upward[last]] == top; ++last) {
                if (last % 1024 == 0) {
                    if (limits_.over(run_)) return false;
                    run_.tick(last, n);
                }
                follow_below(upward[last]);
            }
            // Points on the ceiling bound no rectangle from below.
            for (std::size_t i = first; i < last && (torus_ || top != ceiling); ++i)
                enter(upward[i], i + 1 + (torus_ ? n : 0));
        }
        if (!torus_) offer_below_ceiling();
        run_.tick(n, n);
        return true;
    }

    /// Offers the rectangles of full height between neighbouring ranks on the first axis.
    void offer_gaps() {
        const auto top = static_cast<std::uint32_t>(grid_.values[1].size() - 1);
        const Interval whole = torus_ ? Interval{0, 0} : Interval{0, top};
        for (std::uint32_t a = 0; a < end_; ++a) offer({a, a + 1}, whole);
    }

    void enter(std::uint32_t point, std::size_t key) {
        keys_.set(position_of_[point], static_cast<std::uint32_t>(key));
    }

    /// The point with this key. Requires key > 0.
    [[nodiscard]] std::uint32_t point_of(std::uint32_t key) const {
        return grid_.order[1][(key - 1) % grid_.count];
    }

    [[nodiscard]] std::uint32_t highest(const Width& width) const {
        const auto among = [this](std::int64_t first, std::int64_t last) {
            return keys_.among(static_cast<std::size_t>(first), static_cast<std::size_t>(last));
        };
        const auto [first, last, between] = width;
        if (first >= last) return 0;
        if (first < 0)
            return std::max(among(first + n_, std::min(last, std::int64_t{0}) + n_),
                            among(0, std::max(last, std::int64_t{0})));
        if (last > n_) return std::max(among(first, n_), among(0, last - n_));
        return among(first, last);
    }

    /// Replaces the largest rectangle so far if this one is larger.
    void offer(Interval across, Interval along) {
        const double area =
            grid_.length(0, across, Side::open) * grid_.length(1, along, Side::open);
        if (area <= worst_.value() - margin_) return;
        worst_.offer({.side = Side::open, .axes = {across, along}}, 0);
    }

    /// True if no rectangle of this width and of height <= `reach` exceeds the largest so far.
    [[nodiscard]] bool is_too_small(const Width& width, double reach) const {
        return grid_.length(0, width.between, Side::open) * reach <= worst_.value() - margin_;
    }

    /// Cuts the width at the points of `rank` and keeps the side with position `from`.
    void shrink(Width& width, std::uint32_t rank, std::int64_t from) const {
        const auto begin = static_cast<std::int64_t>(first_at_[rank]);
        const auto end = static_cast<std::int64_t>(first_at_[rank + 1]);
        const std::int64_t turn = begin < width.first ? n_ : end > width.last ? -n_ : 0;
        if (begin + turn < from) {
            width.first = end + turn;
            width.between.lower = rank;
        } else {
            width.last = begin + turn;
            width.between.upper = rank;
        }
    }

    /// Passes to offer() all maximal empty rectangles with this point on their upper side.
    void follow_below(std::uint32_t point) {
        const std::uint32_t rank = grid_.ranks[0][point];
        const std::uint32_t top = grid_.ranks[1][point];
        const bool on_a_wall = rank == 0 || rank == end_ || top == 0;
        if (!torus_ && on_a_wall) return;
        const double reach = torus_ ? 1 : grid_.values[1][top];
        Width width{first_at_[1], first_at_[end_], {0, end_}};
        if (torus_ && !cut_circle(rank, top, width)) return;
        while (!is_too_small(width, reach)) {
            const std::uint32_t key = highest(width);
            offer(width.between, {key == 0 ? 0 : grid_.ranks[1][point_of(key)], top});
            if (key == 0) return;
            const std::uint32_t next = grid_.ranks[0][point_of(key)];
            if (next == rank) return;
            shrink(width, next, first_at_[rank]);
        }
    }

    /// On the torus, offers the rectangle of full width from this point down to the next lower one,
    /// the cut. Sets `width` to the circle without the cut's rank. Returns false if the cut is
    /// straight below the point.
    bool cut_circle(std::uint32_t rank, std::uint32_t top, Width& width) {
        const std::uint32_t lowest = point_of(keys_.among(0, grid_.count));
        const std::uint32_t cut = grid_.ranks[0][lowest];
        offer({cut, cut}, {grid_.ranks[1][lowest], top});
        const auto begin = static_cast<std::int64_t>(first_at_[cut]);
        const auto end = static_cast<std::int64_t>(first_at_[cut + 1]);
        width =
            cut < rank ? Width{end, begin + n_, {cut, cut}} : Width{end - n_, begin, {cut, cut}};
        return cut != rank;
    }

    /// Offers all rectangles that reach the ceiling of the square. The rectangle over a range of
    /// positions ends at the highest point in the range, which then splits the range.
    void offer_below_ceiling() {
        const auto top = static_cast<std::uint32_t>(grid_.values[1].size() - 1);
        std::vector<Interval> open{{0, end_}};
        while (!open.empty()) {
            const Interval across = open.back();
            open.pop_back();
            const Width width{first_at_[across.lower + 1], first_at_[across.upper], across};
            if (is_too_small(width, 1)) continue;
            const std::uint32_t key = highest(width);
            offer(across, {key == 0 ? 0 : grid_.ranks[1][point_of(key)], top});
            if (key == 0) continue;
            const std::uint32_t middle = grid_.ranks[0][point_of(key)];
            open.push_back({across.lower, middle});
            open.push_back({middle, across.upper});
        }
    }

    /// Offers the rectangles of full height between neighbours along x on the torus.
    void offer_full_heights() {
        for (std::uint32_t a = 0; a < end_; ++a) offer({a, a + 1}, {0, 0});
        offer({end_, 0}, {0, 0});
    }

    const BoxGrid& grid_;
    const SearchLimits& limits_;
    const RunContext& run_;
    bool torus_;
    std::int64_t n_;
    std::uint32_t end_;  ///< last rank on the first axis
    double margin_;      ///< rounding error of areas in doubles; 0 if they are exact
    HighestKey keys_;
    std::vector<std::uint32_t> first_at_;     ///< position of the first point at each rank
    std::vector<std::uint32_t> position_of_;  ///< by point: its index in grid_.order[0]
    WorstBox worst_;
};

}  // namespace

SearchResult largest_empty_rectangle(const BoxGrid& grid, const SearchLimits& limits,
                                     const RunContext& run) {
    return Sweep(grid, limits, run).run();
}

}  // namespace stipple::discrepancy
