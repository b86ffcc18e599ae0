// SPDX-License-Identifier: MIT
//
// Integrals over zones of the unit sphere, bounded by two heights and two longitudes, of densities
// with jumps or kinks at circles:
//
//     integral of dz integral of dphi f(x(z, phi)),    cut in z where a circle begins, ends, meets
//                                                      a side of the zone or another circle,
//                                                      and in phi where a circle is at that z
//
// Between the cuts the integrand is smooth except for square roots at the ends (integrate_smooth).
//
// Cost    at least 31 values of f between two cuts in z if f is level, which means constant between
//         the circles. Otherwise at least 31 between two cuts in phi for each of these values of z.
// Promise the returned error is that of the quadrature; 0 if f is level and there is no circle.
#pragma once

#include <functional>

#include "core/domain.hpp"
#include "math/geometry/vector3.hpp"

namespace stipple {

/// Heights in [-1, 1], longitudes in turns in [0, 1].
struct Zone {
    double z_low = -1;
    double z_high = 1;
    double turn_low = 0;
    double turn_high = 1;
};

using SphereDensity = std::function<double(const Vector3&)>;

Estimate integrate_zone(const SphereDensity& f, const Zone& zone, const SphereShape& shape);

}  // namespace stipple
