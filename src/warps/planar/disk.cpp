// SPDX-License-Identifier: MIT
//
// Unit square onto a disk of radius R about a centre c, by one of four methods:
//
//     polar       r = R sqrt(xi0),  theta = 2 pi xi1
//     concentric  a = 2 xi0 - 1, b = 2 xi1 - 1;  r = R a, theta = (pi / 4) b / a where |a| > |b|,
//                 else r = R b, theta = pi / 2 - (pi / 4) a / b: concentric squares become circles
//     rejection   c + R (a, b), kept if a^2 + b^2 < 1: the fraction kept is pi / 4 = 0.785...
//     naive       r = R xi0,  theta = 2 pi xi1: BIASED towards the centre; kept to show the bias
//
// and the inverses. The point is c + r (cos theta, sin theta).
//
// Shape   2 unit coordinates, 2 coordinates.
// Strata  xi0 is used directly, not as 1 - xi0: small xi0 is near the centre (polar, naive) or left
//         (concentric, rejection). xi1 turns from the x axis towards the y axis (polar, naive).
//         With polar, strata become sectors of rings; concentric keeps neighbours adjacent;
//         rejection preserves strata and drops those outside.
// Cost    O(1) a point; about 5 ns forward, 9 ns inverse on one core.
// Promise density 1 / (pi R^2), except for naive: 1 / (2 pi R r), infinite at the centre. Points
//         lie in the closed disk up to 16 epsilon (R + |cx| + |cy|). A round trip returns the same
//         point within 1e-14 of |c| + R; for c = 0 also the same xi within 1e-14, except that the
//         centre returns xi1 = 0 (polar, naive). The same bits on every machine.
// Source  Concentric: P. Shirley, K. Chiu, "A low distortion map between disk and square",
//         J. Graphics Tools 2(3) (1997) 45-52, doi:10.1080/10867651.1997.10487479.

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "math/geometry/disk_maps.hpp"
#include "warps/common_options.hpp"
#include "warps/planar/placed_shape.hpp"
#include "warps/planar/ring_sector.hpp"

namespace stipple::warps::disk {
namespace {

constexpr Param<Choice> method{
    .name = "method",
    .fallback = "polar",
    .choices = "polar|concentric|rejection|naive",
    .help =
        "polar: rings and sectors; concentric: maps squares to circles, keeps neighbours close; "
        "rejection: drops the points of the square that are outside; naive: r = R xi1, BIASED "
        "towards the centre, kept to show the bias"};

constexpr auto radius = length_option("radius", 1, "Radius of the disk, above 0");

// The methods on the unit disk.

struct Rejection {
    static PlanePoint forward(double u, double v) { return {2 * u - 1, 2 * v - 1}; }
    static PlanePoint inverse(double x, double y) { return {0.5 + 0.5 * x, 0.5 + 0.5 * y}; }
};

struct Naive {
    static PlanePoint forward(double u, double v) {
        const auto [c, s] = cos_sin_turns(v);
        return {u * c, u * s};
    }
    static PlanePoint inverse(double x, double y) {
        return {std::sqrt(x * x + y * y), turns_of(x, y)};
    }
};

struct ByRejection : PlacedMethod<Rejection> {
    bool keeps(const std::array<double, 2>& xi) const {
        const auto [x, y] = Rejection::forward(xi[0], xi[1]);
        return x * x + y * y < 1;
    }
};

struct ByNaive : PlacedMethod<Naive> {
    double density(std::span<const double> point) const {
        const auto [x, y] = at.to_frame(point[0], point[1]);
        return 0.5 * std::numbers::inv_pi / std::sqrt(x * x + y * y) / at.size / at.size;
    }
};

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    constexpr double any = std::numeric_limits<double>::infinity();
    for (const double x : want.options[shape_center]) refuse_far(x, want.options[radius]);
    const auto at = place(want.options[shape_center], want.options[radius], 0, any, "radius");
    const auto disk = std::make_shared<PlacedDomain<RingSector>>(
        want.spec({radius.name, shape_center.name}), RingSector{}, at);
    const std::string how = want.options[method];
    if (how == "concentric")
        return row_mapping(disk, PlacedMethod<ConcentricDisk>{.shape = {}, .at = at});
    if (how == "rejection") return row_mapping(disk, ByRejection{{.shape = {}, .at = at}});
    if (how == "naive") return row_mapping(disk, ByNaive{{.shape = {}, .at = at}});
    return row_mapping(disk, PlacedMethod<PolarDisk>{.shape = {}, .at = at});
}

}  // namespace

Warp unit() {
    return {.name = "disk",
            .summary = "Disk, uniform by area (method naive is biased, kept to show its bias)",
            .source = "Shirley, Chiu 1997, doi:10.1080/10867651.1997.10487479 (concentric)",
            .related = {"concentric", "shirley", "unit-disk"},
            .strata =
                "polar: xi1 is the fraction of the area within the radius, xi2 the angle, both "
                "used directly; concentric: squares about the centre become rings, left stays left",
            .traits = {.drops = true, .biased = true},
            .options = Schema(method, radius, shape_center, orientation),
            .aliases = {"disc"},
            .mapping = make};
}

}  // namespace stipple::warps::disk
