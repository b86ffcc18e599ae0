// SPDX-License-Identifier: MIT
//
// A point, or a vector, of the plane.
#pragma once

namespace stipple {

struct PlanePoint {
    double x = 0;
    double y = 0;
    bool operator==(const PlanePoint&) const = default;
};

}  // namespace stipple
