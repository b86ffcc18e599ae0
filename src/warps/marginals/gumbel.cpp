// SPDX-License-Identifier: MIT
//
// Unit cube onto the whole line, each coordinate independently, by inversion:
//
//     x = location - scale log(-log xi),    P(X <= x) = exp(-exp(-(x - location) / scale)),
//     the limit distribution of the maximum of many independent numbers
//
// Shape   any number of coordinates; each parameter is one number for all of them, or one for each.
// Strata  xi is used directly, not as 1 - xi: strata become intervals of equal probability, in
//         order. The first and the last are unbounded; 0 is replaced by 2^-54 and 1 by 1 - 2^-55.
// Cost    O(1) a coordinate; about 15 ns on one core.
// Promise x within 1e-13 of max(|x|, |location|). The same bits on every machine.

#include "warps/marginal_mapping.hpp"

namespace stipple::warps::gumbel {

Warp unit() {
    return {.name = "gumbel",
            .summary = "Gumbel distribution of extremes on each coordinate, by inversion",
            .source = "Inverse of the distribution function exp(-exp(-x))",
            .related = {"extreme-value"},
            .strata = "xi is the probability below x, used directly: small xi is far below",
            .options = Schema(parameter("gumbel", "location"), parameter("gumbel", "scale")),
            .mapping = family_mapping};
}

}  // namespace stipple::warps::gumbel
