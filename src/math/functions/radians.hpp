// SPDX-License-Identifier: MIT
//
// Trigonometric functions of angles in radians, from those of angles in turns.
//
// Promise arc cosine and arc sine within 1e-15; sine and cosine within (1 + |angle|) 2^-52, because
//         angles are rounded in turns. The same bits on every machine, as in trigonometry.hpp.
#pragma once

#include <cmath>
#include <numbers>

#include "math/functions/trigonometry.hpp"

namespace stipple {

/// Cosine and sine of any finite angle.
inline CosSin cos_sin_radians(double angle) {
    const double turns = std::abs(angle) / (2 * std::numbers::pi);
    const auto [cos, sin] = cos_sin_turns(turns - std::floor(turns));
    return {cos, angle < 0 ? -sin : sin};
}

/// Cosine and sine of any finite angle within 2 units in the last place, also of huge angles and
/// next to multiples of pi / 2. Slower than cos_sin_radians().
/// Source  M. H. Payne, R. N. Hanek, ACM SIGNUM Newsletter 18 (1983) 19-24: only the digits of 1 /
///         (2 pi) that do not give whole turns are multiplied.
CosSin precise_cos_sin(double angle);

/// The angle in [0, pi] with cosine x in [-1, 1].
inline double arc_cosine(double x) {
    return 2 * std::numbers::pi * turns_of(x, std::sqrt((1 - x) * (1 + x)));
}

/// The angle in [0, pi / 2] with sine x in [0, 1].
inline double arc_sine(double x) {
    return 2 * std::numbers::pi * turns_of(std::sqrt((1 - x) * (1 + x)), x);
}

/// The angle in (-pi, pi] of the vector (x, y), like atan2(y, x).
inline double signed_angle(double y, double x) {
    const double turns = turns_of(x, std::abs(y));
    return std::copysign(2 * std::numbers::pi * turns, y);
}

}  // namespace stipple
