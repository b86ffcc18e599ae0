// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <numbers>

namespace stipple {

/// Volume of the ball of radius 1 in one dimension or more: V_d = V_(d-2) 2 pi / d.
inline double unit_ball_volume(std::size_t dimension) {
    double ball = dimension % 2 == 0 ? std::numbers::pi : 2;  // volume in 2 or 1 dimensions
    for (std::size_t d = dimension % 2 == 0 ? 4 : 3; d <= dimension; d += 2)
        ball *= 2 * std::numbers::pi / static_cast<double>(d);
    return ball;
}

}  // namespace stipple
