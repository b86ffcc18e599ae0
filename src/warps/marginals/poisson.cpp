// SPDX-License-Identifier: MIT
//
// Unit cube onto whole numbers from 0 on, each coordinate independently, by inversion:
//
//     the first k with p(0) + ... + p(k) > xi,    p(k) = mean^k exp(-mean) / k!
//
// Shape   any number of coordinates; each parameter is one number for all of them, or one for each.
// Strata  xi is used directly, and outcomes are in order: among n strata, the outcome k occurs
//         n p(k) times, rounded up or down.
// Cost    O(1) a coordinate on average, with a guide table; about 5 ns on one core. The table has
//         75 sqrt(mean) outcomes, at least 150 or so.
// Promise the bounds of outcomes' intervals are accurate to the last digit, measured from either
//         end. The inverse is the middle of the outcome's interval. The same bits on every machine.

#include "warps/marginal_mapping.hpp"

namespace stipple::warps::poisson {

Warp unit() {
    return {
        .name = "poisson",
        .summary = "Poisson distribution on each coordinate, by inversion",
        .source =
            "Inverse of the distribution function, summed from the most probable outcome outwards",
        .strata = "xi is used directly, and outcomes are in order",
        .traits = {.discrete = true},
        .options = Schema(parameter("poisson", "mean")),
        .mapping = family_mapping};
}

}  // namespace stipple::warps::poisson
