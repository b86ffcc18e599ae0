// SPDX-License-Identifier: MIT
//
// Unit square onto the directions within an angle alpha of an axis n, uniform in solid angle:
//
//     1 - cos theta = 2 sin^2(alpha / 2) xi0,  longitude 2 pi xi1,  solid angle 4 pi sin^2(alpha/2)
//
// and its inverse. 1 - cos is never computed as a difference, so cones may be arbitrarily thin.
//
// Shape   2 unit coordinates; 3 coordinates, of unit length. alpha = 90 is a hemisphere, 180 the
//         sphere.
// Units   degrees for alpha.
// Strata  xi0 increases from 0 on the axis to 1 at the rim; xi1 turns from x towards y if the axis
//         is z. xi are used directly, not as 1 - xi. Strata become rectangles of heights and
//         longitudes.
// Cost    O(1) a point; on one core about 6 ns forward, 35 ns inverse.
// Promise density 1 / (solid angle). Directions lie in the cone up to the rounding stated at
//         contains(). A round trip returns the same direction within 1e-14. If the axis is z, it
//         also returns x and y within a relative 1e-14 and the same xi within 1e-14, except that
//         the axis returns xi1 = 0. The same bits on every machine.
// Source  L. Devroye, Non-Uniform Random Variate Generation (1986), chapter V.4,
//         doi:10.1007/978-1-4613-8643-8 (Archimedes' theorem).

#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "math/geometry/law_moments.hpp"
#include "math/geometry/polar_direction.hpp"
#include "warps/curved/placement.hpp"
#include "warps/row_mapping.hpp"

namespace stipple::warps::cone {
namespace {

constexpr Param<double> half_angle{.name = "half-angle",
                                   .fallback = 30,
                                   .low = 1e-150,
                                   .high = 180,
                                   .unit = "degrees",
                                   .help = "Angle between the axis and the rim"};

/// Spherical cap: the directions within an angle of an axis.
struct Cap {
    Frame frame;
    CosSin rim;   ///< cosine and sine of the angle between axis and rim
    CosSin half;  ///< likewise for half of that angle

    /// 1 - cos and 1 + cos of the angle from the axis to the rim.
    double rim_minus() const { return rim.cos > 0.5 ? 2 * half.sin * half.sin : 1 - rim.cos; }
    double rim_plus() const { return rim.cos < -0.5 ? 2 * half.cos * half.cos : 1 + rim.cos; }

    /// Cube coordinates: fraction of the solid angle nearer to the axis, and longitude in turns.
    std::array<double, 2> shares(std::span<const double> point) const {
        const Vector3 v = frame.in(vector_of(point));
        const double least = one_minus_abs_cos(v);
        const double share =
            v[2] >= 0 ? least / rim_minus() : 1 - (least - rim_plus()) / rim_minus();
        return {share, turns_of(v[0], v[1])};
    }
};

class ConeDomain final : public NamedDomain {
  public:
    ConeDomain(const Cap& cap, std::string spec)
        : NamedDomain(std::move(spec), 3, 2),
          cap_(cap),
          rim_slack_(slack * (cap.frame.z == Frame().z ? std::min(2 * cap.half.sin, 1.0) : 1)) {}

    double measure() const override { return 2 * std::numbers::pi * cap_.rim_minus(); }

    /// Allows rounding errors of 8 epsilon in the length and beyond the rim. Thin cones about z,
    /// with a rim at a distance r from the pole, allow only 8 epsilon r beyond the rim.
    bool contains(std::span<const double> point) const override {
        const auto [x, y, z] = cap_.frame.in(vector_of(point));
        const double rr = x * x + y * y;
        if (!(std::abs(std::sqrt(rr + z * z) - 1) <= slack)) return false;
        // Compares the point's and the rim's straight-line distances from the pole next to the rim.
        if (cap_.half.sin <= cap_.half.cos)
            return std::sqrt(rr + (z - 1) * (z - 1)) <= 2 * cap_.half.sin + rim_slack_;
        return std::sqrt(rr + (z + 1) * (z + 1)) >= 2 * cap_.half.cos - slack;
    }

    /// Extends from the lowest to the highest point of the cap along each coordinate axis.
    Box bounding_box() const override {
        const auto [cos_rim, sin_rim] = cap_.rim;
        Box box;
        for (std::size_t k = 0; k < 3; ++k) {
            const double z = cap_.frame.z[k];
            const double across = std::sqrt(std::max(0.0, 1 - z * z));
            box.low.push_back(-z >= cos_rim ? -1 : z * cos_rim - across * sin_rim);
            box.high.push_back(z >= cos_rim ? 1 : z * cos_rim + across * sin_rim);
        }
        return box;
    }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        put_clamped(cap_.shares(point), cube);
    }
    std::optional<SphereShape> sphere_shape() const override {
        return SphereShape{.circles = {{cap_.frame.z, cap_.rim.cos}}};
    }
    std::optional<Moments> moments() const override {
        // 1 - z is uniform on [0, v]. In terms of v, thin cones lose no digits.
        const double v = cap_.rim_minus();
        const AxialMoments round{.along = {1 - 0.5 * v, v * v / 12, 0},
                                 .across = v * (0.5 - v / 6),
                                 .across_along = v * v * (v / 24 - 1 / 12.0)};
        return axial_moments(round, cap_.frame);
    }
    std::vector<std::string> cube_axes() const override {
        return {"fraction of the solid angle (1 - cos theta) / (1 - cos alpha)",
                "longitude in turns"};
    }

  private:
    static constexpr double slack = 8 * std::numeric_limits<double>::epsilon();

    Cap cap_;
    double rim_slack_;
};

struct ByHeight {
    Cap cap;

    Vector3 forward(const std::array<double, 2>& xi) const {
        const double below = cap.rim_minus() * xi[0];  // 1 - cos theta
        const double above = cap.rim_plus() + cap.rim_minus() * (1 - xi[0]);
        return cap.frame.out(polar_direction(below, above, xi[1]));
    }
};

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const double degrees = want.options[half_angle];
    const Frame frame = frame_of(want.options);
    const bool along = std::ranges::count_if(frame.z, [](double x) { return x != 0; }) == 1;
    // Directions about an oblique axis have rounding errors of about 1e-14 degrees.
    if (!along && degrees < 1e-10)
        fail(
            ErrorKind::usage,
            "--half-angle: {} is below 1e-10, the minimum for an axis other than a coordinate axis",
            degrees);
    const Cap cap{frame, cos_sin_turns(degrees / 360), cos_sin_turns(degrees / 720)};
    const auto cone = std::make_shared<ConeDomain>(cap, want.spec());
    return row_mapping(cone, ByHeight{cap});
}

}  // namespace

Warp unit() {
    return {.name = "cone",
            .summary = "Directions within an angle of an axis, uniform in solid angle",
            .source = "Devroye 1986, doi:10.1007/978-1-4613-8643-8, chapter V.4",
            .related = {"cap"},
            .strata =
                "xi1 is the fraction of the solid angle, from 0 on the axis to 1 at the rim; xi2 "
                "is the longitude; both are used directly",
            .options = Schema(half_angle, axis_option),
            .aliases = {"spherical-cap"},
            .mapping = make};
}

}  // namespace stipple::warps::cone
