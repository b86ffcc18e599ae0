// SPDX-License-Identifier: MIT
//
// Triangle meshes from files: PLY (ascii or binary little endian) and Wavefront OBJ. Polygons are
// triangulated in the coordinate plane nearest to their own; convex ones become a fan from the
// first corner. Other contents of a file are skipped.
//
//     const TriangleMesh mesh = read_mesh("bunny.ply", run);
//
// Shape   at least one triangle; finite coordinates in [-1e150, 1e150].
// Promise every error names the file with line and column, or the byte if binary (all counted from
//         1).
// Beware  a polygon that is not flat is replaced by its triangles; a warning gives their number.
// Source  G. Turk, The PLY polygon file format, Stanford University, 1994; Wavefront Technologies,
//         The Advanced Visualizer manual, appendix B1 (OBJ).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "math/geometry/vector3.hpp"
#include "stipple/run.hpp"

namespace stipple {

struct TriangleMesh {
    std::vector<Vector3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`

    [[nodiscard]] std::array<Vector3, 3> corners(std::size_t triangle) const {
        const auto& [a, b, c] = triangles[triangle];
        return {vertices[a], vertices[b], vertices[c]};
    }
};

/// Polygons of a mesh, triangulated once all vertices are known.
class MeshFaces {
  public:
    /// Adds a face. @param polygon vertex indices of its corners, at least 3
    void add(std::span<const std::uint32_t> polygon);

    /// Triangulates all faces. @throws Error(input) naming the first that is not a simple polygon
    [[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangles(
        const std::vector<Vector3>& vertices, const std::string& name, const RunContext& run) const;

  private:
    std::vector<std::uint32_t> corners_;
    std::vector<std::size_t> ends_;
};

/// Limit for the magnitude of coordinates.
constexpr double most_coordinate = 1e150;

/// Reads a mesh; the first line determines the format. @throws Error(io) like read_file();
/// Error(input): not a mesh, invalid numbers, missing vertices, a truncated file
TriangleMesh read_mesh(const std::string& path, const RunContext& run);

/// Parses the bytes of a PLY file; messages call it `name`. @throws Error(input)
TriangleMesh parse_ply(std::string bytes, const std::string& name, const RunContext& run);

/// Parses the bytes of an OBJ file; messages call it `name`. @throws Error(input)
TriangleMesh parse_obj(std::string bytes, const std::string& name, const RunContext& run);

}  // namespace stipple
