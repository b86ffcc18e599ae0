// SPDX-License-Identifier: MIT
//
// Distances in units in the last place.
#pragma once

#include <cmath>

namespace stipple::testing {

/// Distance of `value` from the expected one, in units in the last place of the nearest double.
inline double ulps(double value, long double expected) {
    const double near = std::abs(static_cast<double>(expected));
    const double ulp = std::nextafter(near, INFINITY) - near;
    return static_cast<double>(std::abs(static_cast<long double>(value) - expected) / ulp);
}

}  // namespace stipple::testing
