// SPDX-License-Identifier: MIT
//
// A point, or a vector, of the plane, and the place of a shape in it.
#pragma once

namespace stipple {

struct PlanePoint {
    double x = 0;
    double y = 0;
    bool operator==(const PlanePoint&) const = default;
};

/// Where a shape is put: at c + R (cos a  -sin a; sin a  cos a) q for its points q.
struct Placement {
    PlanePoint center;
    double size = 1;  ///< R
    double turn = 0;  ///< in turns, in [0, 1)
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
