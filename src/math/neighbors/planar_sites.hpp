// SPDX-License-Identifier: MIT
//
// The places of a plane where points are, as the sites of a Voronoi diagram: each place once, and
// in an order in which neighbours are near in memory, which is faster for many points. Their cells
// are cut out by a grid where they are spread about evenly (periodic_voronoi.hpp), and else by a
// search tree, of which each node is passed over that is nearer to no corner of the cell than the
// site itself.
//
// Shape    1 <= n < 2^32 points of a rectangle of positive sides; those beyond count with its rim.
// Cost     O(n), O(m log m) for m points crowded into one cell of the grid; 60 bytes a point. Cells
//          by the tree O(log n) each, 4 us for 10^5, but O(k) for k points of one circle with none
//          inside, of which each has to be looked at; 50 bytes a point for the tree.
// Promise  which places there are, and their order, does not depend on the points' order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "math/neighbors/kd_tree.hpp"
#include "math/neighbors/periodic_voronoi.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Points of one cell of the grid, on average, up to which it is faster than a tree.
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
    void cut_by_tree(std::size_t i, VoronoiCell& cell, double needed) const;

    const PlanarSites& sites_;
    std::optional<PeriodicVoronoi> grid_;
    std::optional<KdTree> tree_;
};

}  // namespace stipple
