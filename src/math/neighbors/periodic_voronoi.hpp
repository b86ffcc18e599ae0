// SPDX-License-Identifier: MIT
//
// Voronoi and power cells of sites in a rectangle, whose opposite sides may be joined (torus):
//
//     cell(i) = { x : |x - x_i|^2 - w_i <= |x - x_j|^2 - w_j  for all sites and their copies j },
//
// with equal w for Voronoi cells. Each cell is computed separately. It starts as the rectangle; on
// the torus as the rectangle centred at the site, since the site's own copies cut off the rest.
// Neighbours then cut it, the nearest first, until the others are too far away to reach it:
//
//     |x_j - x_i| >= R + sqrt(R^2 + max w - w_i),    R the distance of the cell's farthest corner.
//
// So any number of threads can compute cells, and sites can be added, removed and moved. The
// corners are the centres of empty circles through three sites: the Delaunay triangles.
//
// Shape   any number of sites from 1 on, in [0, sides]; corners counterclockwise.
// Cost    about 1.3 us per cell for evenly spread sites; 26 bytes per site, 8 more with weights.
// Promise the bits of a cell depend only on the sites and weights, not on their order in memory or
//         on other cells. Of equal sites with equal weights the one with the lowest index has the
//         cell, and the others have empty ones.
// Beware  cells are cut independently. For four sites on a circle, rounding may give a cell a tiny
//         edge (about 1e-16 of the rectangle) to a neighbour whose cell has no edge in return. A
//         site with a lower weight than others may be outside its cell, or have an empty one.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "stipple/run.hpp"

namespace stipple {

struct Vec2 {
    double x = 0;
    double y = 0;
};

/// A corner of a cell, and the edge that begins there.
struct CellCorner {
    static constexpr std::uint32_t wall = 0xffff'ffff;

    Vec2 at;        ///< relative to the cell's site
    Vec2 neighbor;  ///< site across the edge, relative to this one; this one mirrored, at a wall
    std::uint32_t site = wall;  ///< index of that site, which its copies on the torus share
};

/// Moments of a cell's area, relative to its site.
struct CellMoments {
    double mass = 0;
    Vec2 first;         ///< integral of x
    double second = 0;  ///< integral of |x|^2
};

/// A convex polygon around a site, with scratch space; reuse it for many cells.
class VoronoiCell {
  public:
    [[nodiscard]] std::span<const CellCorner> corners() const { return corners_; }
    [[nodiscard]] bool empty() const { return corners_.empty(); }

    /// Squared distance of the farthest corner from the site.
    [[nodiscard]] double squared_reach() const { return squared_reach_; }

    /// The corner farthest from the site; the first one if several are equally far.
    [[nodiscard]] Vec2 farthest_corner() const;

    [[nodiscard]] CellMoments moments() const;

    /// Resets the cell to a rectangle, whose sides are neighbours or walls.
    void start(const std::array<CellCorner, 4>& corners);

    /// Keeps the part with x . neighbor <= bound, with a new edge towards `neighbor`.
    void cut(const Vec2& neighbor, double bound, std::uint32_t site);

    /// Sets the cell to the intersection of x . neighbor <= |neighbor|^2 / 2 over all planes. They
    /// must surround the site, may be in any order, and need only `neighbor` and `site`.
    void enclose(std::vector<CellCorner>& planes);

    void clear() {
        corners_.clear();
        squared_reach_ = 0;
    }

  private:
    friend class PeriodicVoronoi;
    struct Candidate {
        double squared;
        Vec2 seen;  ///< position relative to the cell's site
        std::uint32_t site;
    };
    void measure_reach();

    std::vector<CellCorner> corners_;
    std::vector<CellCorner> spare_;
    std::vector<double> beyond_;  ///< how far each corner is beyond the cutting line
    std::vector<Candidate> candidates_;
    double squared_reach_ = 0;
};

class PeriodicVoronoi {
  public:
    /// An empty rectangle from 0 to `sides`, for `expected` sites, evenly spread unless `uneven`.
    PeriodicVoronoi(Vec2 sides, bool torus, std::size_t expected, bool uneven = false,
                    const RunContext& run = {});

    /// A rectangle with sites at rows (x, y), numbered from 0.
    PeriodicVoronoi(Vec2 sides, bool torus, std::span<const double> rows, bool uneven = false,
                    const RunContext& run = {});

    [[nodiscard]] Vec2 sides() const { return sides_; }
    [[nodiscard]] bool torus() const { return torus_; }
    [[nodiscard]] std::size_t count() const { return sites_.size(); }
    [[nodiscard]] Vec2 operator[](std::size_t i) const { return sites_[i].at; }

    /// Adds site i at `at`. The rectangle must not contain site i yet.
    void insert(std::size_t i, Vec2 at);
    void remove(std::size_t i);
    void move(std::size_t i, Vec2 to);

    /// Sets a weight for each site; empty for equal weights.
    void set_weights(std::span<const double> weights);

    /// Resets `cell` to the rectangle of site i at `at`, not yet cut by other sites.
    static void start(Vec2 sides, bool torus, Vec2 at, std::uint32_t i, VoronoiCell& cell);

    /// Computes the cell of a site. Stops early once the squared distance of every corner
    /// from the site is below `needed`. Thread-safe.
    void cut_cell(std::size_t i, VoronoiCell& cell, double needed = 0) const;

    /// Like cut_cell(), for cells that may be tiny: their corners have a relative error of 1e-9
    /// even so. Without weights only.
    void cut_exactly(std::size_t i, VoronoiCell& cell) const;

    /// Moves `at` into [0, side) by whole sides on the torus; otherwise to the nearest wall.
    [[nodiscard]] Vec2 inside(Vec2 at) const;

    /// Vector from one position to another, the shortest one on the torus.
    [[nodiscard]] Vec2 shortest(Vec2 from, Vec2 to) const;

  private:
    static constexpr std::uint32_t none = 0xffff'ffff;
    struct Site {
        Vec2 at;
        std::uint32_t next = none;  ///< next site in the same grid cell
        std::uint32_t cell = none;
    };

    /// Cuts a cell that has been started.
    void cut_started(std::size_t i, VoronoiCell& cell, double needed) const;
    [[nodiscard]] std::int64_t column_of(double x) const;
    [[nodiscard]] std::int64_t row_of(double y) const;
    [[nodiscard]] double squared_security(double squared_reach, double weight) const;
    void gather_ring(const Site& site, std::int64_t ring, double squared_limit,
                     VoronoiCell& cell) const;
    void gather(const Site& site, std::int64_t column, std::int64_t row, double squared_limit,
                VoronoiCell& cell) const;
    void cut_by_candidates(std::uint32_t i, VoronoiCell& cell, double needed) const;

    Vec2 sides_;
    bool torus_;
    std::int64_t columns_ = 1;
    std::int64_t rows_ = 1;
    Vec2 size_;                         ///< size of a grid cell
    std::vector<std::uint32_t> heads_;  ///< first site in each grid cell
    std::vector<Site> sites_;
    std::vector<double> weights_;
    double largest_weight_ = 0;
};

}  // namespace stipple
