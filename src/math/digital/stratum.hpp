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

/// Strata along one coordinate: the first, and how far the next is from it.
struct Strata {
    std::uint64_t low;
    std::uint64_t width;
    std::uint64_t step;   ///< from one stratum's low to the next one's: 0 or width
    std::uint64_t parts;  ///< low + width <= parts <= 2^53
};

/// Moves x[0], x[stride], ... from [0, 1) into strata: the j-th number into the j-th stratum.
void place_in_strata(const Strata& strata, std::size_t count, double* x, std::size_t stride);

/// The same for points of two coordinates, side by side, and faster.
void place_pairs_in_strata(const Strata& first, const Strata& second, std::size_t count,
                           double* rows);

/// Puts the middles of the strata there.
void place_in_middles(const Strata& strata, std::size_t count, double* x, std::size_t stride);

/// Moves x[0], x[stride], ... from [0, 1) into strata one part wide: the j-th into the one that
/// begins at low[j] / parts, low[j] a whole number.
void place_in_strata(std::span<const double> low, std::uint64_t parts, double* x,
                     std::size_t stride);

/// Puts the middles of those strata there.
void place_in_middles(std::span<const double> low, std::uint64_t parts, double* x,
                      std::size_t stride);

}  // namespace stipple
