// SPDX-License-Identifier: MIT
//
// Unit cube onto the half-line x >= 0, each coordinate independently, by inversion:
//
//     P(shape, x / scale) = xi,    density of y = x / scale: y^(shape-1) exp(-y) / Gamma(shape)
//
// Shape   any number of coordinates; each parameter is one number for all of them, or one for each.
// Strata  xi is used directly, not as 1 - xi: strata become intervals of equal probability in the
//         same order. The last is unbounded; xi = 1 is replaced by 1 - 2^-55.
// Cost    O(1) a coordinate; 0.6 to 1 us, 8 us for a shape of 1e6 on one core.
// Promise quantiles within a relative 1e-13 in both tails. The same bits on every machine for the
//         same release of Boost, whose functions are computed through math/functions.

#include "warps/marginal_mapping.hpp"

namespace stipple::warps::gamma {

Warp unit() {
    return {.name = "gamma",
            .summary = "Gamma distribution on each coordinate, by inversion",
            .source = "Inverse of the regularised incomplete gamma function",
            .related = {"erlang", "chi-squared"},
            .strata = "xi is the probability below x, used directly: small xi is near 0",
            .options = Schema(parameter("gamma", "shape"), parameter("gamma", "scale")),
            .stream_version = 2,
            .mapping = family_mapping};
}

}  // namespace stipple::warps::gamma
