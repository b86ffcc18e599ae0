// SPDX-License-Identifier: MIT
//
// Delaunay triangulation of points in the plane: no point is inside the circumcircle of a triangle.
// Points are inserted one at a time, in rounds with twice as many points as the previous one, and
// along a Hilbert curve in each round. Edges are flipped until all are Delaunay.
//
// Shape    1 <= n < 2^31 points in any arrangement, also clustered, collinear or cocircular. Of
//          equal points, the first to be inserted has neighbours, and the others have none.
// Cost     O(n log n) expected for every arrangement: about 1.5 us per point; 75 bytes per point.
// Promise  always a triangulation: the side of an edge that a point is on is decided exactly. No
//          point is inside a circle by more than 1e-28 of its size. For cocircular points the
//          triangles are one of several choices.
// Source   N. Amenta, S. Choi, G. Rote, "Incremental constructions con BRIO", SoCG 2003,
//          doi:10.1145/777792.777824 (order); C. L. Lawson, "Software for C1 surface
//          interpolation", 1977 (flips); J. R. Shewchuk, Discrete Comput. Geom. 18 (1997) 305-363,
//          doi:10.1007/PL00009321 (error bounds).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

/// Side of the line from a to b that c is on, exactly: +1 left, -1 right, 0 on it.
int side_of_line(const double* a, const double* b, const double* c);

class Delaunay {
  public:
    /// @param rows x and y of each point
    /// @throws Error(cancelled)
    Delaunay(std::span<const double> rows, const RunContext& run);

    /// Calls take(j) for all points j that share an edge with i, in counterclockwise order.
    template <class Take>
    void for_neighbors(std::size_t i, const Take& take) const {
        const auto center = static_cast<std::uint32_t>(i) + outer;
        const std::uint32_t first = triangle_of_[center];
        if (first == none) return;
        for (std::uint32_t t = first;;) {
            const Triangle& triangle = triangles_[t];
            const std::size_t k = corner_of(triangle, center);
            const std::uint32_t next = triangle.corners[after(k)];
            if (next >= outer) take(static_cast<std::size_t>(next - outer));
            t = triangle.across[after(k)];
            if (t == first) return;
        }
    }

  private:
    static constexpr std::uint32_t none = 0xffff'ffff;
    static constexpr std::uint32_t outer = 4;  ///< corners of the outer square, before the points

    /// Corners in counterclockwise order; across[k]: triangle beyond the edge opposite corner k.
    struct Triangle {
        std::array<std::uint32_t, 3> corners;
        std::array<std::uint32_t, 3> across;
    };

    static std::size_t after(std::size_t k) { return k < 2 ? k + 1 : 0; }
    static std::size_t before(std::size_t k) { return k > 0 ? k - 1 : 2; }
    static std::size_t corner_of(const Triangle& triangle, std::uint32_t point) {
        return triangle.corners[0] == point ? 0 : triangle.corners[1] == point ? 1 : 2;
    }

    [[nodiscard]] const double* at(std::uint32_t point) const { return &places_[2 * point]; }
    void start(std::span<const double> rows);
    void insert(std::uint32_t point);
    [[nodiscard]] std::uint32_t locate(const double* place, std::size_t& on_edge) const;
    void split_triangle(std::uint32_t t, std::uint32_t point);
    void split_edge(std::uint32_t t, std::size_t k, std::uint32_t point);
    void set(std::uint32_t t, const Triangle& triangle);
    void relink(std::uint32_t t, std::uint32_t from, std::uint32_t to);
    void make_delaunay(std::uint32_t point);

    std::vector<double> places_;
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> triangle_of_;  ///< for each point, a triangle with this corner
    std::vector<std::uint32_t> unsure_;  ///< triangles whose edge opposite the new point may flip
    std::uint32_t last_ = 0;             ///< a triangle with the last inserted point
};

}  // namespace stipple
