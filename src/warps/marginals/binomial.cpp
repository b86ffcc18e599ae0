// SPDX-License-Identifier: MIT
//
// Unit cube onto whole numbers from 0 to n, each coordinate independently, by inversion:
//
//     the first k with p(0) + ... + p(k) > xi,    p(k) = n! / (k! (n-k)!) p^k (1-p)^(n-k)
//
// Shape   any number of coordinates; each parameter is one number for all of them, or one for each.
// Strata  xi is used directly, and outcomes are in order: among m strata, the outcome k occurs
//         m p(k) times, rounded up or down.
// Cost    O(1) a coordinate on average, with a guide table; about 5 ns on one core. The table has
//         at most 75 sqrt(n p (1 - p)) outcomes, or n + 1.
// Promise the bounds of outcomes' intervals are accurate to the last digit, measured from either
//         end. The inverse is the middle of the outcome's interval. The same bits on every machine.

#include "warps/marginal_mapping.hpp"

namespace stipple::warps::binomial {

Warp unit() {
    return {
        .name = "binomial",
        .summary = "Binomial distribution on each coordinate, by inversion",
        .source =
            "Inverse of the distribution function, summed from the most probable outcome outwards",
        .related = {"bernoulli"},
        .strata = "xi is used directly, and outcomes are in order",
        .traits = {.discrete = true},
        .options = Schema(parameter("binomial", "trials"), parameter("binomial", "probability")),
        .mapping = family_mapping};
}

}  // namespace stipple::warps::binomial
