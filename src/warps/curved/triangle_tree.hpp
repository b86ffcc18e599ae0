// SPDX-License-Identifier: MIT
//
// Which triangles of a mesh a point lies on: a tree of boxes, each cut at the median of its
// triangles' middles along its longest side.
//
// Shape   any number of triangles, also without area.
// Cost    O(n log n) to build, O(log n) for a point on a mesh whose triangles are well spread.
// Promise every triangle within the reach, and no other; in no order to rely on.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "media/triangle_mesh.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Where a point is on a triangle: its barycentrics, none below 0, summing to 1, of the triangle's
/// point that is nearest, and its distance from there.
struct Foot {
    std::array<double, 3> weights;
    double distance;
};
Foot foot_on(const std::array<Vector3, 3>& corners, const Vector3& point);

class TriangleTree {
  public:
    /// `mesh` must outlive the tree. @throws Error(cancelled)
    TriangleTree(const TriangleMesh& mesh, const RunContext& run);

    /// Calls `seen` with every triangle whose distance from the point is at most `reach`.
    void visit(const Vector3& point, double reach,
               const std::function<void(std::uint32_t, const Foot&)>& seen) const;

  private:
    struct Node {
        Vector3 low;
        Vector3 high;
        std::uint32_t first;  ///< of its triangles in order_
        std::uint32_t count;
        std::uint32_t right = 0;  ///< its second child, the first follows it; 0 in a leaf
    };

    void build(std::uint32_t first, std::uint32_t count, const RunContext& run);
    [[nodiscard]] Node enclose(std::uint32_t first, std::uint32_t count) const;

    const TriangleMesh& mesh_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace stipple
