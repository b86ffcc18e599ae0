// SPDX-License-Identifier: MIT
//
// The vertices of the unit cube cut by half-spaces, by the double description method. Half-spaces
// are applied one after another. Each removes the vertices beyond its plane, and adds one on each
// edge that crosses it. Two vertices are joined by an edge if no third one is on all planes that
// contain both.
//
// Computations use twice the precision of a double, to distinguish planes that meet in a vertex or
// touch the polytope from those that nearly do. Points within 1e-13 of a plane count as on it,
// because the coefficients of half-spaces are rounded. Polytopes thinner than 1e-11 count as flat.
//
// Cost    O(vertices^2) per half-space.
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

/// A set of planes, by their indices.
using PlaneSet = std::bitset<most_polytope_planes>;
using PolytopePoint = std::array<double, most_polytope_dimensions>;

struct PolytopeVertex {
    PolytopePoint at;
    PlaneSet planes;  ///< planes that contain the vertex
};

/// The half-space normal . y <= bound, with a normal of length 1.
struct PolytopePlane {
    PolytopePoint normal;
    double bound;

    /// Distance of a point from the plane; negative outside the half-space.
    [[nodiscard]] double slack(const double* y, std::size_t d) const {
        double sum = bound;
        for (std::size_t k = 0; k < d; ++k) sum -= normal[k] * y[k];
        return sum;
    }
};

struct PolytopeVertices {
    std::size_t dimension;
    std::vector<PolytopePlane> planes;  ///< planes of the facets, each once
    std::vector<PolytopeVertex> all;    ///< those on most planes first, then by coordinates
};

/// Computes the vertices. @param cuts with nonzero normals; d <= most_polytope_dimensions
/// @throws Error(usage) if no point is in all of them, or if they leave no volume; Error(limit) if
///         there are too many planes, vertices or edges
PolytopeVertices polytope_vertices(std::size_t d, const std::vector<HalfSpace>& cuts);

}  // namespace stipple
