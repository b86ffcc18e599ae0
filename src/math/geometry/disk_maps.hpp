// SPDX-License-Identifier: MIT
//
// Two area-preserving maps between the unit square and the unit disk, with inverses:
//
//     polar       r = sqrt(u),  theta = 2 pi v
//     concentric  a = 2 u - 1, b = 2 v - 1;  r = a, theta = (pi / 4) b / a if |a| > |b|,
//                 else r = b, theta = pi / 2 - (pi / 4) a / b: concentric squares become circles
//
// Cost    no branches, so that compilers vectorise loops over them.
// Promise rounding may move inverse images out of the square; callers clamp. The polar map sends
//         all v at u = 0 to the centre, whose inverse has v = 0. The same bits on every machine.
// Source  Concentric: P. Shirley, K. Chiu, "A low distortion map between disk and square",
//         J. Graphics Tools 2(3) (1997) 45-52, doi:10.1080/10867651.1997.10487479.
#pragma once

#include <cmath>

#include "math/functions/trigonometry.hpp"
#include "math/geometry/vector3.hpp"

namespace stipple {

struct PolarDisk {
    static PlanePoint forward(double u, double v) {
        const double r = std::sqrt(u);
        const auto [c, s] = cos_sin_turns(v);
        return {r * c, r * s};
    }
    static PlanePoint inverse(double x, double y) { return {x * x + y * y, turns_of(x, y)}; }
};

struct ConcentricDisk {
    static PlanePoint forward(double u, double v) {
        const double a = 2 * u - 1;
        const double b = 2 * v - 1;
        const bool wide = std::abs(a) > std::abs(b);
        const double r = wide ? a : b;
        const double across = wide ? b : a;
        const double null = r == 0;
        const auto [c, s] = cos_sin_eighth(0.125 * (across / (r + null)));
        const double rc = r * c;
        const double rs = r * s;
        return {wide ? rc : rs, wide ? rs : rc};
    }
    static PlanePoint inverse(double x, double y) {
        const bool wide = std::abs(x) > std::abs(y);
        const double along = wide ? x : y;
        const double across = wide ? y : x;
        const double r = std::copysign(std::sqrt(x * x + y * y), along);
        const double eighths = 8 * turns_of(std::abs(along), std::abs(across));
        const double side = std::copysign(r * eighths, across);
        return {0.5 + 0.5 * (wide ? r : side), 0.5 + 0.5 * (wide ? side : r)};
    }
};

}  // namespace stipple
