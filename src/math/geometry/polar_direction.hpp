// SPDX-License-Identifier: MIT
//
// Directions given by the cosine of their polar angle, measured from the z axis, and by their
// longitude, the angle from x towards y in turns. Instead of the cosine, 1 - cos and 1 + cos are
// used: each keeps digits near its pole that the cosine loses there.
//
// Areas on the sphere are 2 pi times areas in the plane of cosine and longitude (Archimedes).
//
// Promise 1 - cos and 1 + cos are recovered from the vector within a few units in the last place.
#pragma once

#include <cmath>

#include "math/functions/trigonometry.hpp"
#include "math/geometry/vector3.hpp"

namespace stipple {

/// Unit vector from 1 - cos and 1 + cos, which must sum to 2, and a longitude in [0, 1].
inline Vector3 polar_direction(double one_minus_cos, double one_plus_cos, double longitude) {
    const double r = std::sqrt(one_minus_cos * one_plus_cos);
    const auto [c, s] = cos_sin_turns(longitude);
    return {r * c, r * s, 0.5 * (one_plus_cos - one_minus_cos)};
}

/// 1 - |cos(polar angle)| of a vector of any length; 1 for the null vector.
inline double one_minus_abs_cos(const Vector3& v) {
    const double rr = v[0] * v[0] + v[1] * v[1];
    const double size = std::sqrt(rr + v[2] * v[2]);
    const double whole = size * (size + std::abs(v[2]));
    return whole > 0 ? rr / whole : 1;
}

/// 1 - cos(polar angle) of a vector of any length.
inline double one_minus_cos(const Vector3& v) {
    const double least = one_minus_abs_cos(v);
    return v[2] >= 0 ? least : 2 - least;
}

/// 1 + cos(polar angle) of a vector of any length.
inline double one_plus_cos(const Vector3& v) {
    const double least = one_minus_abs_cos(v);
    return v[2] >= 0 ? 2 - least : least;
}

}  // namespace stipple
