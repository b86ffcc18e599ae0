// SPDX-License-Identifier: MIT
//
// The places of a plane where points are, as the sites of a Voronoi diagram: each place once, and
// in an order in which neighbours are near in memory, which is faster by half for many points.
//
// Shape    1 <= n < 2^32 points of a rectangle of positive sides; those beyond count with its rim.
// Cost     O(n), O(m log m) for m points crowded into one cell; 60 bytes a point.
// Promise  which places there are, and their order, does not depend on the points' order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "core/run_context.hpp"
#include "math/periodic_voronoi.hpp"

namespace stipple {

struct PlanarSites {
    Vec2 sides;
    bool torus;                           ///< opposite sides of the rectangle are one
    std::vector<double> rows = {};        ///< x and y of each place, seen from the low corner
    std::vector<std::uint32_t> points{};  ///< of lowest index at each place
    double company = 0;                   ///< points in a point's cell of a grid with 2 on average

    [[nodiscard]] std::size_t count() const { return points.size(); }
    [[nodiscard]] PeriodicVoronoi diagram() const { return {sides, torus, rows}; }
};

/// @throws Error(cancelled)
PlanarSites planar_sites(std::span<const double> rows, const Box& box, bool torus,
                         const RunContext& run);

}  // namespace stipple
