// SPDX-License-Identifier: MIT
//
// Points in a grid of cells with any number of points each, to find those near a position.
//
//     distance^2 = sum_k d_k^2,    d_k = |p_k - q_k|,  on the torus min(d_k, side_k - d_k).
//
//     GridFrame      the cells, and which of them a ball may meet
//     SortedPoints   a fixed set of points, stored cell by cell
//     GrowingPoints  points added one by one; cells shrink as their number grows
//
// Shape    D dimensions; any box, including flat ones; points outside belong to the outer cells.
// Cost     visiting a ball: the cells that it meets, and their points. SortedPoints: 8 D + 4 bytes
//          per point, 4 per cell. GrowingPoints: 8 D + 4 bytes per point, 4 per cell, at most 2
//          cells per point.
// Promise  exact: a point is visited, once, if and only if its distance^2, computed in float64 by
//          the formula above, is at most radius * radius. This holds for any radius. The order is
//          always the same.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "core/domain.hpp"
#include "math/neighbors/spaced_points.hpp"
#include "stipple/run.hpp"

namespace stipple {

template <std::size_t D>
class GridFrame {
  public:
    using Point = std::array<double, D>;

    /// Makes cells with sides of at least `cell`, equal in each direction; larger ones if there
    /// would be more than `most_cells`.
    GridFrame(const Box& box, bool torus, double cell, double most_cells = 0x1p30) : torus_(torus) {
        for (std::size_t k = 0; k < D; ++k) {
            low_[k] = box.low[k];
            sides_[k] = box.extent(k);
        }
        while (divide(cell) > most_cells) cell *= 1.25;
        for (std::size_t k = 0; k < D; ++k) {
            strides_[k] = size_;
            size_ *= static_cast<std::size_t>(counts_[k]);
            scales_[k] = sides_[k] > 0 ? static_cast<double>(counts_[k]) / sides_[k] : 0;
            slacks_[k] = 1e-9 + 1e-15 * static_cast<double>(counts_[k]);
        }
    }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool torus() const { return torus_; }
    [[nodiscard]] double side(std::size_t k) const { return sides_[k]; }

    [[nodiscard]] std::size_t cell_of(const double* p) const {
        std::size_t cell = 0;
        for (std::size_t k = 0; k < D; ++k)
            cell += static_cast<std::size_t>(floor_of(k, place(k, p[k]))) * strides_[k];
        return cell;
    }

    [[nodiscard]] double squared_distance(const double* p, const double* q) const {
        return stipple::squared_distance<D>(p, q, sides_, torus_);
    }

    /// Calls visit(first, last) for ranges [first, last) of cells that together contain all points
    /// within the radius of p, until a call returns false. Returns true if none did.
    template <class Visit>
    bool visit(const double* p, double radius, Visit&& visit) const {
        return descend<D - 1>(p, radius * radius * (1 + 1e-9), 0, visit);
    }

  private:
    /// Divides each side into lengths of at least `cell`; returns the number of cells.
    double divide(double cell) {
        double cells = 1;
        for (std::size_t k = 0; k < D; ++k) {
            const double pieces = std::floor(sides_[k] / cell);
            counts_[k] = static_cast<std::int64_t>(std::clamp(pieces, 1.0, 0x1p40));
            cells *= static_cast<double>(counts_[k]);
        }
        return cells;
    }

    /// Position of x, in units of cells.
    [[nodiscard]] double place(std::size_t k, double x) const { return (x - low_[k]) * scales_[k]; }
    [[nodiscard]] std::int64_t floor_of(std::size_t k, double place) const {
        const auto last = static_cast<double>(counts_[k] - 1);
        return static_cast<std::int64_t>(std::clamp(place, 0.0, last));
    }

    /// Lower bound on the squared distance in direction k from position `place` to cell index
    /// `cell`. Either may be outside the box.
    [[nodiscard]] double gap(std::size_t k, double place, std::int64_t cell) const {
        const auto low = static_cast<double>(cell);
        place = std::clamp(place, 0.0, static_cast<double>(counts_[k]));  // moved to the box
        const double cells = std::max(low - place, place - (low + 1)) - slacks_[k];
        if (cells <= 0) return 0;
        const double distance = cells / scales_[k];
        return distance * distance;
    }

    /// Indices [from, to] of cells in direction k within sqrt(squared) of a position. On the torus
    /// they may be outside [0, counts_[k]), but no cell appears twice.
    struct Window {
        std::int64_t from;
        std::int64_t to;
        bool all;
    };
    [[nodiscard]] Window window(std::size_t k, double place, double squared) const {
        const std::int64_t cells = counts_[k];
        const double reach = std::sqrt(squared) * scales_[k] + slacks_[k];
        if (!(2 * reach + 1 < static_cast<double>(cells))) return {0, cells - 1, true};
        if (!torus_) return {floor_of(k, place - reach), floor_of(k, place + reach), false};
        const auto from = static_cast<std::int64_t>(std::floor(place - reach));
        const auto to = static_cast<std::int64_t>(std::floor(place + reach));
        if (to - from + 1 >= cells) return {0, cells - 1, true};
        return {from, to, false};
    }

    template <std::size_t K, class Visit>
    bool descend(const double* p, double squared, std::size_t base, Visit& visit) const {
        const double place = this->place(K, p[K]);
        const Window w = window(K, place, squared);
        const std::int64_t cells = counts_[K];
        if constexpr (K == 0) {
            const auto stretch = [&](std::int64_t from, std::int64_t to) {
                return from > to || visit(base + static_cast<std::size_t>(from),
                                          base + static_cast<std::size_t>(to) + 1);
            };
            return stretch(std::max<std::int64_t>(w.from, 0), std::min(w.to, cells - 1)) &&
                   stretch(w.from + cells, std::min<std::int64_t>(w.to, -1) + cells) &&
                   stretch(std::max(w.from, cells) - cells, w.to - cells);
        } else {
            for (std::int64_t c = w.from; c <= w.to; ++c) {
                const double rest = squared - (w.all && torus_ ? 0 : gap(K, place, c));
                if (rest < 0) continue;
                const std::int64_t wrapped = c < 0 ? c + cells : c < cells ? c : c - cells;
                const std::size_t at = base + static_cast<std::size_t>(wrapped) * strides_[K];
                if (!descend<K - 1>(p, rest, at, visit)) return false;
            }
            return true;
        }
    }

    bool torus_;
    Point low_{};
    Point sides_{};
    Point scales_{};  ///< cells per unit of length
    Point slacks_{};  ///< bound on rounding errors of a position, in cells
    std::array<std::int64_t, D> counts_{};
    std::array<std::size_t, D> strides_{};
    std::size_t size_ = 1;
};

/// A fixed set of points, renumbered 0, 1, ... cell by cell, in their original order within a cell.
template <std::size_t D>
class SortedPoints {
  public:
    /// @param rows fewer than 2^32 points, one after another.
    SortedPoints(const GridFrame<D>& frame, std::span<const double> rows, const RunContext& run)
        : frame_(frame), starts_(frame.size() + 1), order_(rows.size() / D), rows_(rows.size()) {
        std::vector<std::uint32_t> cells(order_.size());
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (i % 65536 == 0) run.check_stop();
            cells[i] = static_cast<std::uint32_t>(frame_.cell_of(rows.data() + i * D));
            ++starts_[cells[i] + 1];
        }
        for (std::size_t c = 0; c < frame.size(); ++c) starts_[c + 1] += starts_[c];
        std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (i % 65536 == 0) run.check_stop();
            const std::uint32_t to = next[cells[i]]++;
            order_[to] = static_cast<std::uint32_t>(i);
            std::copy_n(rows.data() + i * D, D, rows_.data() + std::size_t{to} * D);
        }
    }

    [[nodiscard]] const GridFrame<D>& frame() const { return frame_; }
    [[nodiscard]] std::size_t count() const { return order_.size(); }

    /// Original index of point s.
    [[nodiscard]] std::uint32_t original(std::size_t s) const { return order_[s]; }
    [[nodiscard]] const double* operator[](std::size_t s) const { return rows_.data() + s * D; }

    /// Index of the first point in cell c or a later one; count() after the last cell.
    [[nodiscard]] std::uint32_t start(std::size_t c) const { return starts_[c]; }

    /// For each s in [from, to), calls visit(s, first, last) for ranges of points after s that
    /// contain all those within the radius of s. So every pair is visited once.
    template <class Visit>
    void visit_pairs(std::size_t from, std::size_t to, double radius, const RunContext& run,
                     const Visit& visit) const {
        constexpr std::size_t between_looks = std::size_t{1} << 21;  // pairs per stop check
        std::size_t looked = 0;
        for (std::size_t s = from; s < to; ++s) {
            frame_.visit((*this)[s], radius, [&](std::size_t first, std::size_t last) {
                const std::size_t begin = std::max<std::size_t>(starts_[first], s + 1);
                if (begin >= starts_[last]) return true;
                visit(s, begin, std::size_t{starts_[last]});
                looked += starts_[last] - begin;
                return true;
            });
            if (++looked < between_looks) continue;
            run.check_stop();
            looked = 0;
        }
    }

    /// Mean number of points in a point's cell, itself included.
    [[nodiscard]] double mean_occupancy() const {
        double squares = 0;
        for (std::size_t c = 0; c + 1 < starts_.size(); ++c) {
            const double points = starts_[c + 1] - starts_[c];
            squares += points * points;
        }
        return squares / static_cast<double>(std::max<std::size_t>(count(), 1));
    }

    /// Removes point s, so that it is not visited any more.
    void remove(std::size_t s) {
        rows_[s * D] = std::numeric_limits<double>::quiet_NaN();  // not within any radius
    }

    /// Calls visit(s, distance^2) for every point within the radius of p.
    template <class Visit>
    void visit(const double* p, double radius, Visit&& visit) const {
        const double most = radius * radius;
        frame_.visit(p, radius, [&](std::size_t first, std::size_t last) {
            // Hits are stored before they are visited: a branch would often be mispredicted.
            constexpr std::size_t some = 32;
            std::array<double, some> squares;
            std::array<std::size_t, some> hits;
            for (std::size_t s = starts_[first]; s < starts_[last];) {
                const std::size_t end = std::min<std::size_t>(starts_[last], s + some);
                std::size_t found = 0;
                for (; s < end; ++s) {
                    squares[found] = frame_.squared_distance(p, (*this)[s]);
                    hits[found] = s;
                    found += squares[found] <= most;
                }
                for (std::size_t i = 0; i < found; ++i) visit(hits[i], squares[i]);
            }
            return true;
        });
    }

  private:
    GridFrame<D> frame_;
    std::vector<std::uint32_t> starts_;  ///< first point of each cell
    std::vector<std::uint32_t> order_;
    std::vector<double> rows_;
};

/// Points added one by one, numbered 0, 1, ...
template <std::size_t D>
class GrowingPoints {
  public:
    using Point = typename GridFrame<D>::Point;

    GrowingPoints(Box box, bool torus)
        : box_(std::move(box)), frame_(box_, torus, infinity), buckets_(1) {}

    [[nodiscard]] const GridFrame<D>& frame() const { return frame_; }
    [[nodiscard]] std::size_t count() const { return rows_.size() / D; }
    [[nodiscard]] const double* operator[](std::size_t i) const { return rows_.data() + i * D; }
    [[nodiscard]] const std::vector<double>& rows() const { return rows_; }

    /// Bytes for `points` points, with room to grow.
    static double memory(double points) { return points * (16 * D + 1.5 * sizeof(Bucket)); }

    void add(const double* p) {
        rows_.insert(rows_.end(), p, p + D);
        if (count() > 2 * filled_at_)
            divide();
        else
            link(count() - 1);
    }

    /// Calls visit(i, distance^2), or visit(i, distance^2, coordinates), for every point within the
    /// radius of p until a call returns false. Returns true if none did.
    template <class Visit>
    bool visit(const double* p, double radius, Visit&& visit) const {
        const double most = radius * radius;
        return frame_.visit(p, radius, [&](std::size_t first, std::size_t last) {
            for (std::size_t c = first; c < last; ++c)
                for (std::size_t b = c; b != none; b = buckets_[b].next)
                    if (!visit_bucket(buckets_[b], p, most, visit)) return false;
            return true;
        });
    }

    /// True if some point is nearer to p than `radius`.
    [[nodiscard]] bool any_nearer(const double* p, double radius) const {
        const double most = radius * radius;
        return !visit(p, radius, [&](std::size_t, double squared) { return squared >= most; });
    }

    /// Squared distance to the nearest point, infinity if there is none. `guess` > 0 is the initial
    /// search radius; best slightly above the true distance.
    [[nodiscard]] double nearest_squared(const double* p, double guess) const {
        if (count() == 0) return infinity;
        double least = infinity;
        for (double radius = guess; least == infinity; radius *= 2)
            visit(p, radius, [&](std::size_t, double squared) {
                least = std::min(least, squared);
                return true;
            });
        return least;
    }

  private:
    static constexpr std::uint32_t none = 0xffff'ffff;
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    /// A few points of a cell, contiguous in memory.
    struct Bucket {
        static constexpr std::uint32_t room = 4;
        std::array<double, room * D> rows{};
        std::array<std::uint32_t, room> points{};
        std::uint32_t size = 0;
        std::uint32_t next = none;  ///< next bucket of the same cell
    };

    template <class Visit>
    bool visit_bucket(const Bucket& bucket, const double* p, double most, Visit& visit) const {
        for (std::size_t s = 0; s < bucket.size; ++s) {
            const double* q = bucket.rows.data() + s * D;
            const double squared = frame_.squared_distance(p, q);
            if (squared > most) continue;
            if constexpr (std::is_invocable_v<Visit&, std::size_t, double>) {
                if (!visit(bucket.points[s], squared)) return false;
            } else {
                if (!visit(bucket.points[s], squared, q)) return false;
            }
        }
        return true;
    }

    void link(std::size_t i) {
        std::size_t b = frame_.cell_of((*this)[i]);
        while (buckets_[b].size == Bucket::room) {
            if (buckets_[b].next == none) {
                buckets_[b].next = static_cast<std::uint32_t>(buckets_.size());
                buckets_.emplace_back();
            }
            b = buckets_[b].next;
        }
        Bucket& bucket = buckets_[b];
        bucket.points[bucket.size] = static_cast<std::uint32_t>(i);
        std::copy_n((*this)[i], D, bucket.rows.data() + bucket.size++ * D);
    }

    /// Makes about as many cells as there are points, and distributes the points again.
    void divide() {
        filled_at_ = count();
        const auto points = static_cast<double>(filled_at_);
        double cell = box_.extent(0);
        for (std::size_t k = 1; k < D; ++k) cell = std::max(cell, box_.extent(k));
        // Repeated division instead of a root: bits must not depend on a library's pow().
        const auto cells_of = [&](double side) {
            double cells = 1;
            for (std::size_t k = 0; k < D; ++k)
                cells *= std::max(1.0, std::floor(box_.extent(k) / side));
            return cells;
        };
        while (cell > 0 && cells_of(cell / 1.125) <= points) cell /= 1.125;
        frame_ = GridFrame<D>(box_, frame_.torus(), cell > 0 ? cell : infinity);
        buckets_.assign(frame_.size(), {});
        for (std::size_t i = 0; i < count(); ++i) link(i);
    }

    Box box_;
    GridFrame<D> frame_;
    std::vector<Bucket> buckets_;  ///< the first bucket of each cell, then further ones
    std::vector<double> rows_;
    std::size_t filled_at_ = 0;  ///< number of points when the cells were last made
};

}  // namespace stipple
