// SPDX-License-Identifier: MIT
//
// Whether closed rings of straight edges meet themselves or each other anywhere but where one edge
// hands over to the next: crossings, touching vertices, edges upon each other, and spikes that go
// back along themselves.
//
// Cost    O(n log n + pairs of edges that share rows), and memory for the edges.
// Promise an edge that comes to another within the rounding of a determinant, some 4 epsilon of its
//         terms, counts as touching it.
#pragma once

#include <compare>
#include <cstddef>
#include <optional>
#include <vector>

#include "math/geometry/vector3.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Vertices in order; the last is joined with the first, and is not it.
using Ring = std::vector<PlanePoint>;

struct RingEdge {
    std::size_t ring = 0;
    std::size_t edge = 0;  ///< from vertex `edge` to the next
    auto operator<=>(const RingEdge&) const = default;
};

struct Contact {
    RingEdge first;
    RingEdge second;        ///< comes later
    bool crossing = false;  ///< else they touch
};

/// Some contact of the rings, if there is any; no two vertices that follow each other may be equal.
std::optional<Contact> find_contact(const std::vector<Ring>& rings, const RunContext& run);

}  // namespace stipple
