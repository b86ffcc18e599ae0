// SPDX-License-Identifier: MIT
//
// Unit cube onto the half-line x >= 0, each coordinate by itself, by inversion:
//
//     P(shape, x / scale) = xi,    density of y = x / scale: y^(shape-1) exp(-y) / Gamma(shape)
//
// Shape   any number of coordinates; one number for all coordinates, or one for each, for each
//         parameter.
// Strata  xi is taken as it is, not as 1 - xi: strata become intervals of equal probability in the
//         same order. The last is endless; xi = 1 is taken as 1 - 2^-55.
// Cost    O(1) a coordinate; 0.6 to 1 us, 8 us for a shape of 1e6 on one core.
// Promise quantiles within 1e-13 of themselves in both tails. The same bits on every machine for
//         the same release of Boost, whose functions are computed through math/functions.

#include "warps/marginal_mapping.hpp"

namespace stipple::warps::gamma {

Warp unit() {
    return {.name = "gamma",
            .summary = "Gamma distribution on each coordinate, by inversion",
            .source = "Inverse of the regularised incomplete gamma function",
            .related = {"erlang", "chi-squared"},
            .strata = "xi is the probability below x, as it is: small xi is near 0",
            .options = Schema(parameter("gamma", "shape"), parameter("gamma", "scale")),
            .stream_version = 2,
            .mapping = family_mapping};
}

}  // namespace stipple::warps::gamma
