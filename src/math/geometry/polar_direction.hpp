// SPDX-License-Identifier: MIT
//
// Directions about the z axis by their drop below the pole and their longitude:
//
//     drop = 1 - cos(angle from z),    longitude = angle from x towards y, in turns.
//
// A part of the sphere has the area of its rectangle of drops and longitudes, times 2 pi
// (Archimedes). The drop keeps the digits near the pole that z has lost there.
//
// Promise drop and 2 - drop come back within a few units in their last places.
#pragma once

#include <cmath>

#include "math/functions/trigonometry.hpp"
#include "math/geometry/vector3.hpp"

namespace stipple {

/// The unit vector of a drop and of what is left of 2, the rise from the other pole; each keeps the
/// digits near its own pole. Longitude in [0, 1].
inline Vector3 at_pole(double drop, double rise, double longitude) {
    const double r = std::sqrt(drop * rise);
    const auto [c, s] = cos_sin_turns(longitude);
    return {r * c, r * s, 0.5 * (rise - drop)};
}

/// The drop of a vector from the pole that is nearer; of any length but 0, for which it is 1.
inline double least_drop(const Vector3& v) {
    const double rr = v[0] * v[0] + v[1] * v[1];
    const double size = std::sqrt(rr + v[2] * v[2]);
    const double whole = size * (size + std::abs(v[2]));
    return whole > 0 ? rr / whole : 1;
}

/// The drop of a vector of any length.
inline double drop_of(const Vector3& v) {
    const double least = least_drop(v);
    return v[2] >= 0 ? least : 2 - least;
}

}  // namespace stipple
