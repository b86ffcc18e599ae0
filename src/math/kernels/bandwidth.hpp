// SPDX-License-Identifier: MIT
//
// Length scales for points of which nobody said one.
//
// Source  the median heuristic: A. Gretton, K. M. Borgwardt, M. J. Rasch, B. Schoelkopf, A. Smola,
//         J. Mach. Learn. Res. 13 (2012) 723-773.
#pragma once

#include <cstdint>

#include "math/kernels/kernel.hpp"
#include "stipple/run.hpp"

namespace stipple::kernels {

struct MedianDistance {
    double value = 0;         ///< of an even number of pairs the mean of both in the middle
    std::uint64_t pairs = 0;  ///< it is of so many
    bool of_all = true;       ///< pairs; else of pairs drawn at random, always the same
};

/// The median distance of two of the points and the others, put together, by their first
/// coordinates: of all pairs, or of 2^22 where there are more.
MedianDistance median_distance(const Columns& points, const Columns& others, std::size_t dimension,
                               const RunContext& run = {});

/// The root mean square distance of two uniform points of the unit cube, sqrt(d / 6).
double uniform_distance(std::size_t dimension);

}  // namespace stipple::kernels
