// SPDX-License-Identifier: MIT
//
// Exact moments of distributions, from those of a shape in a frame of its own: of a shape that is
// put at a place, of one that is round about an axis, of triangles, of coordinates that do not
// depend on each other, and of distributions that are mixed by weights.
//
// Central moments about the mean m throughout, so that shapes far from 0 lose no digits:
//
//     covariance_ij = E (x_i - m_i)(x_j - m_j),    third_ijk = E (x_i - m_i)(x_j - m_j)(x_k - m_k)
//
// Source  Triangle: with d_i the corners' distances from their mean, E d^2 = sum d_i^2 / 12 and
//         E d^3 = sum d_i^3 / 30, by the moments of Dirichlet's distribution.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "math/geometry/vector3.hpp"

namespace stipple {

/// Of a coordinate; `third` is E (x - mean)^3.
struct LineMoments {
    double mean = 0;
    double variance = 0;
    double third = 0;
};

/// Of a distribution on the plane.
struct PlaneMoments {
    PlanePoint mean = {};
    double xx = 0, xy = 0, yy = 0;
    double xxx = 0, xxy = 0, xyy = 0, yyy = 0;
};

/// From E x^i y^j: the same, but about 0.
PlaneMoments about_the_mean(const PlaneMoments& raw);

/// Of a shape that is put at a place.
Moments placed_moments(const PlaneMoments& shape, const Placement& at);

/// Of a distribution in space that is round about the z axis.
struct AxialMoments {
    LineMoments along = {};   ///< z
    double across = 0;        ///< E x^2 = E y^2
    double across_along = 0;  ///< E x^2 (z - mean)
};

/// Of the unit vector whose height z has these E z, E z^2, E z^3.
AxialMoments direction_moments(double z, double zz, double zzz);

/// Of center + size * frame.out(q).
Moments axial_moments(const AxialMoments& shape, const Frame& frame, const Vector3& center = {},
                      double size = 1);

/// Of coordinates that do not depend on each other.
Moments independent_moments(std::span<const LineMoments> coordinates);

/// Of the uniform distribution on a triangle in any number of dimensions.
Moments triangle_moments(const std::array<std::vector<double>, 3>& corners);

/// Of x = sum of weights w_i times distributions, which need not add up to 1.
class MixedMoments {
  public:
    /// @param about a point near all of them
    explicit MixedMoments(std::vector<double> about);

    void add(double weight, const Moments& part);
    [[nodiscard]] Moments moments() const;

  private:
    std::vector<double> about_;
    double weight_ = 0;
    std::vector<double> first_;   ///< sums about `about`
    std::vector<double> second_;  ///< of each pair
    std::vector<double> third_;   ///< of each coordinate
};

}  // namespace stipple
