// SPDX-License-Identifier: MIT
//
// Unit cube onto the ball of radius R about a centre c, uniform by volume:
//
//     r = R cbrt(xi0),  z = r (1 - 2 xi1),  longitude 2 pi xi2
//
// and its inverse.
//
// Shape   3 unit coordinates, 3 coordinates.
// Strata  xi0 increases from the centre, xi1 from the north pole to the south pole, xi2 turns from
//         x towards y; xi are used directly, not as 1 - xi. Strata become pieces of shells.
// Cost    O(1) a point; on one core about 11 ns forward, 40 ns inverse.
// Promise density 3 / (4 pi R^3). Points lie in the closed ball up to the rounding stated at
//         contains(). A round trip returns the same point within 1e-14 of |c| + R and, for c = 0,
//         the same xi within 1e-14. Exceptions: the centre returns xi1 = 1/2, xi2 = 0, and points
//         on the axis xi2 = 0. The same bits on every machine.
// Beware  using R xi0 instead of its cube root is a common mistake: points crowd in the middle.
// Source  L. Devroye, Non-Uniform Random Variate Generation (1986), chapter V.4,
//         doi:10.1007/978-1-4613-8643-8.

#include <algorithm>
#include <numbers>

#include "core/domain.hpp"
#include "math/densities/quadrature.hpp"
#include "math/functions/roots.hpp"
#include "math/geometry/law_moments.hpp"
#include "math/geometry/planar_area.hpp"
#include "math/geometry/polar_direction.hpp"
#include "warps/curved/placement.hpp"
#include "warps/row_mapping.hpp"

namespace stipple::warps::ball {
namespace {

constexpr Param<double> ball_radius{
    .name = "radius", .fallback = 1, .low = 1e-90, .high = 1e90, .help = "Radius, above 0"};

/// Cube coordinates of a point of the unit ball.
std::array<double, 3> shares(const Vector3& v) {
    const double r = length(v);
    return {std::min(r * r * r, 1.0), 0.5 * one_minus_cos(v), turns_of(v[0], v[1])};
}

class BallDomain final : public NamedDomain {
  public:
    BallDomain(const Sphere& sphere, std::string spec)
        : NamedDomain(std::move(spec), 3, 3), sphere_(sphere), slack_(sphere.rounding()) {}

    double measure() const override {
        const double r = sphere_.radius;
        return 4 * std::numbers::pi / 3 * r * r * r;
    }

    /// Allows 8 epsilon (R + largest |c|) beyond the sphere, for the rounding of generated points.
    bool contains(std::span<const double> point) const override {
        return length(sphere_.unit(point)) <= 1 + slack_;
    }
    Box bounding_box() const override { return sphere_.bounding_box(); }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        std::ranges::copy(shares(sphere_.unit(point)), cube.begin());
    }
    /// Integral over z of the area of the ball's cross-section within the box's sides. The integral
    /// is split where the cross-section touches a side or a corner.
    std::optional<Estimate> box_mass(const Box& box) const override {
        std::array<double, 3> low{};
        std::array<double, 3> high{};
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::max((box.low[k] - sphere_.center[k]) / sphere_.radius, -1.0);
            high[k] = std::min((box.high[k] - sphere_.center[k]) / sphere_.radius, 1.0);
            if (!(low[k] < high[k])) return Estimate{};
        }
        std::vector<double> cuts;
        const auto cut = [&](double rr) {
            if (rr < 1) cuts.insert(cuts.end(), {-std::sqrt(1 - rr), std::sqrt(1 - rr)});
        };
        for (const double x : {low[0], high[0]}) {
            cut(x * x);
            for (const double y : {low[1], high[1]}) cut(x * x + y * y);
        }
        for (const double y : {low[1], high[1]}) cut(y * y);
        const Polygon window{
            {low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}};
        const auto slice = [&](double z) {
            const double rr = std::max((1 - z) * (1 + z), 0.0);
            return area_in_disk(window, {0, 0}, std::sqrt(rr));
        };
        const Estimate volume = integrate_pieces(slice, ends_of(std::move(cuts), low[2], high[2]));
        constexpr double whole = 4 * std::numbers::pi / 3;
        return Estimate{volume.value / whole, volume.error / whole};
    }
    std::optional<Moments> moments() const override {
        const AxialMoments unit{.along = {0, 0.2, 0}, .across = 0.2};
        return axial_moments(unit, {}, sphere_.center, sphere_.radius);
    }
    std::vector<std::string> cube_axes() const override {
        return {"volume fraction r^3/R^3", "fraction of the shell (1 - z/r) / 2",
                "longitude in turns"};
    }

  private:
    Sphere sphere_;
    double slack_;
};

struct ByVolume {
    Sphere sphere;

    Vector3 forward(const Vector3& xi) const {
        return sphere.place(
            times(polar_direction(2 * xi[1], 2 * (1 - xi[1]), xi[2]), cube_root(xi[0])));
    }
};

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const double r = want.options[ball_radius];
    const Sphere sphere{r, center_of(want.options, r)};
    const auto domain = std::make_shared<BallDomain>(sphere, want.spec());
    return row_mapping(domain, ByVolume{sphere});
}

}  // namespace

Warp unit() {
    return {.name = "ball",
            .summary = "Ball in space, uniform by volume",
            .source = "Devroye 1986, doi:10.1007/978-1-4613-8643-8, chapter V.4",
            .related = {"unit-ball"},
            .strata =
                "xi1 is the fraction of the volume within the radius, xi2 decreases from the north "
                "to the south pole, xi3 is the longitude; all are used directly",
            .options = Schema(ball_radius, center_option),
            .mapping = make};
}

}  // namespace stipple::warps::ball
