// SPDX-License-Identifier: MIT
//
// Exact moments of distributions: shapes placed in the plane, distributions in space with an axis
// of symmetry, triangles, independent coordinates, and weighted mixtures.
//
// All are central moments about the mean m, so that shapes far from 0 lose no digits:
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

/// Moments of a coordinate; `third` is E (x - mean)^3. The variance is in units of `unit`^2, the
/// third moment in `unit`^3: in units of the coordinate, tiny ones would vanish.
struct LineMoments {
    double mean = 0;
    double variance = 0;
    double third = 0;
    double unit = 1;  ///< a power of 2
};

/// Central moments of a distribution on the plane, such as xxy = E (x - m_x)^2 (y - m_y).
struct PlaneMoments {
    PlanePoint mean = {};
    double xx = 0, xy = 0, yy = 0;
    double xxx = 0, xxy = 0, xyy = 0, yyy = 0;
};

/// Converts raw moments E x^i y^j to central moments.
PlaneMoments about_the_mean(const PlaneMoments& raw);

/// Moments of a shape after its placement.
Moments placed_moments(const PlaneMoments& shape, const Placement& at);

/// Central moments of a distribution in space that is symmetric about the z axis.
struct AxialMoments {
    LineMoments along = {};   ///< moments of z
    double across = 0;        ///< E x^2 = E y^2
    double across_along = 0;  ///< E x^2 (z - mean)
};

/// Moments of an axially symmetric unit vector, from the means of z, z^2 and z^3.
AxialMoments direction_moments(double z, double zz, double zzz);

/// Moments of center + size * frame.out(q), with q distributed like `shape`.
Moments axial_moments(const AxialMoments& shape, const Frame& frame, const Vector3& center = {},
                      double size = 1);

Moments independent_moments(std::span<const LineMoments> coordinates);

/// Moments of the uniform distribution on a triangle in any number of dimensions.
Moments triangle_moments(const std::array<std::vector<double>, 3>& corners);

/// Moments of a mixture of distributions with weights that need not sum to 1. Each part is merged
/// into the central moments of those before it, so that no digits are lost wherever they are.
class MixedMoments {
  public:
    /// @param around box of the distributions, whose extents give the units
    explicit MixedMoments(const Box& around);

    void add(double weight, const Moments& part);
    /// Skewnesses are NaN if their digits are lost beside the box.
    [[nodiscard]] Moments moments() const;

  private:
    double weight_ = 0;
    std::vector<double> per_unit_;
    std::vector<double> mean_;
    std::vector<double> off_;         ///< from the mean to that of the part being added, in units
    std::vector<double> covariance_;  ///< its lower triangle, in units
    std::vector<double> third_;       ///< central, in units
};

}  // namespace stipple
