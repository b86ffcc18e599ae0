// SPDX-License-Identifier: MIT
//
// Areas in the plane that have a closed form.
//
// Promise a few rounding errors of the polygon's extent squared.
#pragma once

#include <array>
#include <vector>

namespace stipple {

using PlanePair = std::array<double, 2>;
using Polygon = std::vector<PlanePair>;

/// The corners of [0, 1]^2, counterclockwise.
Polygon unit_square();

/// Area, positive where the corners run counterclockwise.
double signed_area(const Polygon& polygon);

/// The part of a convex polygon where n . (x - p) <= 0.
Polygon clipped(const Polygon& polygon, const PlanePair& p, const PlanePair& n);

/// Area of the part of a counterclockwise polygon within a disk.
double area_in_disk(const Polygon& polygon, const PlanePair& center, double radius);

/// Area that two convex polygons share; `window` runs counterclockwise.
double shared_area(const Polygon& polygon, const Polygon& window);

}  // namespace stipple
