// SPDX-License-Identifier: MIT
#include "math/planar_sites.hpp"

#include <algorithm>
#include <cmath>

#include "math/point_grid.hpp"

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

}  // namespace

PlanarSites planar_sites(std::span<const double> rows, const Box& box, bool torus,
                         const RunContext& run) {
    PlanarSites sites{.sides = {box.extent(0), box.extent(1)}, .torus = torus};
    const auto n = static_cast<double>(rows.size() / 2);
    const GridFrame<2> frame({{0, 0}, {sites.sides.x, sites.sides.y}}, torus,
                             std::sqrt(2 * sites.sides.x * sites.sides.y / n), n + 64);
    const SortedPoints<2> sorted(frame, seen_from_corner(rows, box, torus), run);
    sites.company = sorted.mean_company();
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
