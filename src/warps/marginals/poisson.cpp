// SPDX-License-Identifier: MIT
//
// Unit cube onto whole numbers from 0 on, each coordinate by itself, by inversion:
//
//     the first k with p(0) + ... + p(k) > xi,    p(k) = mean^k exp(-mean) / k!
//
// Shape   any number of coordinates; one number for all coordinates, or one for each, for each
//         parameter.
// Strata  xi is taken as it is: outcomes come in order, so that n strata give each outcome n p
//         times, rounded up or down.
// Cost    O(1) a coordinate expected, by a guide table; about 5 ns on one core. The table has 75
//         sqrt(mean) outcomes, at least 150 or so.
// Promise the ends of outcomes' intervals are right to their last digits, from both ends. The way
//         back is the middle of the interval. The same bits on every machine.

#include "warps/marginal_mapping.hpp"

namespace stipple::warps::poisson {

Warp unit() {
    return {.name = "poisson",
            .summary = "Poisson distribution on each coordinate, by inversion",
            .source = "Inverse of the distribution function, summed from the likeliest outcome on",
            .strata = "outcomes lie side by side in their order, xi as it is",
            .traits = {.discrete = true},
            .options = Schema(parameter("poisson", "mean")),
            .mapping = family_mapping};
}

}  // namespace stipple::warps::poisson
