// SPDX-License-Identifier: MIT
//
// Unit square onto an annulus of radii q < R about a centre c:
//
//     r = sqrt(q^2 + xi0 (R^2 - q^2)),  theta = 2 pi xi1,    point = c + r (cos theta, sin theta)
//
// The inverse is xi0 = (r - q) (r + q) / (R^2 - q^2). With q = 0 it is the disk's polar method.
//
// Shape   2 unit coordinates, 2 coordinates.
// Strata  xi0 and xi1 are used directly, not as 1 - xi: small xi0 is near the inner rim, xi1 turns
//         from the x axis towards the y axis. Strata become sectors of rings.
// Cost    O(1) a point; about 9 ns forward, 15 ns inverse on one core.
// Promise density 1 / (pi (R^2 - q^2)). Points lie in the closed annulus up to 16 epsilon (R + |cx|
//         + |cy|). A round trip returns the same point within 1e-14 of |c| + R; for c = 0 also the
//         same xi within 1e-14 R / (R - q), except for xi1 at the centre of a disk. The same bits
//         on every machine.

#include "core/error.hpp"
#include "warps/planar/placed_shape.hpp"
#include "warps/planar/ring_sector.hpp"

namespace stipple::warps::annulus {
namespace {

constexpr Param<double> inner{.name = "inner",
                              .fallback = 0.5,
                              .low = 0,
                              .high = 1e150,
                              .help = "Inner radius, below the outer one; 0 gives the disk"};

constexpr auto radius = length_option("radius", 1, "Outer radius, above 0");

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const auto ring = RingSector::between(want.options[inner], want.options[radius], 1);
    const double width = want.options[radius] - want.options[inner];
    const auto at = place(want.options[shape_center], want.options[radius], 0, width, "ring");
    return placed(want.spec(), ring, at);
}

}  // namespace

Warp unit() {
    return {.name = "annulus",
            .summary = "Annulus between two radii, uniform by area",
            .source = "the polar map r = sqrt(q^2 + xi1 (R^2 - q^2))",
            .strata =
                "xi1 is the fraction of the area within the radius, xi2 the angle; both are used "
                "directly",
            .options = Schema(inner, radius, shape_center),
            .aliases = {"ring"},
            .mapping = make};
}

}  // namespace stipple::warps::annulus
