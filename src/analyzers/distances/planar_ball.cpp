// SPDX-License-Identifier: MIT
//
// The largest empty ball of the plane; its centre is a corner of the Voronoi cells.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>

#include "analyzers/distances/empty_ball.hpp"
#include "core/parallel.hpp"
#include "math/arithmetic/double_double.hpp"
#include "math/neighbors/planar_sites.hpp"
#include "math/neighbors/point_grid.hpp"

namespace stipple::analyzers {
namespace {

double squared_length(const Vec2& v) { return v.x * v.x + v.y * v.y; }

/// Recomputes a corner from the neighbours beyond its two edges, with higher accuracy than the
/// cell's cuts.
Vec2 refined(const CellCorner& before, const CellCorner& corner, double squared_reach) {
    const Vec2& a = before.neighbor;
    const Vec2& b = corner.neighbor;
    const auto limit = [](const Vec2& site) {
        return exact_product(0.5 * site.x, site.x) + exact_product(0.5 * site.y, site.y);
    };
    const DoubleDouble determinant = exact_product(a.x, b.y) + exact_product(-a.y, b.x);
    const auto solved = [&](double p, double q) {  // (limit(a) p - limit(b) q) / determinant
        const DoubleDouble sum = limit(a) * DoubleDouble{p} + limit(b) * DoubleDouble{-q};
        const double ratio = sum.high / determinant.high;
        return ratio + (sum + determinant * DoubleDouble{-ratio}).high / determinant.high;
    };
    const Vec2 found{solved(b.y, a.y), -solved(b.x, a.x)};
    const Vec2 change{found.x - corner.at.x, found.y - corner.at.y};
    // With nearly parallel edges a corner is uncertain anyway; keeps the corner as it was cut.
    return squared_length(change) < 1e-12 * squared_reach ? found : corner.at;
}

/// A cell whose farthest corner was at least as far as all known ones when the cell was cut.
struct Record {
    double squared_reach;
    std::size_t site;
};

/// Corners are compared with higher accuracy if the ratio of their squared distances exceeds this.
constexpr double tied = 1 - 1e-9;

std::vector<Record> best_cells(const PlanarCells& cells, std::size_t count, const RunContext& run) {
    constexpr std::uint64_t size = 2048;
    constexpr std::size_t most = 100;  // more ties occur only in periodic sets
    std::vector<std::vector<Record>> parts(block_count(count, size));
    std::atomic<double> best = 0;  // its timing changes which cells are examined, but no result
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

/// Distance of a place to the nearest point, given the approximate distance `about`.
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
                     std::sqrt(2.0) * mean_distance(*distances.box, points.count()), n + 64),
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
