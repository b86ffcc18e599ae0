// SPDX-License-Identifier: MIT
#include "analyzers/distances/empty_ball.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "math/arithmetic/double_double.hpp"
#include "math/combinatorics/radix_sort.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/incomplete_functions.hpp"
#include "math/functions/logarithm.hpp"
#include "math/neighbors/covering_bound.hpp"
#include "math/neighbors/kd_tree.hpp"
#include "math/neighbors/planar_sites.hpp"
#include "math/neighbors/point_grid.hpp"

namespace stipple::analyzers {
namespace {

/// Returns the coordinates in ascending order. A stop request ends the sort quickly.
std::vector<double> sorted(const PointSet& points, double low, const RunContext& run) {
    std::vector<Placed> items(points.count());
    for (std::size_t i = 0; i < items.size(); ++i)
        items[i] = {points[i][0] - low, static_cast<std::uint32_t>(i)};
    radix_sort(items, run);
    std::vector<double> x(items.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = points[items[i].place][0];
    return x;
}

/// Largest empty ball for d = 1: half of the widest gap of two points, or the whole gap at a wall.
EmptyBall widest_gap(const PointSet& points, const Distances& distances, const RunContext& run) {
    const double low = distances.box->low[0];
    const double high = distances.box->high[0];
    run.need_memory(40 * static_cast<double>(points.count()), "sorting the points");
    const std::vector<double> x = sorted(points, low, run);
    EmptyBall best{x.front() - low, 0, {low}};
    if (high - x.back() > best.radius) best = {high - x.back(), 0, {high}};
    if (distances.torus) {
        const double across = best.radius = (x.front() - low + (high - x.back())) / 2;
        const double center = x.back() + across;
        best.center = {center < high ? center : low + (center - high)};
    }
    for (std::size_t i = 1; i < x.size(); ++i) {
        const double half = (x[i] - x[i - 1]) / 2;
        if (half > best.radius) best = {half, 0, {x[i - 1] + half}};
    }
    best.upper = best.radius;
    run.tick(1, 1);
    return best;
}

/// A box of the search, with bounds of the radius of the largest ball centred in it.
struct Part {
    std::vector<double> center;
    std::vector<double> half;
    double upper = std::numeric_limits<double>::infinity();
    double lower = 0;  ///< radius of the largest ball found in the box
    std::vector<double> place = {};
};

/// Bounds are computed in coordinates about the box's centre, in units of the distances to nearby
/// points, so that the tolerance can be a constant.
using Bound = CoveringBound<0>;
constexpr double bound_tolerance = 1e-13;

class Search {
  public:
    Search(const PointSet& points, const Distances& distances, const BallSearch& search,
           const RunContext& run)
        : points_(points),
          box_(*distances.box),
          sides_(distances.sides()),
          search_(search),
          run_(run),
          tree_(points.flat(), points.dimension(), sides_, run.stage(0, 0.05)),
          neighbors_(std::min(points.count(), 4 * (points.dimension() + 1))) {
        const auto d = static_cast<double>(points.dimension());
        const double ball = real_power(std::numbers::pi, d / 2) / exponential(log_gamma(d / 2 + 1));
        // At this radius n balls have the volume of the box, so the covering radius is not smaller.
        // Parts with a larger half diagonal are halved without computing a bound.
        least_ = real_power(volume_of(box_) / ball / static_cast<double>(points.count()), 1 / d);
    }

    EmptyBall find() {
        open_.push_back(whole());
        const RunContext run = run_.stage(0.05, 1);
        std::vector<Part> round;
        while (!open_.empty()) {
            const auto size = std::min<std::size_t>(open_.size(), round_size);
            round.assign(std::make_move_iterator(open_.end() - static_cast<std::ptrdiff_t>(size)),
                         std::make_move_iterator(open_.end()));
            open_.resize(open_.size() - size);
            for_each_block(silent(run), size, 32, [&](const Block& b) {
                Bound bound(points_.dimension(), bound_tolerance);
                for (std::uint64_t i = b.first; i < b.last; ++i) judge(round[i], bound);
            });
            finish(round);
            run.tick(static_cast<std::uint64_t>(done_ * 1e9), 1'000'000'000);
        }
        run.tick(1, 1);
        best_.upper = std::max(best_.upper, best_.radius);
        return std::move(best_);
    }

  private:
    static constexpr std::size_t round_size = 2048;

    [[nodiscard]] Part whole() const {
        Part part;
        for (std::size_t k = 0; k < box_.dimension(); ++k) {
            part.half.push_back(box_.extent(k) / 2);
            part.center.push_back(box_.low[k] + box_.extent(k) / 2);
        }
        return part;
    }

    /// A part is not divided further if its upper bound is at most this radius.
    [[nodiscard]] double good_enough() const {
        const bool more = best_.radius > search_.enough;
        return more ? best_.radius * (1 + search_.tolerance) : search_.enough;
    }

    /// Adds the points near the part's centre to `bound`; on the torus, the nearest copy of each.
    /// Returns the bound's unit of length.
    double look_around(const Part& part, Bound& bound) const {
        const auto neighbors = tree_.nearest_several(part.center, neighbors_);
        const double unit =
            std::max({std::sqrt(neighbors.back().squared), std::ranges::max(part.half),
                      std::numeric_limits<double>::min()});
        bound.clear();
        for (const Neighbor& neighbor : neighbors) {
            const auto p = points_[neighbor.index];
            Bound::Point offset{};
            for (std::size_t k = 0; k < box_.dimension(); ++k) {
                offset[k] = p[k] - part.center[k];
                if (!sides_.empty() && offset[k] > sides_[k] / 2) offset[k] -= sides_[k];
                if (!sides_.empty() && offset[k] < -sides_[k] / 2) offset[k] += sides_[k];
                offset[k] /= unit;
            }
            bound.add(offset);
        }
        return unit;
    }

    void offer(Part& part, std::vector<double> place) const {
        const double radius = std::sqrt(tree_.nearest(place).squared);
        if (radius <= std::max(part.lower, best_.radius)) return;
        part.lower = radius;
        part.place = std::move(place);
    }

    void judge(Part& part, Bound& bound) const {
        double squared = 0;
        for (const double h : part.half) squared += h * h;
        if (std::sqrt(squared) > std::max(good_enough(), least_)) return;
        const double unit = look_around(part, bound);
        Bound::Point half{};
        for (std::size_t k = 0; k < part.half.size(); ++k) half[k] = part.half[k] / unit;
        constexpr double rounding = 1 + 1e-14;
        part.upper = std::sqrt(std::max(0.0, bound.squared(half))) * unit * rounding;
        offer(part, part.center);
        if (!(part.upper > std::max(part.lower, best_.radius))) return;
        const Bound::Point off = bound.place(half);
        std::vector<double> place = part.center;
        for (std::size_t k = 0; k < place.size(); ++k)
            place[k] = std::clamp(place[k] + off[k] * unit, box_.low[k], box_.high[k]);
        offer(part, std::move(place));
    }

    /// Merges the results of a round, and halves the parts whose bounds are too large.
    void finish(std::vector<Part>& round) {
        judged_ += round.size();
        for (Part& part : round) {
            if (part.lower <= best_.radius) continue;
            best_.radius = part.lower;
            best_.center = std::move(part.place);
        }
        for (Part& part : round) {
            if (part.upper <= good_enough()) {
                best_.upper = std::max(best_.upper, part.upper);
                done_ += share(part);
            } else {
                halve(part);
            }
        }
        if (judged_ > search_.max_boxes && !open_.empty()) give_up();
    }

    /// Fraction of the whole box's volume taken by the part.
    [[nodiscard]] double share(const Part& part) const {
        double share = 1;
        for (std::size_t k = 0; k < part.half.size(); ++k)
            share *= 2 * part.half[k] / box_.extent(k);
        return share;
    }

    void halve(Part& part) {
        const auto axis = static_cast<std::size_t>(
            std::distance(part.half.begin(), std::ranges::max_element(part.half)));
        part.half[axis] /= 2;
        for (const double sign : {-1.0, 1.0}) {
            open_.push_back({part.center, part.half});
            open_.back().center[axis] += sign * part.half[axis];
        }
    }

    [[noreturn]] void give_up() const {
        fail_with_hint(ErrorKind::limit, "a larger --max-boxes or --tolerance may help",
                       "the search for the largest empty ball of {} points in {} dimensions "
                       "exceeds {} boxes (--max-boxes); certain so far: its radius is at least {}",
                       points_.count(), points_.dimension(), search_.max_boxes,
                       format_number(best_.radius));
    }

    const PointSet& points_;
    const Box& box_;
    std::vector<double> sides_;
    const BallSearch& search_;
    const RunContext& run_;
    KdTree tree_;
    std::size_t neighbors_;  ///< number of nearby points used for a bound
    double least_;
    std::vector<Part> open_;
    EmptyBall best_{0, 0, {}};
    double done_ = 0;
    std::uint64_t judged_ = 0;
};

}  // namespace

EmptyBall bounded_empty_ball(const PointSet& points, const Distances& distances,
                             const BallSearch& search, const RunContext& run) {
    return Search(points, distances, search, run).find();
}

namespace {

/// For each axis the box's low end if it can be subtracted from all coordinates without rounding
/// (they differ from it by a factor of at most 2), else 0.
std::vector<double> origin_of(const Box& box) {
    std::vector<double> origin;
    for (std::size_t k = 0; k < box.dimension(); ++k) {
        const double low = box.low[k];
        const double high = box.high[k];
        origin.push_back((low > 0 && high <= 2 * low) || (high < 0 && low >= 2 * high) ? low : 0);
    }
    return origin;
}

}  // namespace

EmptyBall largest_empty_ball(const PointSet& points, const Distances& distances,
                             const BallSearch& search, const RunContext& run) {
    const std::size_t d = points.dimension();
    if (d == 1) return widest_gap(points, distances, run);
    const std::vector<double> origin = origin_of(*distances.box);
    if (std::ranges::any_of(origin, [](double x) { return x != 0; })) {
        // Far from 0 the coordinates of centres are coarse; seen from the box's corner they are not.
        PointSet seen(points.count(), d);
        Distances near = distances;
        for (std::size_t k = 0; k < d; ++k) {
            for (std::size_t i = 0; i < seen.count(); ++i) seen[i][k] = points[i][k] - origin[k];
            near.box->low[k] -= origin[k];
            near.box->high[k] -= origin[k];
        }
        EmptyBall ball = largest_empty_ball(seen, near, search, run);
        for (std::size_t k = 0; k < d; ++k) ball.center[k] += origin[k];
        return ball;
    }
    if (d == 2) return planar_empty_ball(points, distances, run);
    return bounded_empty_ball(points, distances, search, run);
}

// The largest empty ball of the plane; its centre is a corner of the Voronoi cells.
namespace {

double squared_length(const Vec2& v) { return v.x * v.x + v.y * v.y; }

/// Recomputes a corner, in higher precision, from the two neighbours whose bisectors meet there.
Vec2 refined(const CellCorner& before, const CellCorner& corner, double squared_reach) {
    const Vec2& a = before.neighbor;
    const Vec2& b = corner.neighbor;
    const auto limit = [](const Vec2& site) {
        return exact_product(0.5 * site.x, site.x) + exact_product(0.5 * site.y, site.y);
    };
    const DoubleDouble determinant = exact_product(a.x, b.y) + exact_product(-a.y, b.x);
    const auto solved = [&](double p, double q) {  // one coordinate, by Cramer's rule
        const DoubleDouble sum = limit(a) * DoubleDouble{p} + limit(b) * DoubleDouble{-q};
        const double ratio = sum.high / determinant.high;
        return ratio + (sum + determinant * DoubleDouble{-ratio}).high / determinant.high;
    };
    const Vec2 found{solved(b.y, a.y), -solved(b.x, a.x)};
    const Vec2 change{found.x - corner.at.x, found.y - corner.at.y};
    // A larger change means that the edges are nearly parallel: keeps the corner as it was cut.
    return squared_length(change) < 1e-12 * squared_reach ? found : corner.at;
}

/// A candidate cell: its farthest corner is at least as far from its site as any found before.
struct Record {
    double squared_reach;
    std::size_t site;
};

/// Corners are compared with higher accuracy if the ratio of their squared distances exceeds this.
constexpr double tied = 1 - 1e-9;

std::vector<Record> best_cells(const PlanarCells& cells, std::size_t count, const RunContext& run) {
    constexpr std::uint64_t size = 2048;
    constexpr std::size_t most = 100;  // only periodic sets have more ties
    std::vector<std::vector<Record>> parts(block_count(count, size));
    std::atomic<double> best = 0;  // when it is updated affects the work, not the result
    for_each_block(run, count, size, [&](const Block& b) {
        VoronoiCell cell;
        for (std::size_t i = b.first; i < b.last; ++i) {
            double known = best.load(std::memory_order_relaxed);
            cells.cut(i, cell, known * tied);
            if (cell.squared_reach() < known * tied) continue;
            parts[b.index].push_back({cell.squared_reach(), i});
            while (known < cell.squared_reach() &&
                   !best.compare_exchange_weak(known, cell.squared_reach())) {
            }
        }
    });
    std::vector<Record> records;
    for (const auto& part : parts)
        std::ranges::copy_if(part, std::back_inserter(records),
                             [&](const Record& r) { return r.squared_reach >= best * tied; });
    std::ranges::sort(records, [](const Record& a, const Record& b) {
        return a.squared_reach > b.squared_reach ||
               (a.squared_reach == b.squared_reach && a.site < b.site);
    });
    records.resize(std::min(records.size(), most));
    return records;
}

/// Distance of a position to the nearest point, given the approximate distance `about`.
double clearance(const SortedPoints<2>& points, const std::vector<double>& place, double about) {
    double least = std::numeric_limits<double>::infinity();
    points.visit(place.data(), about * (1 + 1e-6),
                 [&](std::size_t, double squared) { least = std::min(least, squared); });
    return std::sqrt(least);
}

/// Moves a coordinate into the box: wraps it on the torus, and clamps it to the walls.
double inside(const Distances& distances, std::size_t k, double x) {
    const Box& box = *distances.box;
    if (distances.torus && x < box.low[k]) x += box.extent(k);
    if (distances.torus && x > box.high[k]) x -= box.extent(k);
    return std::clamp(x, box.low[k], box.high[k]);
}

}  // namespace

EmptyBall planar_empty_ball(const PointSet& points, const Distances& distances,
                            const RunContext& run) {
    const PlanarSites sites =
        planar_sites(points.flat(), *distances.box, distances.torus, run.stage(0, 0.1));
    const PlanarCells cells(sites, run.stage(0.1, 0.2));
    const auto records = best_cells(cells, sites.count(), run.stage(0.2, 1));
    const auto n = static_cast<double>(points.count());
    const SortedPoints<2> sorted(
        GridFrame<2>(*distances.box, distances.torus,
                     std::sqrt(2.0) * mean_distance(*distances.box, n), n + 64),
        points.flat(), run);
    EmptyBall best{-1, 0, {}};
    VoronoiCell cell;
    for (const Record& record : records) {
        run.check_stop();
        cells.cut(record.site, cell);
        const auto p = points[sites.points[record.site]];
        const auto corners = cell.corners();
        for (std::size_t i = 0; i < corners.size(); ++i) {
            if (squared_length(corners[i].at) < (1 - 1e-6) * cell.squared_reach()) continue;
            const Vec2 v = refined(corners[i > 0 ? i - 1 : corners.size() - 1], corners[i],
                                   cell.squared_reach());
            const std::vector<double> center{inside(distances, 0, p[0] + v.x),
                                             inside(distances, 1, p[1] + v.y)};
            const double radius = clearance(sorted, center, std::sqrt(squared_length(v)));
            if (radius > best.radius && std::isfinite(radius)) best = {radius, radius, center};
        }
    }
    run.tick(1, 1);
    return best;
}

}  // namespace stipple::analyzers
