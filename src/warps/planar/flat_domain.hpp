// SPDX-License-Identifier: MIT
//
// Domain of a triangle or parallelogram in the plane or in space, uniform by area. It is computed
// from coordinates along the two edges at the first corner (math/geometry/edge_frame.hpp).
#pragma once

#include <array>
#include <string>
#include <utility>

#include "core/options.hpp"
#include "math/geometry/edge_frame.hpp"
#include "warps/named_domain.hpp"
#include "warps/planar/area_share.hpp"

namespace stipple::warps {

class FlatDomain : public NamedDomain {
  public:
    /// @param corners 3 or 4 in order, with 2 or 3 coordinates
    /// @param frame of the edges from the first corner to the second and last; not degenerate
    FlatDomain(std::string spec, const Table& corners, const EdgeFrame& frame)
        : NamedDomain(std::move(spec), corners[0].size(), 2), corners_(corners), frame_(frame) {
        const auto [e, f, across] = frame_.lengths();
        heights_ = {frame_.area() / f, frame_.area() / e, frame_.area() / across};
    }

    double measure() const final { return is_triangle() ? 0.5 * frame_.area() : frame_.area(); }

    /// Allows a distance of 16 epsilon (largest coordinate) (longest edge / smallest height) from
    /// the shape and from its plane, the rounding error of generated points.
    bool contains(std::span<const double> point) const final {
        const auto [s, t] = frame_.coordinates(space_point(point));
        const double slack = frame_.slack();
        const auto [along_s, along_t, beyond] = heights_;
        const bool before = is_triangle()
                                ? (1 - s - t) * beyond >= -slack
                                : (1 - s) * along_s >= -slack && (1 - t) * along_t >= -slack;
        return s * along_s >= -slack && t * along_t >= -slack && before &&
               frame_.off_plane(space_point(point)) <= slack;
    }

    Box bounding_box() const final {
        Box box{corners_[0], corners_[0]};
        for (const auto& corner : corners_) box = stipple::bounding_box(corner, box);
        return box;
    }

    /// Call only for a shape in the plane, not in space.
    std::optional<Estimate> box_mass(const Box& box) const final {
        return area_share(box, *this, [&](const Polygon& window) {
            Polygon shape;
            for (const auto& corner : corners_) shape.push_back({corner[0], corner[1]});
            return shared_area(shape, window);
        });
    }

    const Table& corners() const { return corners_; }
    const EdgeFrame& frame() const { return frame_; }

  private:
    bool is_triangle() const { return corners_.size() == 3; }

    Table corners_;
    EdgeFrame frame_;
    /// Heights of the parallelogram over s = 0 and t = 0, and of corner 0 over the diagonal.
    std::array<double, 3> heights_;
};

}  // namespace stipple::warps
