// SPDX-License-Identifier: MIT
#include "math/neighbors/planar_sites.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/neighbors/point_grid.hpp"

namespace stipple {
namespace {

struct Place {
    double x;
    double y;
    std::uint32_t point;
    auto operator<=>(const Place&) const = default;
};

/// Coordinates relative to the low corner; on the torus, points on upper faces move to lower ones.
std::vector<double> seen_from_corner(std::span<const double> rows, const Box& box, bool torus) {
    std::vector<double> seen(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double side = box.extent(i % 2);
        const double x = std::clamp(rows[i] - box.low[i % 2], 0.0, side);
        seen[i] = torus && x >= side ? 0.0 : x;
    }
    return seen;
}

/// Offsets of copies of the rectangle: itself and, on the torus, the eight around it.
std::vector<Vec2> copies_of(const PlanarSites& sites) {
    std::vector<Vec2> turns = {{0, 0}};
    for (const double right : {-1.0, 0.0, 1.0})
        for (const double up : {-1.0, 0.0, 1.0})
            if (sites.torus && (right != 0 || up != 0))
                turns.push_back({right * sites.sides.x, up * sites.sides.y});
    return turns;
}

}  // namespace

PlanarCells::PlanarCells(const PlanarSites& sites, const RunContext& run)
    : sites_(sites), turns_(copies_of(sites)) {
    if (sites.occupancy <= crowded_cell) {
        grid_.emplace(sites.sides, sites.torus, sites.rows);
        return;
    }
    run.need_memory(90 * static_cast<double>(turns_.size() * sites.count()),
                    "the triangulation of crowded points");
    std::vector<double> rows;
    rows.reserve(2 * turns_.size() * sites.count());
    for (const Vec2& turn : turns_)
        for (std::size_t i = 0; i < sites.count(); ++i)
            rows.insert(rows.end(), {sites.at(i).x + turn.x, sites.at(i).y + turn.y});
    triangles_.emplace(rows, run);
}

void PlanarCells::cut(std::size_t i, VoronoiCell& cell, double needed) const {
    if (grid_ && needed > 0) return grid_->cut_cell(i, cell, needed);
    if (grid_) return grid_->cut_exactly(i, cell);
    cut_by_neighbors(i, cell);
}

void PlanarCells::cut_by_neighbors(std::size_t i, VoronoiCell& cell) const {
    const Vec2 at = sites_.at(i);
    PeriodicVoronoi::start(sites_.sides, sites_.torus, at, static_cast<std::uint32_t>(i), cell);
    std::vector<CellCorner> planes(cell.corners().begin(), cell.corners().end());
    // A site on a wall is its own mirror image; this is moved outward to have a direction.
    constexpr std::array<Vec2, 4> outward = {Vec2{0, -1}, Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}};
    const double least = 1e-18 * (sites_.sides.x + sites_.sides.y);
    for (std::size_t k = 0; k < planes.size(); ++k)
        if (std::max(std::abs(planes[k].neighbor.x), std::abs(planes[k].neighbor.y)) < least)
            planes[k].neighbor = {least * outward[k].x, least * outward[k].y};
    const std::size_t count = sites_.count();
    // Also uses neighbours of copies: rounding may join a site to a copy of i, but not to i itself.
    for (std::size_t copy = 0; copy < turns_.size(); ++copy)
        triangles_->for_neighbors(copy * count + i, [&](std::size_t neighbor) {
            if (copy > 0 && neighbor >= count) return;
            const Vec2 site = sites_.at(neighbor % count);
            const Vec2& to = turns_[neighbor / count];
            const Vec2 turn{to.x - turns_[copy].x, to.y - turns_[copy].y};
            const Vec2 seen{(site.x - at.x) + turn.x, (site.y - at.y) + turn.y};
            planes.push_back({{}, seen, static_cast<std::uint32_t>(neighbor % count)});
        });
    cell.enclose(planes);
}

PlanarSites planar_sites(std::span<const double> rows, const Box& box, bool torus,
                         const RunContext& run) {
    PlanarSites sites{.sides = {box.extent(0), box.extent(1)}, .torus = torus};
    const auto n = static_cast<double>(rows.size() / 2);
    const GridFrame<2> frame({{0, 0}, {sites.sides.x, sites.sides.y}}, torus,
                             std::sqrt(2 * sites.sides.x * sites.sides.y / n), n + 64);
    const SortedPoints<2> sorted(frame, seen_from_corner(rows, box, torus), run);
    sites.occupancy = sorted.mean_occupancy();
    sites.rows.reserve(rows.size());
    sites.points.reserve(sorted.count());
    std::vector<Place> cell;
    for (std::size_t c = 0; c < frame.size(); ++c) {
        if (c % 4096 == 0) run.check_stop();
        cell.clear();
        for (std::size_t s = sorted.start(c); s < sorted.start(c + 1); ++s)
            cell.push_back({sorted[s][0], sorted[s][1], sorted.original(s)});
        std::ranges::sort(cell);
        const auto same = [](const Place& a, const Place& b) { return a.x == b.x && a.y == b.y; };
        cell.erase(std::unique(cell.begin(), cell.end(), same), cell.end());
        for (const Place& place : cell) {
            sites.rows.insert(sites.rows.end(), {place.x, place.y});
            sites.points.push_back(place.point);
        }
    }
    return sites;
}

}  // namespace stipple
