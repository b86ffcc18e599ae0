// SPDX-License-Identifier: MIT
//
// A box cut by half-spaces, in any number of dimensions, and the map of the unit cube onto it that
// preserves fractions of the volume. Coordinates are independent unless inequalities couple them.
// So each group of coupled coordinates is a polytope by itself (math/polytopes/face_tree.hpp), of
// at most 12 dimensions, and the others are intervals.
//
// A group is computed in the frame of a box not much larger than itself, so that sizes may differ
// by any factor. A polytope thinner than 1e-11 of that box counts as flat. Inequalities that cut
// nothing off, touch a face, or repeat others up to rounding have no effect. If two inequalities
// differ by 1e-13 to 1e-9, vertices may be lost in rounding; this is detected and causes an error.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/domain.hpp"
#include "math/polytopes/face_tree.hpp"
#include "math/polytopes/half_space.hpp"

namespace stipple {

class Polytope {
  public:
    /// @throws Error(usage) if no point satisfies all inequalities, or if the volume is 0;
    /// Error(limit) if the polytope is too complex or lost in rounding
    Polytope(Box box, const std::vector<HalfSpace>& cuts);

    [[nodiscard]] std::size_t dimension() const { return box_.dimension(); }
    [[nodiscard]] double volume() const { return volume_; }
    /// Bounding box of the polytope, from its vertices.
    [[nodiscard]] const Box& bounding_box() const { return around_; }
    [[nodiscard]] const Moments& moments() const { return moments_; }

    /// True inside and on the boundary, with a tolerance for rounding.
    [[nodiscard]] bool contains(std::span<const double> point) const;

    /// Maps points from the cube. Each group uses the cube coordinates with the indices of its own
    /// coordinates; intervals are scaled.
    void from_cube(std::span<const double> cube, std::span<double> image) const;
    /// Meaning of cube coordinate k, for messages.
    [[nodiscard]] std::string cube_axis(std::size_t k) const;

    /// Maps a point of the polytope to the cube.
    void to_cube(std::span<const double> point, std::span<double> cube) const;

  private:
    struct Group {
        std::vector<std::size_t> coordinates;
        Box frame;
        FaceTree tree;
        std::vector<PolytopePlane> planes;  ///< planes of its facets, in the frame
        std::vector<double> rounding;       ///< tolerances for points on the planes, in the frame
    };

    void add_group(const std::vector<std::size_t>& coordinates, const std::vector<HalfSpace>& cuts);
    void take_moments(const Group& group);
    void map_some(const Group& group, std::span<const double> cube, std::span<double> image) const;
    /// A point's coordinates in a group, scaled from the group's `frame` to the unit cube.
    static PolytopePoint framed(const Group& group, std::span<const double> point);

    Box box_;
    Box around_;
    double volume_ = 1;
    Moments moments_;
    std::vector<Group> groups_;
};

}  // namespace stipple
