// SPDX-License-Identifier: MIT
//
// The vertices of the unit cube cut by half-spaces, by the double description method: half-spaces
// are taken one after the other; each drops the vertices beyond its plane, and adds one on each edge
// that crosses it. Two vertices have an edge when no third one lies on all planes that both lie on.
//
// All is computed with twice the digits of a double, so that what meets in a vertex, or touches the
// polytope, is told from what only nearly does: what is within 1e-13 of a plane lies on it, as the
// half-spaces' numbers are rounded. What is thinner than 1e-11 is flat.
//
// Cost    vertices^2 a half-space.
// Source  T. S. Motzkin, H. Raiffa, G. L. Thompson, R. M. Thrall, "The double description method",
//         Contributions to the Theory of Games II (1953) 51-73; K. Fukuda, A. Prodon, "Double
//         description method revisited", LNCS 1120 (1996) 91-111, doi:10.1007/3-540-61576-8_77.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <vector>

#include "math/polytopes/half_space.hpp"

namespace stipple {

inline constexpr std::size_t most_polytope_dimensions = 12;
inline constexpr std::size_t most_polytope_planes = 256;

/// Planes by their numbers.
using PlaneSet = std::bitset<most_polytope_planes>;
using PolytopePoint = std::array<double, most_polytope_dimensions>;

struct PolytopeVertex {
    PolytopePoint at;
    PlaneSet planes;  ///< on which it lies
};

/// normal . y <= bound, with a normal of length 1.
struct PolytopePlane {
    PolytopePoint normal;
    double bound;

    /// How far a point is inside.
    [[nodiscard]] double slack(const double* y, std::size_t d) const {
        double sum = bound;
        for (std::size_t k = 0; k < d; ++k) sum -= normal[k] * y[k];
        return sum;
    }
};

struct PolytopeVertices {
    std::size_t dimension;
    std::vector<PolytopePlane> planes;  ///< of its facets, each once
    std::vector<PolytopeVertex> all;    ///< those on more planes first, then by their coordinates
};

/// @param cuts in d <= most_polytope_dimensions coordinates, with a normal that is not 0
/// @throws Error(usage) if no point is in all of them, or if they leave no volume; Error(limit)
///         naming what there are too many of
PolytopeVertices polytope_vertices(std::size_t d, const std::vector<HalfSpace>& cuts);

}  // namespace stipple
