// SPDX-License-Identifier: MIT
//
// Unit cube onto the sphere of radius R about a centre c, by one of three methods:
//
//     z               z = 1 - 2 xi0,  theta = 2 pi xi1,
//                     point = c + R (sqrt(1 - z^2) cos theta, sqrt(1 - z^2) sin theta, z)
//     rejection       v = 2 xi - 1 in [-1, 1]^3, kept if inner <= |v| <= 1; point = c + R v / |v|.
//                     The fraction kept is (pi / 6) (1 - inner^3): 0.5230752 for inner = 0.1
//     naive-lat-long  z = cos(pi xi0),  theta = 2 pi xi1: BIASED towards the poles (E z^2 = 1/2
//                     instead of 1/3 on the unit sphere); kept to show the bias
//
// and the inverses of z and naive-lat-long. sqrt(1 - z^2) is computed as 2 sqrt(xi0 (1 - xi0)).
//
// Shape   2 unit coordinates, rejection 3; 3 coordinates.
// Strata  xi0 increases from 0 at the north pole to 1 at the south pole; xi1 turns from x towards
//         y. xi are used directly, not as 1 - xi. Strata become rectangles of heights and
//         longitudes. With rejection, the kept part of each stratum is projected from the centre.
// Cost    O(1) a point; on one core about 7 ns forward, 40 ns inverse.
// Promise density 1 / (4 pi R^2), except for naive-lat-long: 1 / (2 pi^2 R r), r the distance from
//         the axis, infinite at the poles. Points lie on the sphere up to the rounding stated at
//         contains(). A round trip returns the same point within 1e-14 of |c| + R and, for c = 0,
//         the same xi within 1e-14, except that the poles return xi1 = 0. The same bits on every
//         machine.
// Source  Archimedes, On the Sphere and Cylinder (areas of zones). Rejection: G. Marsaglia, Annals
//         of Mathematical Statistics 43 (1972) 645-646, doi:10.1214/aoms/1177692644, compares it.

#include <numbers>

#include "math/geometry/law_moments.hpp"
#include "math/geometry/polar_direction.hpp"
#include "warps/curved/placement.hpp"
#include "warps/row_mapping.hpp"

namespace stipple::warps::sphere {
namespace {

constexpr Param<Choice> method{
    .name = "method",
    .fallback = "z",
    .choices = "z|rejection|naive-lat-long",
    .help =
        "z: uniform height and longitude; rejection: uses 3 coordinates, drops points outside the "
        "ball and normalises the others; naive-lat-long: uniform latitude and longitude, BIASED "
        "towards the poles, kept to show the bias"};

constexpr Param<double> inner{.name = "inner",
                              .fallback = 0.1,
                              .low = 0,
                              .high = 0.99,
                              .help =
                                  "For method rejection: points nearer to the centre are dropped, "
                                  "because their direction is coarse"};

class SphereDomain final : public NamedDomain {
  public:
    SphereDomain(const Sphere& sphere, std::string spec)
        : NamedDomain(std::move(spec), 3, 2), sphere_(sphere), slack_(sphere.rounding()) {}

    double measure() const override {
        return 4 * std::numbers::pi * sphere_.radius * sphere_.radius;
    }

    /// Allows a distance of 8 epsilon (R + largest |c|), the rounding error of generated points.
    bool contains(std::span<const double> point) const override {
        return std::abs(length(sphere_.unit(point)) - 1) <= slack_;
    }
    Box bounding_box() const override { return sphere_.bounding_box(); }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        const Vector3 v = sphere_.unit(point);
        cube[0] = 0.5 * one_minus_cos(v);
        cube[1] = turns_of(v[0], v[1]);
    }
    std::optional<Moments> moments() const override {
        return axial_moments(direction_moments(0, 1 / 3.0, 0), {}, sphere_.center, sphere_.radius);
    }
    std::vector<std::string> cube_axes() const override {
        return {"area fraction (1 - z/R) / 2", "longitude in turns"};
    }

  private:
    Sphere sphere_;
    double slack_;
};

struct ByHeight {
    Sphere sphere;

    Vector3 forward(const std::array<double, 2>& xi) const {
        return sphere.place(polar_direction(2 * xi[0], 2 * (1 - xi[0]), xi[1]));
    }
};

struct ByLatitude {
    Sphere sphere;

    Vector3 forward(const std::array<double, 2>& xi) const {
        const auto [z, r] = cos_sin_turns(0.5 * xi[0]);
        const auto [c, s] = cos_sin_turns(xi[1]);
        return sphere.place({r * c, r * s, z});
    }
    std::array<double, 2> inverse(std::span<const double> point) const {
        const Vector3 v = sphere.unit(point);
        return {2 * turns_of(v[2], std::sqrt(v[0] * v[0] + v[1] * v[1])), turns_of(v[0], v[1])};
    }
    double density(std::span<const double> point) const {
        const Vector3 v = sphere.unit(point);
        const double r = sphere.radius * std::sqrt(v[0] * v[0] + v[1] * v[1]);
        return 1 / (2 * std::numbers::pi * std::numbers::pi * sphere.radius * r);
    }
};

struct ByRejection {
    static constexpr const char* no_way_back =
        "method rejection maps 3 coordinates to 2; it has no inverse";

    Sphere sphere;
    double inner;

    static Vector3 scaled(const Vector3& xi) {
        return {2 * xi[0] - 1, 2 * xi[1] - 1, 2 * xi[2] - 1};
    }
    Vector3 forward(const Vector3& xi) const {
        const Vector3 v = scaled(xi);
        const double size = length(v);
        return sphere.place(times(v, 1 / (size > 0 ? size : 1)));
    }
    bool keeps(const Vector3& xi) const {
        const double size = length(scaled(xi));
        return size > 0 && size >= inner && size <= 1;
    }
};

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const Sphere sphere{want.options[radius], center_of(want.options, want.options[radius])};
    const auto domain =
        std::make_shared<SphereDomain>(sphere, want.spec({radius.name, center_option.name}));
    const std::string how = want.options[method];
    if (how == "rejection") return row_mapping(domain, ByRejection{sphere, want.options[inner]});
    if (how == "naive-lat-long") return row_mapping(domain, ByLatitude{sphere});
    return row_mapping(domain, ByHeight{sphere});
}

}  // namespace

Warp unit() {
    return {.name = "sphere",
            .summary =
                "Sphere, uniform by area (method naive-lat-long is biased, kept to show its bias)",
            .source = "Marsaglia 1972, doi:10.1214/aoms/1177692644 (rejection)",
            .related = {"unit-sphere", "marsaglia"},
            .strata =
                "xi1 is the fraction of the area from the north pole z = R to the south pole; xi2 "
                "is the longitude; both are used directly",
            .traits = {.drops = true, .biased = true},
            .options = Schema(method, radius, center_option, inner, orientation),
            .mapping = make};
}

}  // namespace stipple::warps::sphere
