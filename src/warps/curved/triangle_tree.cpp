// SPDX-License-Identifier: MIT
#include "warps/curved/triangle_tree.hpp"

#include <algorithm>
#include <limits>
#include <tuple>
#include <vector>

#include "math/functions/powers.hpp"

namespace stipple {
namespace {

/// Position, as a fraction in [0, 1], of the edge's point that is nearest to the given point.
double place_on_edge(const Vector3& a, const Vector3& b, const Vector3& point) {
    const Vector3 edge = minus(b, a);
    const double square = dot(edge, edge);
    return square > 0 ? std::clamp(dot(minus(point, a), edge) / square, 0.0, 1.0) : 0.0;
}

/// foot_on() for coordinates whose fourth powers neither overflow nor underflow.
Foot scaled_foot(const std::array<Vector3, 3>& corners, const Vector3& point) {
    Foot best{{1, 0, 0}, std::numeric_limits<double>::infinity()};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        const double place = place_on_edge(corners[k], corners[next], point);
        const Vector3 at = plus(times(corners[k], 1 - place), times(corners[next], place));
        const double distance = length(minus(point, at));
        if (!(distance < best.distance)) continue;
        best = {{0, 0, 0}, distance};
        best.weights[k] = 1 - place;
        best.weights[next] = place;
    }
    const Vector3 e = minus(corners[1], corners[0]);
    const Vector3 f = minus(corners[2], corners[0]);
    const Vector3 d = minus(point, corners[0]);
    const Vector3 normal = cross(e, f);
    const double square = dot(normal, normal);
    const double l1 = dot(cross(d, f), normal) / square;
    const double l2 = dot(cross(e, d), normal) / square;
    const double l0 = 1 - l1 - l2;
    const double height = std::abs(dot(d, normal)) / std::sqrt(square);
    if (l0 >= 0 && l1 >= 0 && l2 >= 0 && height <= best.distance) best = {{l0, l1, l2}, height};
    return best;
}

}  // namespace

Foot foot_on(const std::array<Vector3, 3>& corners, const Vector3& point) {
    double size = 0;  // of the edges, the coordinates of which may be far larger
    for (const std::size_t k : {1U, 2U})
        size = std::max(size, largest(minus(corners[k], corners[0])));
    const double unit = unit_for(size);
    if (unit > 0x1p-200 && unit < 0x1p200) return scaled_foot(corners, point);
    std::array<Vector3, 3> own;
    for (std::size_t k = 0; k < 3; ++k) own[k] = times(minus(corners[k], corners[0]), 1 / unit);
    Foot foot = scaled_foot(own, times(minus(point, corners[0]), 1 / unit));
    foot.distance *= unit;
    return foot;
}

TriangleTree::TriangleTree(const TriangleMesh& mesh, const RunContext& run) : mesh_(mesh) {
    std::vector<Entry> entries;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        if (i % 65536 == 0) run.check_stop();
        const auto [a, b, c] = mesh.corners(i);
        Vector3 low;
        Vector3 high;
        for (std::size_t k = 0; k < 3; ++k)
            std::tie(low[k], high[k]) = std::minmax({a[k], b[k], c[k]});
        entries.emplace_back(Bounds({low[0], low[1], low[2]}, {high[0], high[1], high[2]}), i);
    }
    boxes_ = decltype(boxes_)(entries);  // bulk loading packs the tree
}

void TriangleTree::visit(const Vector3& point, double reach,
                         const std::function<void(std::uint32_t, const Foot&)>& seen) const {
    const auto [x, y, z] = point;
    const Bounds around({x - reach, y - reach, z - reach}, {x + reach, y + reach, z + reach});
    for (auto at = boxes_.qbegin(boost::geometry::index::intersects(around)); at != boxes_.qend();
         ++at) {
        const Foot foot = foot_on(mesh_.corners(at->second), point);
        if (foot.distance <= reach) seen(at->second, foot);
    }
}

}  // namespace stipple
