// SPDX-License-Identifier: MIT
//
// Convex polygons on the unit sphere, and the area of spherical triangles without loss of digits,
// however small they are:
//
//     tan(area / 2) = |a . (b - a) x (c - a)| / (1 + a.b + b.c + c.a)
//
// Moments of the uniform distribution on a polygon of area A, whose edges e have inward unit
// normals n_e, from those about an axis w, by Stokes's theorem:
//
//     T_k(w) = integral of (w . v)^k over it,    T_0 = A,
//     (k + 1) T_k(w) = (k - 1) w . w T_(k-2)(w) + sum_e w . n_e integral of (w . v)^(k-1) along e
//
// Source  J. Arvo, "Applications of irradiance tensors to the simulation of non-Lambertian
//         phenomena", SIGGRAPH 1995, 335-342, doi:10.1145/218380.218467 (axial moments).
//         A. Van Oosterom, J. Strackee, "The solid angle of a plane triangle", IEEE Transactions on
//         Biomedical Engineering 30 (1983) 125-126, doi:10.1109/TBME.1983.325207.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "math/geometry/vector3.hpp"

namespace stipple {

/// Half the area of the triangle of three unit vectors, in turns of 2 pi: in [0, 1/2].
double half_area_turns(const Vector3& a, const Vector3& b, const Vector3& c);

class SphericalPolygon {
  public:
    /// Corners in order, either way around; unit vectors, neighbours neither equal nor opposite.
    explicit SphericalPolygon(std::vector<Vector3> corners);

    /// Whether a vector is of length 1 and inside all edges, both up to `slack`.
    [[nodiscard]] bool contains(const Vector3& v, double slack) const;

    /// The great circles of its edges.
    [[nodiscard]] std::vector<SphereCircle> edges() const;

    /// The smallest axis-parallel box around it.
    [[nodiscard]] Box bounding_box() const;

    /// Of the uniform distribution, within 1e-8 of their size; none for areas below 1e-3, where
    /// differences lose too many digits.
    [[nodiscard]] std::optional<Moments> moments(double area) const;

  private:
    /// T_1, T_2, T_3 about an axis.
    [[nodiscard]] std::array<double, 3> axial(const Vector3& w, double area) const;

    /// The highest that the edge after corner i reaches along `up`.
    [[nodiscard]] double edge_top(std::size_t i, const Vector3& up) const;

    std::vector<Vector3> corners_;
    std::vector<Vector3> inward_;  ///< unit normal of the plane of the edge after each corner
};

}  // namespace stipple
