// SPDX-License-Identifier: MIT
//
// The places of a plane where points are, as the sites of a Voronoi diagram: each place once, and
// in an order in which neighbours are near in memory, which is faster for many points. Their cells
// are cut out by a grid where they are spread about evenly (periodic_voronoi.hpp), and else by their
// neighbours in a Delaunay triangulation.
//
// Shape    1 <= n < 2^32 points of a rectangle of positive sides; those beyond count with its rim.
// Cost     O(n), O(m log m) for m points crowded into one cell of the grid; 60 bytes a point. Cells
//          by the triangulation O(n log n) however crowded, 2 us each, 15 on the torus, where it
//          holds nine copies of each place; 90 bytes a copy.
// Promise  which places there are, and their order, does not depend on the points' order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "math/neighbors/delaunay.hpp"
#include "math/neighbors/periodic_voronoi.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Points of one cell of the grid, on average, up to which it is faster.
constexpr double crowded_cell = 24;

struct PlanarSites {
    Vec2 sides;
    bool torus;                           ///< opposite sides of the rectangle are one
    std::vector<double> rows = {};        ///< x and y of each place, seen from the low corner
    std::vector<std::uint32_t> points{};  ///< of lowest index at each place
    double occupancy = 0;                 ///< points in a point's cell of a grid with 2 on average

    [[nodiscard]] std::size_t count() const { return points.size(); }
    [[nodiscard]] Vec2 at(std::size_t i) const { return {rows[2 * i], rows[2 * i + 1]}; }
};

/// @throws Error(cancelled)
PlanarSites planar_sites(std::span<const double> rows, const Box& box, bool torus,
                         const RunContext& run);

/// The Voronoi cells of the places.
class PlanarCells {
  public:
    /// Keeps a reference to the sites. @throws Error(limit, cancelled)
    PlanarCells(const PlanarSites& sites, const RunContext& run);

    /// The i-th cell; one without a corner at a squared distance of `needed` is not finished.
    /// Several threads may ask at once.
    void cut(std::size_t i, VoronoiCell& cell, double needed = 0) const;

  private:
    void cut_by_neighbors(std::size_t i, VoronoiCell& cell) const;

    const PlanarSites& sites_;
    std::vector<Vec2> turns_;  ///< to the copies of the square that count
    std::optional<PeriodicVoronoi> grid_;
    std::optional<Delaunay> triangles_;  ///< of all places, and of their copies behind these
};

}  // namespace stipple
