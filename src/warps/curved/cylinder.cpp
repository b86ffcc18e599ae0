// SPDX-License-Identifier: MIT
//
// Unit square onto the lateral surface of a cylinder of radius R and height H about a centre c,
// uniform by area:
//
//     point = c + R cos(2 pi xi1) x + R sin(2 pi xi1) y + H (xi0 - 1/2) z
//
// in a frame about its axis z; with --caps onto its whole surface. Each cap has the fraction s = R
// / (2 (R + H)) of the area. Points with xi0 < s are on the lower cap, R sqrt(xi0 / s) from the
// axis; points with xi0 > 1 - s are on the upper cap, R sqrt((1 - xi0) / s) from the axis. Other
// points are on the side, at the height H ((xi0 - s) / (1 - 2 s) - 1/2).
//
// Shape   2 unit coordinates, 3 coordinates.
// Strata  xi0 increases from the lower end, with --caps from the centre of the lower cap to that of
//         the upper one; xi1 turns from x towards y if the axis is z. xi are used directly. Strata
//         become rectangles, on the caps pieces of rings.
// Cost    O(1) a point; on one core about 6 ns forward (7 with caps), 35 to 50 ns inverse.
// Promise density 1 / (2 pi R H), with --caps 1 / (2 pi R (R + H)). Points lie on the surface up to
//         the rounding stated at contains(). A round trip returns the same point within 1e-14 of
//         |c| + R + H. The same bits on every machine.
// Beware  given points near the centre of the upper cap have an inverse xi0 rounded next to 1,
//         which maps to a point up to 1e-8 R away.
// Source  L. Devroye, Non-Uniform Random Variate Generation (1986), chapter V.4,
//         doi:10.1007/978-1-4613-8643-8 (Archimedes' theorem).

#include <limits>
#include <numbers>

#include "math/functions/trigonometry.hpp"
#include "math/geometry/law_moments.hpp"
#include "warps/curved/placement.hpp"
#include "warps/row_mapping.hpp"

namespace stipple::warps::cylinder {
namespace {

constexpr auto height = length_option("height", 1, "Height along the axis, above 0");

constexpr Param<bool> caps{.name = "caps",
                           .help = "Include the two ends, so that the whole surface is sampled"};

/// Cylindrical coordinates of a point: distance from the axis, height, angle.
struct Polar {
    double distance;
    double height;
    double turns;
};

struct Cylinder {
    double radius;
    double height;
    Vector3 center;
    Frame frame;
    bool caps;

    double area() const {
        return 2 * std::numbers::pi * radius * (caps ? radius + height : height);
    }
    double slack() const {
        return 16 * std::numeric_limits<double>::epsilon() * (radius + height + largest(center));
    }
    double cap_share() const { return caps ? 0.5 * (radius / (radius + height)) : 0; }
    double side_share() const { return caps ? height / (radius + height) : 1; }

    Polar polar(std::span<const double> point) const {
        const auto [x, y, z] = frame.in(minus(vector_of(point), center));
        return {std::sqrt(x * x + y * y), z, turns_of(x, y)};
    }
    Vector3 place(const Polar& at) const {
        const auto [c, s] = cos_sin_turns(at.turns);
        return plus(center, frame.out({at.distance * c, at.distance * s, at.height}));
    }

    /// Cube coordinates of a point: fraction of the area below it, and angle in turns.
    std::array<double, 2> shares(std::span<const double> point) const {
        const auto [distance, z, turns] = polar(point);
        const double share = cap_share();
        const bool inside = caps && distance < radius - slack();
        const double ratio = distance / radius;
        const double side = std::clamp(z / height + 0.5, 0.0, 1.0);
        if (inside) return {z < 0 ? share * ratio * ratio : 1 - share * ratio * ratio, turns};
        return {share + side_share() * side, turns};
    }
};

class CylinderDomain final : public NamedDomain {
  public:
    CylinderDomain(const Cylinder& shape, std::string spec)
        : NamedDomain(std::move(spec), 3, 2), shape_(shape) {}

    double measure() const override { return shape_.area(); }

    /// Allows a distance of 16 epsilon (R + H + largest |c|), for the rounding of generated points.
    bool contains(std::span<const double> point) const override {
        const auto [distance, z, turns] = shape_.polar(point);
        const double slack = shape_.slack();
        const double beyond = std::abs(z) - 0.5 * shape_.height;
        if (!(beyond <= slack && distance <= shape_.radius + slack)) return false;
        return distance >= shape_.radius - slack || (shape_.caps && beyond >= -slack);
    }
    Box bounding_box() const override {
        return box_about(shape_.center, shape_.frame.z, 0, 0.5 * shape_.height, shape_.radius);
    }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        put_clamped(shape_.shares(point), cube);
    }
    std::optional<Moments> moments() const override {
        const double rr = shape_.radius * shape_.radius;
        const double hh = shape_.height * shape_.height;
        const double side = shape_.side_share();
        const AxialMoments round{.along = {0, hh * (side / 12 + (1 - side) / 4), 0},
                                 .across = rr * (side / 2 + (1 - side) / 4)};
        return axial_moments(round, shape_.frame, shape_.center);
    }
    std::vector<std::string> cube_axes() const override {
        return {"fraction of the area below", "angle in turns"};
    }

  private:
    Cylinder shape_;
};

struct Side {
    Cylinder shape;

    Vector3 forward(const std::array<double, 2>& xi) const {
        return shape.place({shape.radius, shape.height * (xi[0] - 0.5), xi[1]});
    }
};

struct Whole {
    Cylinder shape;
    double cap = shape.cap_share();
    double side = shape.side_share();

    Vector3 forward(const std::array<double, 2>& xi) const {
        const double below = xi[0];
        const double above = 1 - below;
        // Fraction of the area between the point and the nearer cap's centre.
        const double end = std::min(below, above);
        const double ratio = std::sqrt(std::min(end / cap, 1.0));
        const double z = std::max(0.0, std::min((below - cap) / side, 1.0)) - 0.5;
        return shape.place({shape.radius * ratio, shape.height * z, xi[1]});
    }
};

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const double r = want.options[radius];
    const double h = want.options[height];
    const Cylinder shape{r, h, center_of(want.options, std::min(r, h)), frame_of(want.options),
                         want.options[caps]};
    const auto surface = std::make_shared<CylinderDomain>(shape, want.spec());
    if (shape.caps) return row_mapping(surface, Whole{shape});
    return row_mapping(surface, Side{shape});
}

}  // namespace

Warp unit() {
    return {.name = "cylinder",
            .summary = "Lateral or whole surface of a cylinder, uniform by area",
            .source = "Devroye 1986, doi:10.1007/978-1-4613-8643-8, chapter V.4",
            .strata =
                "xi1 is the fraction of the area from the lower to the upper end (with --caps, "
                "between the centres of the caps); xi2 is the angle; both are used directly",
            .options = Schema(radius, height, center_option, axis_option, caps),
            .mapping = make};
}

}  // namespace stipple::warps::cylinder
