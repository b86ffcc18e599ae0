// SPDX-License-Identifier: MIT
//
// Triangles of a simple polygon of the plane, which share no area and together are the polygon: the
// fan from the first corner if it is convex, else by cutting off ears (Meisters), corners whose
// triangle has no other corner in it. All predicates are exact.
//
// Shape   n corners, in either direction; two that follow each other may be equal. n - 2 triangles,
//         fewer if corners are equal; in the direction of the polygon.
// Cost    O(n) if it is convex, else O(n r) for r corners that are not, at worst O(n^2 r).
// Source  G. H. Meisters, Amer. Math. Monthly 82 (1975) 648-651, doi:10.2307/2319703.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "math/geometry/polygon_contact.hpp"

namespace stipple {

using PolygonTriangles = std::vector<std::array<std::uint32_t, 3>>;  ///< places of the corners

/// Nothing if edges cross, overlap or touch.
std::optional<PolygonTriangles> polygon_triangles(const Ring& corners, const RunContext& run);

}  // namespace stipple
