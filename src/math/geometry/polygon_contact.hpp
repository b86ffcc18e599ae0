// SPDX-License-Identifier: MIT
//
// Checks if closed rings of straight edges cross, overlap, or touch themselves. Two rings may touch
// in single points, as in the simple features of the OGC. A sweep from row to row compares edges
// that become neighbours (Shamos and Hoey). Edges are cut where a vertex of another ring touches
// them, and the sweep is repeated until rings touch only in vertices. At a shared vertex, two rings
// cross if the edges of one separate those of the other.
//
// Cost    O(n log n) time, O(n) memory.
// Promise edges count as touching if they are closer than the rounding error of a determinant,
//         about 4 epsilon of its terms. The order of edges in a row is exact.
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

/// Vertices in order; the last is joined to the first and must differ from it.
using Ring = std::vector<PlanePoint>;

struct RingEdge {
    std::size_t ring = 0;
    std::size_t edge = 0;  ///< from vertex `edge` to the next
    auto operator<=>(const RingEdge&) const = default;
};

struct Contact {
    RingEdge first;
    RingEdge second;        ///< later in the order of rings and edges
    bool crossing = false;  ///< false if the edges only touch or overlap
};

/// An edge of a ring, or part of an edge.
struct RingSegment {
    PlanePoint a;
    PlanePoint b;
    RingEdge name;
};

/// Returns a forbidden contact of the rings, or nullopt. Neighbouring vertices must differ.
/// @param segments receives all edges, cut where rings touch, if there is no such contact
std::optional<Contact> find_contact(const std::vector<Ring>& rings, const RunContext& run,
                                    std::vector<RingSegment>* segments = nullptr);

}  // namespace stipple
