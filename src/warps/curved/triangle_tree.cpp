// SPDX-License-Identifier: MIT
#include "warps/curved/triangle_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace stipple {
namespace {

constexpr std::uint32_t leaf_size = 4;

/// The share of the way from a to b at which their line is nearest to the point, in [0, 1].
double place_on_edge(const Vector3& a, const Vector3& b, const Vector3& point) {
    const Vector3 edge = minus(b, a);
    const double square = dot(edge, edge);
    return square > 0 ? std::clamp(dot(minus(point, a), edge) / square, 0.0, 1.0) : 0.0;
}

double middle(const TriangleMesh& mesh, std::uint32_t triangle, std::size_t axis) {
    const auto [a, b, c] = mesh.corners(triangle);
    return (a[axis] + b[axis] + c[axis]) / 3;
}

}  // namespace

Foot foot_on(const std::array<Vector3, 3>& corners, const Vector3& point) {
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

TriangleTree::TriangleTree(const TriangleMesh& mesh, const RunContext& run)
    : mesh_(mesh), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    nodes_.reserve(order_.size() / 2 + 1);
    build(0, static_cast<std::uint32_t>(order_.size()), run);
}

TriangleTree::Node TriangleTree::enclose(std::uint32_t first, std::uint32_t count) const {
    constexpr double far = std::numeric_limits<double>::infinity();
    Node node{{far, far, far}, {-far, -far, -far}, first, count};
    for (std::uint32_t i = first; i < first + count; ++i)
        for (const Vector3& corner : mesh_.corners(order_[i]))
            for (std::size_t k = 0; k < 3; ++k) {
                node.low[k] = std::min(node.low[k], corner[k]);
                node.high[k] = std::max(node.high[k], corner[k]);
            }
    return node;
}

void TriangleTree::build(std::uint32_t first, std::uint32_t count, const RunContext& run) {
    if (count >= 4096) run.check_stop();
    const std::size_t at = nodes_.size();
    nodes_.push_back(enclose(first, count));
    if (count <= leaf_size) return;
    const Vector3 extent = minus(nodes_[at].high, nodes_[at].low);
    const auto axis = static_cast<std::size_t>(std::ranges::max_element(extent) - extent.begin());
    const std::uint32_t half = count / 2;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
        return middle(mesh_, a, axis) < middle(mesh_, b, axis);
    });
    build(first, half, run);
    nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
    build(first + half, count - half, run);
}

void TriangleTree::visit(const Vector3& point, double reach,
                         const std::function<void(std::uint32_t, const Foot&)>& seen) const {
    std::array<std::uint32_t, 64> waiting;  // the tree is cut in halves, at most 32 deep
    std::size_t depth = 0;
    waiting[depth++] = 0;
    while (depth > 0) {
        const std::uint32_t at = waiting[--depth];
        const Node& node = nodes_[at];
        bool near = true;
        for (std::size_t k = 0; k < 3; ++k)
            near = near && point[k] >= node.low[k] - reach && point[k] <= node.high[k] + reach;
        if (!near) continue;
        if (node.right != 0) {
            waiting[depth++] = node.right;
            waiting[depth++] = at + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Foot foot = foot_on(mesh_.corners(order_[i]), point);
            if (foot.distance <= reach) seen(order_[i], foot);
        }
    }
}

}  // namespace stipple
