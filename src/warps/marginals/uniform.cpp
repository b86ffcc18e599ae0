// SPDX-License-Identifier: MIT
//
// Unit cube onto a box, each coordinate independently, by inversion:
//
//     x = low + xi (high - low),    density 1 / (high - low)
//
// Shape   any number of coordinates; each parameter is one number for all of them, or one for each.
// Strata  xi is used directly, not as 1 - xi: strata become equally probable intervals, in order.
// Cost    O(1) a coordinate; about 1 ns on one core.
// Promise x in [low, high], and high only by rounding. The same bits on every machine.

#include "warps/marginal_mapping.hpp"

namespace stipple::warps::uniform {

Warp unit() {
    return {.name = "uniform",
            .summary = "Uniform distribution between two ends, on each coordinate",
            .source = "Inverse of the distribution function, a linear function",
            .related = {"box", "interval", "bounds"},
            .strata = "xi is the probability below x, used directly: xi = 0 is the lower end",
            .options = Schema(parameter("uniform", "low"), parameter("uniform", "high")),
            .mapping = family_mapping};
}

}  // namespace stipple::warps::uniform
