// SPDX-License-Identifier: MIT
//
// Integrals over zones of the unit sphere, between two heights and two longitudes, of densities
// that jump or bend at circles:
//
//     integral of dz integral of dphi f(x(z, phi)),    cut in z where a circle begins, ends, meets
//                                                      a side of the zone or another circle,
//                                                      and in phi where a circle is at that z
//
// Between the cuts all is smooth but for square roots at the ends (integrate_smooth).
//
// Cost    31 values of f or more for each piece of z where f is level, else as many for each of
//         phi.
// Promise the error told is that of the quadrature; 0 for what is level without a circle.
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

Estimate integrate_zone(const SphereDensity& f, const Zone& zone,
                        const Discontinuities& discontinuities);

}  // namespace stipple
