// SPDX-License-Identifier: MIT
//
// The distinct positions of points in the plane, as sites of a Voronoi diagram. They are in an
// order in which neighbours are close in memory, which is faster for many points. Their cells are
// computed by a grid if they are about evenly spread (periodic_voronoi.hpp), otherwise from their
// neighbours in a Delaunay triangulation.
//
// Shape    1 <= n < 2^32 points in a rectangle with positive sides; points outside are moved to its
//          rim.
// Cost     O(n), O(m log m) for m points crowded into one cell of the grid; 60 bytes per point.
//          Cells by the triangulation: O(n log n) for any arrangement, 2 us each, 15 on the torus,
//          where it contains nine copies of each site; 90 bytes per copy.
// Promise  sites and their order do not depend on the order of the points.
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

/// Largest `occupancy` for which the grid is faster than the triangulation.
constexpr double crowded_cell = 24;

struct PlanarSites {
    Vec2 sides;
    bool torus;                           ///< opposite sides of the rectangle are joined
    std::vector<double> rows = {};        ///< x and y of each site, relative to the low corner
    std::vector<std::uint32_t> points{};  ///< lowest index of the points at each site
    /// Number of points in the cell of a point, mean over all points, for a grid of n / 2 cells.
    double occupancy = 0;

    [[nodiscard]] std::size_t count() const { return points.size(); }
    [[nodiscard]] Vec2 at(std::size_t i) const { return {rows[2 * i], rows[2 * i + 1]}; }
};

/// Finds the distinct positions of the points in `rows`. @throws Error(cancelled)
PlanarSites planar_sites(std::span<const double> rows, const Box& box, bool torus,
                         const RunContext& run);

class PlanarCells {
  public:
    /// Keeps a reference to the sites. @throws Error(limit, cancelled)
    PlanarCells(const PlanarSites& sites, const RunContext& run);

    /// Computes the i-th cell. May stop early once the squared distance of every corner
    /// from the site is below `needed`. Thread-safe.
    void cut(std::size_t i, VoronoiCell& cell, double needed = 0) const;

  private:
    void cut_by_neighbors(std::size_t i, VoronoiCell& cell) const;

    const PlanarSites& sites_;
    std::vector<Vec2> turns_;  ///< offsets of the copies of the rectangle
    std::optional<PeriodicVoronoi> grid_;
    std::optional<Delaunay> triangles_;  ///< only for crowded points: the sites, then their copies
};

}  // namespace stipple
