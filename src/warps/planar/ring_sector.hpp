// SPDX-License-Identifier: MIT
//
// Sector of a ring around the origin, between radii q and 1 and angles 0 and w turns:
//
//     r = sqrt(q^2 + u (1 - q^2)),    theta = w v turns
//
// The inverse uses u = (r - q) (r + q) / (1 - q^2). The unit disk is q = 0, w = 1.
//
// Promise preserves areas; a round trip returns (r cos theta, r sin theta) within 4 epsilon.
#pragma once

#include <string>
#include <vector>

#include "math/functions/trigonometry.hpp"
#include "math/geometry/law_moments.hpp"
#include "math/geometry/planar_area.hpp"
#include "math/geometry/vector3.hpp"

namespace stipple::warps {

struct RingSector {
    double inner = 0;   ///< q, below 1
    double spread = 1;  ///< 1 - q^2, stored separately to be accurate for thin rings
    double width = 1;   ///< w, in (0, 1] turns

    /// Sector for the options --inner and --radius and an angle in turns. @throws Error(usage)
    static RingSector between(double inner, double outer, double width);

    [[nodiscard]] PlanePoint forward(double u, double v) const {
        const double r = std::sqrt(inner * inner + u * spread);
        const auto [c, s] = cos_sin_turns(width * v);
        return {r * c, r * s};
    }

    [[nodiscard]] PlanePoint inverse(double x, double y) const {
        const double square = x * x + y * y;
        const double r = std::sqrt(square);
        const double angle = turns_of(x, y);
        // A point of the side at angle 0 may be rounded to an angle of almost a full turn.
        const double wrapped = 0.5 * (1 + width) < angle;
        const double share = (r - inner) * (r + inner) / spread;
        return {inner > 0 ? share : square, (angle - wrapped) / width};
    }

    [[nodiscard]] double area() const;
    [[nodiscard]] double area_in(const Polygon& window) const;
    [[nodiscard]] double beyond(double x, double y) const;
    [[nodiscard]] std::vector<PlanePoint> hull(double turn) const;
    [[nodiscard]] PlaneMoments moments() const;
    [[nodiscard]] std::vector<std::string> axes() const;
};

}  // namespace stipple::warps
