// SPDX-License-Identifier: MIT
//
// Unit cube onto the half-line x >= 0, each coordinate by itself, by inversion:
//
//     x = scale (-log(1 - xi))^(1 / shape),    P(X > x) = exp(-(x / scale)^shape)
//
// Shape   any number of coordinates; one number for all coordinates, or one for each, for each
//         parameter.
// Strata  xi is taken as it is, not as 1 - xi: strata become intervals of equal probability in the
//         same order. The last is endless; xi = 1 is taken as 1 - 2^-55.
// Cost    O(1) a coordinate; about 90 ns on one core.
// Promise x within 1e-13 of itself. The same bits on every machine.

#include "warps/marginal_mapping.hpp"

namespace stipple::warps::weibull {

Warp unit() {
    return {.name = "weibull",
            .summary = "Weibull distribution on each coordinate, by inversion",
            .source = "Inverse of the distribution function 1 - exp(-(x / scale)^shape)",
            .related = {"rayleigh"},
            .strata = "xi is the probability below x, as it is: small xi is near 0",
            .options = Schema(parameter("weibull", "shape"), parameter("weibull", "scale")),
            .mapping = family_mapping};
}

}  // namespace stipple::warps::weibull
