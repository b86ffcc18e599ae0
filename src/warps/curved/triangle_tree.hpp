// SPDX-License-Identifier: MIT
//
// Finds the triangles of a mesh near a point, with Boost's R-tree of their bounding boxes.
//
// Shape   any number of triangles, also degenerate ones.
// Cost    O(n log n) to build; O(log n) per point if the mesh's triangles are well spread.
// Promise visit() finds exactly the triangles within the given distance, in unspecified order.
#pragma once

// Boost.Geometry includes deprecated headers, which would print notes.
#define BOOST_ALLOW_DEPRECATED_HEADERS

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

/// Projection of a point onto a triangle: the barycentrics (>= 0, sum 1) of the nearest point of
/// the triangle, and the distance from it.
struct Foot {
    std::array<double, 3> weights;
    double distance;
};
Foot foot_on(const std::array<Vector3, 3>& corners, const Vector3& point);

class TriangleTree {
  public:
    /// `mesh` must outlive the tree. @throws Error(cancelled)
    TriangleTree(const TriangleMesh& mesh, const RunContext& run);

    /// Calls `seen` for every triangle at a distance of at most `reach` from the point.
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
