// SPDX-License-Identifier: MIT
//
// Which triangles of a mesh a point lies on: Boost's tree of the boxes around them.
//
// Shape   any number of triangles, also without area.
// Cost    O(n log n) to build, O(log n) for a point on a mesh whose triangles are well spread.
// Promise every triangle within the reach, and no other; in no order to rely on.
#pragma once

#define BOOST_ALLOW_DEPRECATED_HEADERS  // Boost.Geometry includes one, with a note at each compile

#include <array>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cstdint>
#include <functional>
#include <utility>

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
    using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
    using Bounds = boost::geometry::model::box<Corner>;
    using Entry = std::pair<Bounds, std::uint32_t>;

    const TriangleMesh& mesh_;
    boost::geometry::index::rtree<Entry, boost::geometry::index::linear<16>> boxes_;
};

}  // namespace stipple
