// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/text.hpp"
#include "math/geometry/polygon_triangles.hpp"
#include "media/triangle_mesh.hpp"

namespace stipple {
namespace {

/// Newell's normal; for a flat polygon its length is twice the area.
Vector3 normal_of(const std::vector<Vector3>& corners) {
    Vector3 normal{};
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        normal =
            plus(normal, cross(minus(corners[i], corners[0]), minus(corners[i + 1], corners[0])));
    return normal;
}

/// Whether all corners lie in one plane, up to rounding of coordinates to single precision.
bool is_flat(const std::vector<Vector3>& corners, const Vector3& normal) {
    const Vector3 up = normalized(normal);
    double extent = 0;
    double height = 0;
    double size = 0;
    for (const Vector3& corner : corners) {
        const Vector3 step = minus(corner, corners[0]);
        extent = std::max(extent, largest(step));
        height = std::max(height, std::abs(dot(step, up)));
        size = std::max(size, largest(corner));
    }
    return height <= 1e-5 * extent + 0x1p-22 * size;
}

/// Projects the corners along the axis with the largest normal component.
Ring dropped(const std::vector<Vector3>& corners, const Vector3& normal) {
    std::size_t axis = 0;
    for (const std::size_t k : {1U, 2U})
        if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
    Ring ring;
    for (const Vector3& p : corners) ring.push_back({p[(axis + 1) % 3], p[(axis + 2) % 3]});
    return ring;
}

std::optional<PolygonTriangles> cut(const std::vector<Vector3>& corners, const Vector3& normal,
                                    const RunContext& run) {
    if (largest(normal) > 0) return polygon_triangles(dropped(corners, normal), run);
    // Zero normal: no area, or a self-intersection with equal areas on both sides.
    PolygonTriangles fan;
    for (std::uint32_t k = 2; k < corners.size(); ++k) {
        const Vector3 part =
            cross(minus(corners[k - 1], corners[0]), minus(corners[k], corners[0]));
        if (largest(part) > 0) return std::nullopt;
        fan.push_back({0, k - 1, k});
    }
    return fan;
}

}  // namespace

void MeshFaces::add(std::span<const std::uint32_t> polygon) {
    corners_.insert(corners_.end(), polygon.begin(), polygon.end());
    ends_.push_back(corners_.size());
}

std::vector<std::array<std::uint32_t, 3>> MeshFaces::triangles(const std::vector<Vector3>& vertices,
                                                               const std::string& name,
                                                               const RunContext& run) const {
    std::vector<std::array<std::uint32_t, 3>> all;
    std::vector<Vector3> corners;
    std::size_t bent = 0;
    std::size_t first_bent = 0;
    std::size_t begin = 0;
    for (std::size_t face = 0; face < ends_.size(); ++face) {
        if (face % 65536 == 0) run.check_stop();
        const auto places = std::span(corners_).subspan(begin, ends_[face] - begin);
        begin = ends_[face];
        if (places.size() == 3) {
            all.push_back({places[0], places[1], places[2]});
            continue;
        }
        corners.clear();
        for (const std::uint32_t place : places) corners.push_back(vertices[place]);
        const Vector3 normal = normal_of(corners);
        const auto triangles = cut(corners, normal, run);
        if (!triangles)
            fail(ErrorKind::input,
                 "{}: face {}: edges of its {} corners cross or touch; a simple polygon is needed",
                 name, face + 1, places.size());
        if (largest(normal) > 0 && !is_flat(corners, normal) && bent++ == 0) first_bent = face + 1;
        for (const auto& [a, b, c] : *triangles) all.push_back({places[a], places[b], places[c]});
    }
    if (bent > 0)
        run.notify(
            fmt::format("{}: {} of {} faces are not flat, the first is face {}; they are replaced "
                        "by triangles between their corners",
                        name, bent, ends_.size(), first_bent));
    return all;
}

}  // namespace stipple
