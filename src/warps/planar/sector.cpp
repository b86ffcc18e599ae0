// SPDX-License-Identifier: MIT
//
// Unit square onto the sector of a disk or annulus with radii q < R about a centre c, between two
// angles alpha < beta:
//
//     r = sqrt(q^2 + xi0 (R^2 - q^2)),  theta = alpha + xi1 (beta - alpha)
//     point = c + r (cos theta, sin theta)
//
// The inverse uses xi0 = (r - q) (r + q) / (R^2 - q^2).
//
// Shape   2 unit coordinates, 2 coordinates.
// Units   angles in degrees, from the x axis towards the y axis.
// Strata  xi0 and xi1 are used directly, not as 1 - xi: small xi0 is near the centre, small xi1
//         near the first angle. Strata become sectors of rings.
// Cost    O(1) a point; about 9 ns forward, 30 ns inverse on one core.
// Promise density 1 / area. Points lie in the closed sector up to 16 epsilon (R + |cx| + |cy|). A
//         round trip returns the same point within 1e-14 of |c| + R; for c = 0 also the same xi
//         within 1e-14 R / (R - q) and 1e-14 / (beta - alpha) turns, except for xi1 at the centre
//         if q = 0. The same bits on every machine.

#include <cmath>

#include "core/error.hpp"
#include "warps/planar/placed_shape.hpp"
#include "warps/planar/ring_sector.hpp"

namespace stipple::warps::sector {
namespace {

constexpr Param<Numbers> angles{{.name = "angles",
                                 .fallback = "0,90",
                                 .unit = "degrees",
                                 .help = "First and last angle, from the x axis towards the y "
                                         "axis; the last is above the first, by at most 360"}};

constexpr Param<double> inner{.name = "inner",
                              .fallback = 0,
                              .low = 0,
                              .high = 1e150,
                              .help = "Inner radius, below the outer one; 0 includes the centre"};

constexpr auto radius = length_option("radius", 1, "Outer radius, above 0");

struct Span {
    double first;
    double degrees;
};

/// First angle and extent of the sector. @throws Error(usage)
Span span_of(const std::vector<double>& ends) {
    if (ends.size() != 2)
        fail(ErrorKind::usage, "--angles: expected 2 numbers, first,last; {} given", ends.size());
    for (const double angle : ends)
        if (!(std::abs(angle) <= 720))
            fail(ErrorKind::usage, "--angles: {} is outside [-720, 720]", angle);
    const double degrees = ends[1] - ends[0];
    if (!(degrees >= 1e-9 && degrees <= 360))
        fail(ErrorKind::usage, "--angles: from {} to {} are {} degrees; expected [1e-9, 360]",
             ends[0], ends[1], degrees);
    return {ends[0], degrees};
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const auto [first, angle] = span_of(want.options[angles]);
    const double width = want.options[radius] - want.options[inner];
    const auto shape = RingSector::between(want.options[inner], want.options[radius], angle / 360);
    const auto at = place(want.options[shape_center], want.options[radius], first, width, "sector");
    return placed(want.spec(), shape, at);
}

}  // namespace

Warp unit() {
    return {.name = "sector",
            .summary = "Sector of a disk or an annulus, uniform by area",
            .source = "the polar map r = sqrt(q^2 + xi1 (R^2 - q^2)) between two angles",
            .related = {"wedge", "pie"},
            .strata =
                "xi1 is the fraction of the area within the radius, xi2 the position between the "
                "two angles; both are used directly",
            .options = Schema(angles, inner, radius, shape_center),
            .stream_version = 2,
            .mapping = make};
}

}  // namespace stipple::warps::sector
