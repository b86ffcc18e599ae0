// SPDX-License-Identifier: MIT
//
// A polytope in the unit cube as simplices, and the map of the cube onto it that preserves shares of
// the volume. The simplices are those of the pulling triangulation: a face is the join of its first
// vertex, the apex, with the simplices of those of its facets that do not hold the apex,
//
//     vol F = sum over G of vol G * distance(apex, G) / dim F,
//
// whatever the polytope, also where more than d facets meet in a vertex. They are not listed: a
// simplex is a way down from the polytope to a vertex, one apex after the other, and a face stands
// here once for all ways. A polytope of d! simplices may have 2^d faces of that kind.
//
// Forward, xi_1 decides at each face where to go, by the share of the volume, and what is left of it
// is the place along the last edge; xi_2 ... xi_d break the weights of the apexes off, one after the
// other (math/polytopes/simplex_map.hpp), small xi near the apex. Back, the ray from the apex through
// a point meets the facet for which height(point) / height(apex) above it is least, and that is the
// weight of the apex.
//
// Cost    forward some 20 ns a coordinate; back some 500 ns a point of 4 dimensions.
// Source  C. W. Lee, "Subdivisions and triangulations of polytopes", Handbook of Discrete and
//         Computational Geometry (1997), section 14.3 (pulling a vertex); B. Bueler, A. Enge,
//         K. Fukuda, "Exact volume computation for polytopes", DMV Seminar 29 (2000) 131-154,
//         doi:10.1007/978-3-0348-8438-9_6 (faces held once).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/domain.hpp"
#include "math/polytopes/polytope_vertices.hpp"

namespace stipple {

class FaceTree {
  public:
    /// @throws Error(limit) if there are too many faces. The volume is 0 if rounding leaves none.
    explicit FaceTree(const PolytopeVertices& polytope);

    [[nodiscard]] std::size_t dimension() const { return d_; }
    [[nodiscard]] double volume() const { return volume_; }
    [[nodiscard]] const std::vector<PolytopePoint>& vertices() const { return vertices_; }

    /// Rows of a block that forward() takes at once.
    static constexpr std::size_t some_rows = 256;

    /// Columns of at most some_rows numbers each, in place: coordinates of the cube on the way in,
    /// of points on the way out.
    void forward(std::span<double* const> columns, std::size_t rows) const;

    /// Of a point of the polytope; what is beside it by rounding, as the nearest.
    void inverse(const double* point, double* cube) const;

    [[nodiscard]] Moments moments() const;

  private:
    struct Facet {
        std::uint32_t face;
        double before;  ///< share of the face's volume before it
        double share;
        double height;  ///< of the apex above it
    };
    struct Face {
        std::uint32_t apex;
        std::uint32_t dimension;
        std::size_t first;  ///< of its facets that do not hold the apex; none of a vertex
        std::size_t count;
    };
    struct Path;
    class Builder;

    [[nodiscard]] std::span<const Facet> facets(std::size_t face) const {
        return std::span(facets_).subspan(faces_[face].first, faces_[face].count);
    }
    [[nodiscard]] const Facet& chosen(std::size_t face, double& u) const;
    [[nodiscard]] double number_of(const Path& path, double rest) const;
    [[nodiscard]] int side_of(const Path& path, double u) const;
    [[nodiscard]] std::vector<double> means(std::size_t k) const;

    /// E of a face for its facets' numbers: sum of share * part(facet's face, apex, dimension).
    template <class Part>
    [[nodiscard]] std::vector<double> over_faces(const Part& part) const;

    std::size_t d_;
    double volume_ = 0;
    std::vector<PolytopePoint> vertices_;
    std::vector<Face> faces_;  ///< after their facets; the polytope is the last
    std::vector<Facet> facets_;
    std::vector<double> normals_;  ///< of each facet within its face, and normal . x on it
};

}  // namespace stipple
