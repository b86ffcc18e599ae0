// SPDX-License-Identifier: MIT
//
// Directions about the z axis by the cosine of their angle from it and their longitude, the angle
// from x towards y in turns. In place of the cosine, 1 - cos and 1 + cos: each keeps the digits
// near its own pole that the cosine has lost there.
//
// A part of the sphere has the area of its rectangle of cosines and longitudes, times 2 pi
// (Archimedes).
//
// Promise 1 - cos and 1 + cos come back within a few units in their last places.
#pragma once

#include <cmath>

#include "math/functions/trigonometry.hpp"
#include "math/geometry/vector3.hpp"

namespace stipple {

/// The unit vector with this 1 - cos and 1 + cos, which sum to 2; longitude in [0, 1].
inline Vector3 polar_direction(double one_minus_cos, double one_plus_cos, double longitude) {
    const double r = std::sqrt(one_minus_cos * one_plus_cos);
    const auto [c, s] = cos_sin_turns(longitude);
    return {r * c, r * s, 0.5 * (one_plus_cos - one_minus_cos)};
}

/// 1 - |cos| of a vector of any length but 0, for which it is 1.
inline double one_minus_abs_cos(const Vector3& v) {
    const double rr = v[0] * v[0] + v[1] * v[1];
    const double size = std::sqrt(rr + v[2] * v[2]);
    const double whole = size * (size + std::abs(v[2]));
    return whole > 0 ? rr / whole : 1;
}

/// 1 - cos of a vector of any length.
inline double one_minus_cos(const Vector3& v) {
    const double least = one_minus_abs_cos(v);
    return v[2] >= 0 ? least : 2 - least;
}

/// 1 + cos of a vector of any length.
inline double one_plus_cos(const Vector3& v) {
    const double least = one_minus_abs_cos(v);
    return v[2] >= 0 ? 2 - least : least;
}

}  // namespace stipple
