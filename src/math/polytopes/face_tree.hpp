// SPDX-License-Identifier: MIT
//
// A polytope in the unit cube as simplices, and the map of the cube onto it that preserves
// fractions of the volume. The simplices form the pulling triangulation: a face is the union of
// cones from its first vertex, the apex, over its facets that do not contain the apex,
//
//     vol F = sum over G of vol G * distance(apex, G) / dim F,
//
// for any polytope, even if more than d facets meet in a vertex. Simplices are not stored: each is
// a path from the polytope down to a vertex, apex by apex, and each face is stored once for all
// paths. A polytope with d! simplices may have 2^d such faces.
//
// Forward, xi_1 selects a facet at each face by its share of the volume, and its remainder is the
// position along the last edge. xi_2 ... xi_d split off the weights of the apexes, one after
// another, with small xi near the apex. Inverse: the ray from the apex through a point leaves
// the face through the facet above which height(point) / height(apex) is smallest. That ratio is
// the weight of the apex.
//
// Cost    forward about 20 ns per coordinate; inverse about 500 ns per point in 4 dimensions.
// Source  C. W. Lee, "Subdivisions and triangulations of polytopes", Handbook of Discrete and
//         Computational Geometry (1997), section 14.3 (pulling a vertex); B. Bueler, A. Enge, K.
//         Fukuda, "Exact volume computation for polytopes", DMV Seminar 29 (2000) 131-154,
//         doi:10.1007/978-3-0348-8438-9_6 (faces stored once).
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
    /// @throws Error(limit) if there are too many faces. The volume is 0 if it is lost in rounding.
    explicit FaceTree(const PolytopeVertices& polytope);

    [[nodiscard]] std::size_t dimension() const { return d_; }
    [[nodiscard]] double volume() const { return volume_; }
    [[nodiscard]] const std::vector<PolytopePoint>& vertices() const { return vertices_; }

    /// Maximum number of rows in a call of forward().
    static constexpr std::size_t some_rows = 256;

    /// Replaces cube coordinates by points, in place. @param columns one per coordinate, with
    /// `rows` <= some_rows numbers each
    void forward(std::span<double* const> columns, std::size_t rows) const;

    /// Maps a point of the polytope to the cube; points just outside by rounding count as inside.
    void inverse(const double* point, double* cube) const;

    [[nodiscard]] Moments moments() const;

  private:
    struct Facet {
        std::uint32_t face;
        double before;  ///< sum of `share` over the facets before this one
        double share;
        double height;  ///< height of the apex above the facet
    };
    struct Face {
        std::uint32_t apex;
        std::uint32_t dimension;
        std::size_t first;  ///< index of the first facet without the apex; a vertex has no facets
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

    /// Computes a value for each face: the sum over its facets of share * part(values, facet, apex,
    /// dimension of the face); for a vertex, part(values, vertex, vertex, 0).
    template <class Part>
    [[nodiscard]] std::vector<double> over_faces(const Part& part) const;

    std::size_t d_;
    double volume_ = 0;
    std::vector<PolytopePoint> vertices_;
    std::vector<Face> faces_;  ///< facets before their faces; the polytope is last
    std::vector<Facet> facets_;
    std::vector<double> normals_;  ///< by facet: unit normal within its face, and normal . x on it
};

}  // namespace stipple
