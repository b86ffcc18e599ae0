// SPDX-License-Identifier: MIT
//
// A convex polygon of directions, uniform in solid angle. Its cells come from the inverse of a map
// other than the warp's own, so that they are not aligned with the warp's strata.
//
// The area of a spherical triangle loses no digits, however small or thin the triangle is:
//
//     tan(area / 2) = |a . (b - a) x (c - a)| / (1 + a.b + b.c + c.a),    a where the two shorter
//                                                                         edges meet
//
// Moments on a polygon of area A by Stokes's theorem, from moments about an axis w. Edges e have
// inward unit normals n_e:
//
//     T_k(w) = integral of (w . v)^k over the polygon,    T_0 = A,
//     (k + 1) T_k(w) = (k - 1) w . w T_(k-2)(w) + sum_e w . n_e integral of (w . v)^(k-1) along e
//
// Source  J. Arvo, "Applications of irradiance tensors to the simulation of non-Lambertian
//         phenomena", SIGGRAPH 1995, 335-342, doi:10.1145/218380.218467 (axial moments).
//         A. Van Oosterom, J. Strackee, "The solid angle of a plane triangle", IEEE Transactions on
//         Biomedical Engineering 30 (1983) 125-126, doi:10.1109/TBME.1983.325207.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/domain.hpp"
#include "math/geometry/vector3.hpp"
#include "warps/curved/placement.hpp"
#include "warps/named_domain.hpp"

namespace stipple::warps {

/// Triple product a . (b x c) of three unit vectors, accurate even if they are close together.
double corner_volume(const Vector3& a, const Vector3& b, const Vector3& c);

/// Half the area of the triangle of three unit vectors, in turns of 2 pi: in [0, 1/2].
double half_area_turns(const Vector3& a, const Vector3& b, const Vector3& c);

class SphericalDomain final : public NamedDomain {
  public:
    using Cells = std::function<std::array<double, 2>(std::span<const double>)>;

    /// @param corners in order, in either direction; unit vectors, neighbours distinct
    /// @param inward for each corner, the inward unit normal of the plane of the edge that starts
    /// there; empty: computed from the corners, whose neighbours must not be antipodal
    /// @param cells map to the cube for to_cube(), instead of the inverse of the warp
    /// @param slack tolerance for rounding: distance beyond an edge's plane, and |length - 1|
    SphericalDomain(std::string spec, std::vector<Vector3> corners, std::vector<Vector3> inward,
                    Cells cells, double area, double slack, std::vector<std::string> axes);

    double measure() const override { return area_; }
    bool contains(std::span<const double> point) const override {
        return holds(vector_of(point), slack_);
    }
    Box bounding_box() const override;
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        put_clamped(cells_(point), cube);
    }

    /// The great circles of the edges.
    std::optional<SphereShape> sphere_shape() const override;

    /// Relative error up to 1e-8. Skewnesses of slivers longer than 96 degrees may be NaN. nullopt
    /// for areas below 1e-9, or 1e-3 for these, where differences lose more digits.
    std::optional<Moments> moments() const override;
    std::vector<std::string> cube_axes() const override { return axes_; }

  private:
    /// Whether a vector has length 1 and is inside all edges, both up to `slack`.
    bool holds(const Vector3& v, double slack) const;

    [[nodiscard]] Moments close_moments() const;

    /// The moments T_1, T_2, T_3 about an axis.
    std::array<double, 3> axial(const Vector3& w) const;

    /// The largest coordinate along `up` on the edge after corner i.
    double edge_top(std::size_t i, const Vector3& up) const;

    std::vector<Vector3> corners_;
    std::vector<Vector3> inward_;
    double turn_ = 1;  ///< orientation of the corners as seen from outside: 1 or -1
    Cells cells_;
    double area_;
    double slack_;
    std::vector<std::string> axes_;
};

}  // namespace stipple::warps
