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

/// Seen from the low corner; the torus' upper faces are its lower ones.
std::vector<double> seen_from_corner(std::span<const double> rows, const Box& box, bool torus) {
    std::vector<double> seen(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double side = box.extent(i % 2);
        const double x = std::clamp(rows[i] - box.low[i % 2], 0.0, side);
        seen[i] = torus && x >= side ? 0.0 : x;
    }
    return seen;
}

/// Whether a place of the box may be nearer to a corner of the cell of `at` than that is.
bool may_cut(const double* box, const Vec2& at, const VoronoiCell& cell) {
    constexpr double slack = 1 - 1e-9;
    for (const CellCorner& corner : cell.corners()) {
        const double x = at.x + corner.at.x;
        const double y = at.y + corner.at.y;
        const double dx = std::max({box[0] - x, x - box[2], 0.0});
        const double dy = std::max({box[1] - y, y - box[3], 0.0});
        const double own = corner.at.x * corner.at.x + corner.at.y * corner.at.y;
        if ((dx * dx + dy * dy) * slack < own) return true;
    }
    return false;
}

}  // namespace

PlanarCells::PlanarCells(const PlanarSites& sites, const RunContext& run) : sites_(sites) {
    if (sites.occupancy <= crowded_cell)
        grid_.emplace(sites.sides, sites.torus, sites.rows);
    else
        tree_.emplace(sites.rows, 2, std::vector<double>{}, run);
}

void PlanarCells::cut(std::size_t i, VoronoiCell& cell, double needed) const {
    if (grid_) return grid_->cut_cell(i, cell, needed);
    cut_by_tree(i, cell, needed);
}

/// On the torus by the copies of all sites, too, which are the sites as seen from a copy of the
/// cell's own.
void PlanarCells::cut_by_tree(std::size_t i, VoronoiCell& cell, double needed) const {
    const auto [width, height] = sites_.sides;
    const std::array all{0.0, 0.0, width, height};
    const Vec2 at = sites_.at(i);
    PeriodicVoronoi::start(sites_.sides, sites_.torus, at, static_cast<std::uint32_t>(i), cell);
    constexpr std::array<int, 9> right = {0, 1, -1, 0, 0, 1, 1, -1, -1};
    constexpr std::array<int, 9> up = {0, 0, 0, 1, -1, 1, -1, 1, -1};
    for (std::size_t copy = 0; copy < (sites_.torus ? 9 : 1); ++copy) {
        const Vec2 turn{right[copy] * width, up[copy] * height};
        const std::array from{at.x - turn.x, at.y - turn.y};
        const auto enter = [&](const double* box) {
            return cell.squared_reach() >= needed && may_cut(box, {from[0], from[1]}, cell);
        };
        if (!enter(all.data())) continue;
        tree_->walk(from.data(), enter, [&](std::size_t index, const double* row) {
            const Vec2 seen{(row[0] - at.x) + turn.x, (row[1] - at.y) + turn.y};
            const double bound = (seen.x * seen.x + seen.y * seen.y) / 2;
            if (index != i) cell.cut(seen, bound, static_cast<std::uint32_t>(index));
        });
    }
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
        cell.erase(std::ranges::unique(cell, same).begin(), cell.end());
        for (const Place& place : cell) {
            sites.rows.insert(sites.rows.end(), {place.x, place.y});
            sites.points.push_back(place.point);
        }
    }
    return sites;
}

}  // namespace stipple
