// SPDX-License-Identifier: MIT
//
// Unit cube onto an interval, each coordinate independently, by inversion:
//
//     x = low + sqrt(xi (high - low) (mode - low))             up to the mode,
//     x = high - sqrt((1 - xi) (high - low) (high - mode))     beyond it;
//     density 2 / (high - low) at the mode, decreasing linearly to 0 at both ends.
//
// Shape   any number of coordinates; each parameter is one number for all of them, or one for each.
// Strata  xi is used directly, not as 1 - xi: strata become equally probable intervals, in order.
// Cost    O(1) a coordinate; about 2 ns on one core.
// Promise x in [low, high], at the ends only for xi = 0 and 1. The same bits on every machine.

#include "warps/marginal_mapping.hpp"

namespace stipple::warps::triangular {

Warp unit() {
    return {.name = "triangular",
            .summary = "Triangular distribution with any mode, on each coordinate",
            .source = "Inverse of the distribution function of two parabolas",
            .strata = "xi is the probability below x, used directly: xi = 0 is the lower end",
            .options = Schema(parameter("triangular", "low"), parameter("triangular", "mode"),
                              parameter("triangular", "high")),
            .stream_version = 2,
            .mapping = family_mapping};
}

}  // namespace stipple::warps::triangular
