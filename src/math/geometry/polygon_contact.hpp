// SPDX-License-Identifier: MIT
//
// Whether closed rings of straight edges cross, overlap, or touch themselves; two rings may touch
// in single points, as in the simple features of the OGC. A sweep from row to row compares edges
// that become neighbours (Shamos and Hoey). Edges are cut where a vertex of another ring touches
// them, and the sweep starts anew, so that at last rings touch in vertices alone; there, two cross
// if the edges of one separate those of the other.
//
// Cost    O(n log n) time, O(n) memory.
// Promise an edge that comes to another within the rounding of a determinant, some 4 epsilon of its
//         terms, counts as touching it. The order of edges in a row is exact.
// Source  M. I. Shamos, D. Hoey, 17th Symp. Foundations of Computer Science (1976) 208-215,
//         doi:10.1109/SFCS.1976.16; OGC 06-103r4, Simple feature access (2011), 6.1.11.
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

/// An edge of a ring, or a part of one.
struct RingSegment {
    PlanePoint a;
    PlanePoint b;
    RingEdge name;
};

/// Some contact of the rings that is not allowed, if there is any; no two vertices that follow each
/// other may be equal.
/// @param segments takes all edges, cut where rings touch, if there is no such contact
std::optional<Contact> find_contact(const std::vector<Ring>& rings, const RunContext& run,
                                    std::vector<RingSegment>* segments = nullptr);

}  // namespace stipple
