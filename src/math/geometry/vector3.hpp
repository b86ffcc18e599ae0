// SPDX-License-Identifier: MIT
//
// Vectors in space, and right-handed frames of three orthogonal unit vectors.
//
// Promise only + - * / and square roots, so the same bits on every machine with IEEE 754
//         arithmetic.
// Source  T. Duff, J. Burgess, P. Christensen, C. Hery, A. Kensler, M. Liani, R. Villemin,
//         "Building an orthonormal basis, revisited", J. Computer Graphics Techniques 6(1) (2017)
//         1-8.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace stipple {

using Vector3 = std::array<double, 3>;

inline Vector3 plus(const Vector3& a, const Vector3& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector3 minus(const Vector3& a, const Vector3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector3 times(const Vector3& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
inline double dot(const Vector3& a, const Vector3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector3 cross(const Vector3& a, const Vector3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vector3& a) { return std::sqrt(dot(a, a)); }
inline double largest(const Vector3& a) {
    return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

/// Unit vector in the direction of any finite vector that is not null.
inline Vector3 normalized(const Vector3& a) {
    const double size = largest(a);
    const Vector3 scaled = {a[0] / size, a[1] / size, a[2] / size};
    return times(scaled, 1 / length(scaled));
}

/// Right-handed orthonormal axes.
struct Frame {
    Vector3 x{1, 0, 0};
    Vector3 y{0, 1, 0};
    Vector3 z{0, 0, 1};

    /// Vector with coordinates v along the axes.
    [[nodiscard]] Vector3 out(const Vector3& v) const {
        return {v[0] * x[0] + v[1] * y[0] + v[2] * z[0] + 0.0,  // avoids -0
                v[0] * x[1] + v[1] * y[1] + v[2] * z[1] + 0.0,
                v[0] * x[2] + v[1] * y[2] + v[2] * z[2] + 0.0};
    }

    /// Coordinates of a vector along the axes.
    [[nodiscard]] Vector3 in(const Vector3& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};

/// Frame with a given unit vector z; the coordinate axes for (0, 0, 1).
inline Frame frame_about(const Vector3& z) {
    const double sign = std::copysign(1.0, z[2]);
    const double a = -1 / (sign + z[2]);
    const double b = z[0] * z[1] * a;
    return {{1 + sign * z[0] * z[0] * a, sign * b, 0 - sign * z[0]},
            {b, sign + z[1] * z[1] * a, 0 - z[1]},
            z};
}

// Points of the plane, and placements of shapes in it.

struct PlanePoint {
    double x = 0;
    double y = 0;
    bool operator==(const PlanePoint&) const = default;
};

/// Placement of a shape: its points q move to c + R (cos a  -sin a; sin a  cos a) q.
struct Placement {
    PlanePoint center;
    double size = 1;  ///< R
    double turn = 0;  ///< angle a in turns, in [0, 1)
    double cos = 1;
    double sin = 0;

    [[nodiscard]] PlanePoint to_world(PlanePoint q) const {
        return {center.x + size * (cos * q.x - sin * q.y),
                center.y + size * (sin * q.x + cos * q.y)};
    }
    [[nodiscard]] PlanePoint to_frame(double px, double py) const {
        const double x = (px - center.x) / size;
        const double y = (py - center.y) / size;
        return {cos * x + sin * y, cos * y - sin * x};
    }
};

}  // namespace stipple
