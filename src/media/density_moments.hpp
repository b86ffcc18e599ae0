// SPDX-License-Identifier: MIT
//
// Mass, first and second moments of a density over polygons, exactly: the density is constant on
// each pixel of a W x H grid over a rectangle, and is repeated beyond it (torus). By Green's
// theorem
//
//     integral of t^k rho(t, y) over P  =  closed integral of F_k(x, y) dy along P's edges,
//     F_k(x, y) = integral of t^k rho(t, y) dt from 0 to x,
//
// with F_k tabulated at the left side of each pixel. Edges are parted where they cross the sides of
// pixels; on a part the integrand is a polynomial of degree 3 at most, so that Simpson's rule is
// exact.
//
// Cost    O(pixels that the edges cross); 32 bytes a pixel.
// Promise exact up to rounding, some 1e-15 of the mass of a row of pixels times a polygon's height.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "math/neighbors/periodic_voronoi.hpp"

namespace stipple {

class DensityMoments {
  public:
    /// Values row after row from y = 0; W x H of them cover [0, sides].
    DensityMoments(std::size_t width, std::size_t height, std::span<const double> values,
                   Vec2 sides);

    /// Moments of the cell about its site, which is at `site`.
    [[nodiscard]] CellMoments operator()(const VoronoiCell& cell, Vec2 site) const;

    /// Integral of the density along a straight line.
    [[nodiscard]] double along(Vec2 from, Vec2 to) const;

  private:
    /// F_0, F_1, F_2 at the left side of a pixel, and its density.
    struct Pixel {
        double mass = 0;
        double first = 0;
        double second = 0;
        double density = 0;
    };

    /// One pixel of the plane; x_low is its left side, in the plane as well.
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
    Vec2 size_;                  ///< of a pixel
    std::vector<Pixel> pixels_;  ///< rows of width + 1: the last are the sums of whole rows
};

}  // namespace stipple
