// SPDX-License-Identifier: MIT
//
// Delaunay triangulation of points of the plane: no point is inside the circle through a triangle's
// corners. Points are inserted one after the other, in rounds of twice as many, along a Hilbert curve
// in each; edges are flipped until each is Delaunay.
//
// Shape    1 <= n < 2^31 points, however crowded, on lines or on circles. Of several in one place the
//          first to be inserted has neighbours, and the others none.
// Cost     O(n log n) expected for every arrangement: about 1.5 us a point; 75 bytes a point.
// Promise  a triangulation always: on which side of an edge a point is, is decided exactly. A point
//          is inside no circle by more than 1e-28 of its size; of points on one circle the triangles
//          are one choice of several.
// Source   N. Amenta, S. Choi, G. Rote, "Incremental constructions con BRIO", SoCG 2003,
//          doi:10.1145/777792.777824 (order); C. L. Lawson, "Software for C1 surface
//          interpolation", 1977 (flips); J. R. Shewchuk, Discrete Comput. Geom. 18 (1997) 305-363,
//          doi:10.1007/PL00009321 (bounds of rounding).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

/// The side of the line from a to b where c is: +1 left, -1 right, 0 on it; exactly.
int side_of_line(const double* a, const double* b, const double* c);

class Delaunay {
  public:
    /// @param rows x and y of each point @throws Error(cancelled)
    Delaunay(std::span<const double> rows, const RunContext& run);

    /// Calls take(j) for the points j that share an edge with i, counterclockwise.
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
    static constexpr std::uint32_t outer = 4;  ///< corners of a square around all, far away

    /// Corners counterclockwise; across[k] is the triangle beyond the edge opposite to corner k.
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
    std::vector<std::uint32_t> triangle_of_;  ///< one at each point
    std::vector<std::uint32_t> unsure_;  ///< triangles whose edge opposite to the new point may go
    std::uint32_t last_ = 0;             ///< triangle at the last point
};

}  // namespace stipple
