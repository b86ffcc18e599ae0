// SPDX-License-Identifier: MIT
//
// Exact mass, first and second moments of a density over polygons. The density is constant on each
// pixel of a W x H grid over a rectangle, and is continued periodically (torus). By Green's theorem
//
//     integral of t^k rho(t, y) over P  =  closed integral of F_k(x, y) dy along P's edges,
//     F_k(x, y) = integral of t^k rho(t, y) dt from 0 to x,
//
// with F_k tabulated at the left side of each pixel. Edges are split at pixel boundaries; on each
// segment the integrand is a polynomial of degree at most 3, so Simpson's rule is exact.
//
// Cost    O(number of pixels that the edges cross); 32 bytes a pixel.
// Promise exact up to rounding, about 1e-15 times the mass of a row of pixels times the polygon's
//         height.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "math/neighbors/periodic_voronoi.hpp"

namespace stipple {

class DensityMoments {
  public:
    /// Tabulates the integrals of a density. @param values in row-major order from y = 0; the W x H
    /// pixels cover [0, sides]
    DensityMoments(std::size_t width, std::size_t height, std::span<const double> values,
                   Vec2 sides);

    /// Moments of a Voronoi cell about its site, which is at position `site`.
    [[nodiscard]] CellMoments operator()(const VoronoiCell& cell, Vec2 site) const;

    /// Integral of the density along a line segment.
    [[nodiscard]] double along(Vec2 from, Vec2 to) const;

  private:
    /// F_0, F_1, F_2 at the left side of a pixel, and its density.
    struct Pixel {
        double mass = 0;
        double first = 0;
        double second = 0;
        double density = 0;
    };

    /// A pixel of the periodic plane; x_low is the x of its left side, not reduced to [0, sides.x).
    struct Place {
        Pixel left;
        double x_low;
    };

    [[nodiscard]] Place place(std::int64_t column, std::int64_t row) const;
    [[nodiscard]] std::int64_t column_of(double x) const;
    [[nodiscard]] std::int64_t row_of(double y) const;
    template <class Visit>
    void walk(Vec2 from, Vec2 to, const Visit& visit) const;

    std::int64_t width_;
    std::int64_t height_;
    Vec2 sides_;
    Vec2 size_;                  ///< size of a pixel
    std::vector<Pixel> pixels_;  ///< width + 1 per row; the last one has the integrals of the row
};

}  // namespace stipple
