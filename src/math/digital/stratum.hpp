// SPDX-License-Identifier: MIT
//
// Random points in strata: parts of [0, 1) between whole multiples of 1 / parts.
//
//     x = (low + width u) / parts,    u in [0, 1),    in    [low / parts, (low + width) / parts).
//
// Promise  the point is in its half-open stratum by exact arithmetic, and floor(x * parts), as a
//          program computes it, says so too, wherever the stratum holds a double for which it can.
//          A point that rounding would bring to an edge goes to the middle of its stratum; the
//          chance of that is about low * 2^-53.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace stipple {

/// Strata along one coordinate, all of one width.
struct Strata {
    std::span<const double> low;  ///< whole numbers, where they begin
    std::uint64_t width = 1;
    std::uint64_t parts = 1;  ///< low + width <= parts <= 2^53
};

/// Moves x[0], x[stride], ... from [0, 1) into strata: the j-th number into the j-th stratum.
void place_in_strata(Strata strata, double* x, std::size_t stride);

/// Puts the middles of the strata there.
void place_in_middles(const Strata& strata, double* x, std::size_t stride);

}  // namespace stipple
