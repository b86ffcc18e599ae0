// SPDX-License-Identifier: MIT
//
// A box cut by half-spaces, of any number of dimensions, and the map of the unit cube onto it that
// preserves shares of the volume. Coordinates that no inequality joins are independent, so each
// group of joined ones is a polytope by itself (math/polytopes/face_tree.hpp), of at most 12
// dimensions, and the others are intervals.
//
// A group is computed in the frame of a box not much larger than itself, so that sizes may differ
// by any factor. What is thinner than 1e-11 of that box is flat. Inequalities that cut nothing off,
// touch in a face, or say the same but for rounding, change nothing; where two differ by 1e-13 to
// 1e-9, what meets in a vertex may be lost in rounding, which is noticed and refused.
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
    /// @throws Error(usage) if no point satisfies all, or only some without volume; Error(limit)
    Polytope(Box box, const std::vector<HalfSpace>& cuts);

    [[nodiscard]] std::size_t dimension() const { return box_.dimension(); }
    [[nodiscard]] double volume() const { return volume_; }
    /// By the vertices.
    [[nodiscard]] const Box& bounding_box() const { return around_; }
    [[nodiscard]] const Moments& moments() const { return moments_; }

    /// Up to the rounding that a point on the rim has.
    [[nodiscard]] bool contains(std::span<const double> point) const;

    /// Point after point. Each group has its own unit coordinates, in the places of the
    /// coordinates; those of intervals are kept as they are.
    void from_cube(std::span<const double> cube, std::span<double> image) const;
    /// What unit coordinate k means, for people.
    [[nodiscard]] std::string cube_axis(std::size_t k) const;

    /// Of a point that it contains.
    void to_cube(std::span<const double> point, std::span<double> cube) const;

  private:
    struct Group {
        std::vector<std::size_t> coordinates;
        Box frame;
        FaceTree tree;
        std::vector<PolytopePlane> planes;  ///< of its facets, in the frame
        std::vector<double> rounding;  ///< by which a point on a plane may miss it, in the frame
    };

    void add_group(const std::vector<std::size_t>& coordinates, const std::vector<HalfSpace>& cuts);
    void take_moments(const Group& group);
    void map_some(const Group& group, std::span<const double> cube, std::span<double> image) const;
    /// A point's place in the frame of a group.
    static PolytopePoint framed(const Group& group, std::span<const double> point);

    Box box_;
    Box around_;
    double volume_ = 1;
    Moments moments_;
    std::vector<Group> groups_;
};

}  // namespace stipple
