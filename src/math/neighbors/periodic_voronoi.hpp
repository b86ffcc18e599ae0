// SPDX-License-Identifier: MIT
//
// Voronoi and power cells of sites in a rectangle, opposite sides of which may be joined (torus):
//
//     cell(i) = { x : |x - x_i|^2 - w_i <= |x - x_j|^2 - w_j  for all sites and their copies j },
//
// all w equal for Voronoi's. Each cell is cut out by itself, from the rectangle (torus: the one
// about the site, which is what a site's own copies leave of the plane) by one neighbour after the
// other, the nearest first, until those that are left are too far away to reach it:
//
//     |x_j - x_i| >= R + sqrt(R^2 + max w - w_i),    R the distance of the cell's farthest corner.
//
// So cells may be made by any number of threads, and sites may come, go and move at any time. The
// corners are the centres of the empty circles through three sites: Delaunay's triangles.
//
// Shape   any number of sites from 1 on, in [0, side]^2; corners counterclockwise.
// Cost    about 1.3 us a cell where sites are spread evenly; 26 bytes a site, 8 more with weights.
// Promise the bits of a cell depend on the sites and weights alone, not on their order in memory,
//         nor on those of other cells. Of sites in one place with equal weights the one with the
//         least index has the cell, and the others none.
// Beware  cells are cut independently: four sites on a circle may be seen as neighbours, or not, by
//         one cell only, through an edge of the size of rounding (some 1e-16 of the rectangle).
//         A site with a weight below others' may be outside its cell, or have none.
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

/// A point or a vector of the plane.
struct Vec2 {
    double x = 0;
    double y = 0;
};

/// A corner of a cell, and the edge that leaves it.
struct CellCorner {
    static constexpr std::uint32_t wall = 0xffff'ffff;

    Vec2 at;        ///< seen from the cell's site
    Vec2 neighbor;  ///< the site beyond the edge, seen from the cell's own, whose mirror
                    ///< image stands beyond a wall
    std::uint32_t site = wall;  ///< its index: the cell's own where it is a copy
};

/// Moments of a cell's area about its site.
struct CellMoments {
    double mass = 0;
    Vec2 first;         ///< integral of x
    double second = 0;  ///< integral of |x|^2
};

/// A convex polygon about a site, with room to work in; use one again for many cells.
class VoronoiCell {
  public:
    [[nodiscard]] std::span<const CellCorner> corners() const { return corners_; }
    [[nodiscard]] bool empty() const { return corners_.empty(); }

    /// Squared distance of the farthest corner from the site.
    [[nodiscard]] double squared_reach() const { return squared_reach_; }

    /// That corner, the first of several.
    [[nodiscard]] Vec2 farthest_corner() const;

    [[nodiscard]] CellMoments moments() const;

    /// Makes it the rectangle, whose four sides are neighbours or walls.
    void start(const std::array<CellCorner, 4>& corners);

    /// Keeps the part with x . neighbor <= bound, whose new edge is towards `neighbor`.
    void cut(const Vec2& neighbor, double bound, std::uint32_t site);

    /// Makes it what the planes x . neighbor <= |neighbor|^2 / 2 leave that lie around the site, of
    /// which only `neighbor` and `site` are looked at. They may stand in any order.
    void enclose(std::vector<CellCorner>& planes);

    void clear() {
        corners_.clear();
        squared_reach_ = 0;
    }

  private:
    friend class PeriodicVoronoi;
    struct Candidate {
        double squared;  ///< distance
        Vec2 seen;
        std::uint32_t site;
    };
    void measure_reach();

    std::vector<CellCorner> corners_;
    std::vector<CellCorner> spare_;
    std::vector<double> beyond_;  ///< how far each corner is beyond the line that cuts
    std::vector<Candidate> candidates_;
    double squared_reach_ = 0;
};

class PeriodicVoronoi {
  public:
    /// A rectangle [0, x] x [0, y] without sites; `expected` of them will be in it, evenly unless
    /// `uneven`.
    PeriodicVoronoi(Vec2 sides, bool torus, std::size_t expected, bool uneven = false,
                    const RunContext& run = {});

    /// The sites are rows (x, y), numbered from 0.
    PeriodicVoronoi(Vec2 sides, bool torus, std::span<const double> rows, bool uneven = false,
                    const RunContext& run = {});

    [[nodiscard]] Vec2 sides() const { return sides_; }
    [[nodiscard]] bool torus() const { return torus_; }
    [[nodiscard]] std::size_t count() const { return sites_.size(); }
    [[nodiscard]] Vec2 operator[](std::size_t i) const { return sites_[i].at; }

    /// Puts site i, which is in no place yet, to `at`.
    void insert(std::size_t i, Vec2 at);
    void remove(std::size_t i);
    void move(std::size_t i, Vec2 to);

    /// One weight a site; none: all equal.
    void set_weights(std::span<const double> weights);

    /// Makes the cell what site i at `at` has before others cut it.
    static void start(Vec2 sides, bool torus, Vec2 at, std::uint32_t i, VoronoiCell& cell);

    /// The cell of a site that is in its place; one without a corner at a squared distance of
    /// `needed` is not finished. Several threads may ask at once.
    void cut_cell(std::size_t i, VoronoiCell& cell, double needed = 0) const;

    /// `at`, moved by whole sides into [0, side) on the torus, else to the nearest wall if outside.
    [[nodiscard]] Vec2 inside(Vec2 at) const;

    /// The way from one place to another, on the torus the shortest of all.
    [[nodiscard]] Vec2 shortest(Vec2 from, Vec2 to) const;

  private:
    static constexpr std::uint32_t none = 0xffff'ffff;
    struct Site {
        Vec2 at;
        std::uint32_t next = none;  ///< in the same cell of the grid
        std::uint32_t cell = none;
    };

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
    Vec2 size_;                         ///< of a cell of the grid
    std::vector<std::uint32_t> heads_;  ///< first site in each cell of the grid
    std::vector<Site> sites_;
    std::vector<double> weights_;
    double largest_weight_ = 0;
};

}  // namespace stipple
