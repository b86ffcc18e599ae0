// SPDX-License-Identifier: MIT
//
// Areas in the plane in closed form.
//
// Promise within a few units in the last place of the square of the polygon's extent.
#pragma once

#include <array>
#include <vector>

namespace stipple {

using PlanePair = std::array<double, 2>;
using Polygon = std::vector<PlanePair>;

/// The corners of [0, 1]^2, counterclockwise.
Polygon unit_square();

/// Area, positive if the corners are in counterclockwise order.
double signed_area(const Polygon& polygon);

/// Clips a convex polygon to the half-plane n . (x - p) <= 0.
Polygon clipped(const Polygon& polygon, const PlanePair& p, const PlanePair& n);

/// Area of the part of a counterclockwise polygon within a disk.
double area_in_disk(const Polygon& polygon, const PlanePair& center, double radius);

/// Area that two convex polygons share; the corners of `window` are in counterclockwise order.
double shared_area(const Polygon& polygon, const Polygon& window);

}  // namespace stipple
