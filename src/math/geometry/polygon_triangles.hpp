// SPDX-License-Identifier: MIT
//
// Triangulation of a simple polygon in the plane: the fan from the first corner if it is convex,
// otherwise by cutting off ears (Meisters), corners whose triangle contains no other corner. All
// predicates are exact.
//
// Shape   n corners, in either direction; consecutive ones may be equal. n - 2 triangles, fewer if
//         corners are equal, with the orientation of the polygon.
// Cost    O(n) for a convex polygon, otherwise O(n r) for r reflex corners, at worst O(n^2 r).
// Source  G. H. Meisters, Amer. Math. Monthly 82 (1975) 648-651, doi:10.2307/2319703.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "math/geometry/polygon_contact.hpp"

namespace stipple {

using PolygonTriangles = std::vector<std::array<std::uint32_t, 3>>;  ///< indices of corners

/// Returns nullopt if edges cross, overlap or touch.
std::optional<PolygonTriangles> polygon_triangles(const Ring& corners, const RunContext& run);

}  // namespace stipple
