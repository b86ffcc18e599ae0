// SPDX-License-Identifier: MIT
//
// Coordinates along two edges e and f that start at a corner c, in the plane or in space:
//
//     p = c + s e + t f  (+ p's offset from the plane)     s = g . (p - c),  t = h . (p - c)
//
// where g and h lie in the plane of e and f, g . e = h . f = 1 and g . f = h . e = 0.
//
// Promise no overflow or underflow for edges between 1e-140 and 1e150.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "math/geometry/vector3.hpp"

namespace stipple {

/// Converts a point with two or three coordinates to space; two coordinates get z = 0.
[[gnu::always_inline]] inline Vector3 space_point(std::span<const double> point) {
    return {point[0], point[1], point.size() > 2 ? point[2] : 0};
}

/// The difference high + low of two points, exact unless it overflows.
struct ExactEdge {
    Vector3 high;
    Vector3 low{};
};

ExactEdge exact_edge(const Vector3& from, const Vector3& to);

class EdgeFrame {
  public:
    struct Coordinates {
        double s;
        double t;
    };

    /// @param size largest coordinate of the points generated with this frame
    EdgeFrame(const Vector3& corner, const ExactEdge& e, const ExactEdge& f, double size);
    EdgeFrame() = default;

    /// True if the edges span no area beyond rounding; then no other function may be called.
    [[nodiscard]] bool flat() const { return flat_; }

    [[nodiscard, gnu::always_inline]] Coordinates coordinates(const Vector3& point) const {
        const Vector3 d = minus(point, corner_);
        return {dot(g_, d), dot(h_, d)};
    }

    /// Distance from the plane of the edges.
    [[nodiscard, gnu::always_inline]] double off_plane(const Vector3& point) const {
        return std::abs(dot(normal_, minus(point, corner_)));
    }

    /// Area of the parallelogram, with a relative error of 4 epsilon however flat it is.
    [[nodiscard]] double area() const { return area_; }

    /// Lengths of e, f and f - e.
    [[nodiscard]] const std::array<double, 3>& lengths() const { return lengths_; }

    /// Bound on how far rounding moves a point: 16 epsilon * size * longest edge / smallest height.
    [[nodiscard]] double slack() const { return slack_; }

  private:
    Vector3 corner_{};
    Vector3 g_{};
    Vector3 h_{};
    Vector3 normal_{};
    std::array<double, 3> lengths_{};
    double area_ = 0;
    double slack_ = 0;
    bool flat_ = true;
};

}  // namespace stipple
