// SPDX-License-Identifier: MIT
//
// Unit cube onto whole numbers of a range, each coordinate by itself, by inversion:
//
//     x = low + floor(xi (high - low + 1))
//
// Shape   any number of coordinates; one number for all coordinates, or one for each, for each
//         parameter.
// Strata  xi is taken as it is: outcomes come in order, so that n strata give each outcome n p
//         times, rounded up or down.
// Cost    O(1) a coordinate; about 3 ns on one core.
// Promise each number comes for the same share of xi. The way back is the middle of its interval.
//         The same bits on every machine.

#include "warps/marginal_mapping.hpp"

namespace stipple::warps::integers {

Warp unit() {
    return {.name = "integers",
            .summary = "Whole numbers of a range, each as likely, on each coordinate",
            .source = "Inverse of the distribution function, a stair",
            .related = {"uniform-integers", "die"},
            .strata = "outcomes lie side by side in their order, xi as it is",
            .traits = {.discrete = true},
            .options = Schema(parameter("integers", "low"), parameter("integers", "high")),
            .mapping = family_mapping};
}

}  // namespace stipple::warps::integers
