// SPDX-License-Identifier: MIT
//
// Unit cube onto an interval, each coordinate independently, by inversion:
//
//     x = low + y (high - low),    I_y(a, b) = xi,    density of y: y^(a-1) (1-y)^(b-1) / B(a, b)
//
// Shape   any number of coordinates; each parameter is one number for all of them, or one for each.
// Strata  xi is used directly, not as 1 - xi: strata become equally probable intervals, in order.
// Cost    O(1) a coordinate; about 1.5 us on one core.
// Promise x in [low, high], at the ends only for xi = 0 and 1, and never where the density is
//         infinite; quantiles within a relative 1e-13 in both tails. The same bits on every
//         machine.
// Beware  if b is below 1, a part of the mass is closer to high than the spacing of doubles: 1e-8
//         of it for b = 0.5, and more for smaller b. If that matters, use high = 0 and low below
//         it.

#include "warps/marginal_mapping.hpp"

namespace stipple::warps::beta {

Warp unit() {
    return {.name = "beta",
            .summary = "Beta distribution on an interval, on each coordinate, by inversion",
            .source = "Inverse of the regularised incomplete beta function",
            .related = {"arcsine"},
            .strata = "xi is the probability below x, used directly: xi = 0 is the lower end",
            .options = Schema(parameter("beta", "a"), parameter("beta", "b"),
                              parameter("beta", "low"), parameter("beta", "high")),
            .stream_version = 2,
            .mapping = family_mapping};
}

}  // namespace stipple::warps::beta
