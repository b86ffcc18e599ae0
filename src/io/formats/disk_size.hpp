// SPDX-License-Identifier: MIT
//
// How large a point is drawn.
#pragma once

#include <algorithm>
#include <cmath>

namespace stipple::io {

/// Radius of the disks of `count` points on an area, in its units, of which 1000 make a picture:
/// 0.15 of the mean distance sqrt(area / count), between 0.5 and 10.
inline double disk_radius(double area, double count) {
    return std::clamp(0.15 * std::sqrt(area / std::max(count, 1.0)), 0.5, 10.0);
}

}  // namespace stipple::io
