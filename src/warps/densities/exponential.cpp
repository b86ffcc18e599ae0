// SPDX-License-Identifier: MIT
//
// Unit cube onto the half-line x >= 0, each coordinate independently, by inversion of the
// exponential distribution with rate lambda:
//
//     x = -log(1 - xi) / lambda,    density lambda exp(-lambda x),    mean 1 / lambda.
//
// Shape   any number of coordinates; one rate for all, or one for each.
// Strata  xi is used directly, not as 1 - xi: xi = 0 is x = 0, and strata become intervals of equal
//         probability in the same order. The last one is unbounded; xi = 1 is replaced by 1 -
//         2^-55, so that x is at most 38.13 / lambda.
// Cost    O(1) a coordinate; about 4 ns on one core.
// Promise a round trip returns the same xi within 1e-14, and near 0 within a relative 1e-14.
//         Forward map, inverse and density give the same bits on every machine.

#include "warps/marginal_mapping.hpp"

namespace stipple::warps::exponential {

Warp unit() {
    return {.name = "exponential",
            .summary = "Exponential distribution on each coordinate, by inversion",
            .source = "Inverse of the distribution function 1 - exp(-rate x)",
            .strata = "xi is the probability below x, used directly: small xi is near 0",
            .options = Schema(parameter("exponential", "rate")),
            .mapping = family_mapping};
}

}  // namespace stipple::warps::exponential
