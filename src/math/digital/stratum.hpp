// SPDX-License-Identifier: MIT
//
// Random points in strata: parts of [0, 1) between integer multiples of 1 / parts.
//
//     x = (low + width u) / parts,    u in [0, 1),    in    [low / parts, (low + width) / parts).
//
// Promise  the point is in its half-open stratum in exact arithmetic. Computed in doubles, floor(x
//          * parts) is in [low, low + width), too, if this holds for any double x of the stratum. A
//          point that rounding would move to an edge is moved to the middle of its stratum; the
//          probability of that is about low * 2^-53.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace stipple {

/// Strata along one coordinate, all of the same width.
struct Strata {
    std::span<const double> low;  ///< lower ends in units of 1 / parts
    std::uint64_t width = 1;
    std::uint64_t parts = 1;  ///< low + width <= parts <= 2^53
};

/// Index of the stratum of x, of `parts` <= 2^53 equal ones. A coordinate equal to the rounded lower
/// edge of a stratum counts as in it, and 1 as in the last one.
inline double stratum_of(double x, double parts) {
    double index = std::floor(x * parts);  // off by at most 1
    if (index / parts > x)
        --index;
    else if ((index + 1) / parts <= x)
        ++index;
    return std::min(index, parts - 1);
}

/// Moves x[j * stride] from [0, 1) into stratum j, for every j.
void place_in_strata(Strata strata, double* x, std::size_t stride);

/// Sets x[j * stride] to the middle of stratum j, for every j.
void place_in_middles(const Strata& strata, double* x, std::size_t stride);

}  // namespace stipple
