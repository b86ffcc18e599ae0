// SPDX-License-Identifier: MIT
//
// Default length scales of kernels.
//
// Source  the median heuristic: A. Gretton, K. M. Borgwardt, M. J. Rasch, B. Schoelkopf, A. Smola,
//         J. Mach. Learn. Res. 13 (2012) 723-773.
#pragma once

#include <cstdint>

#include "math/kernels/kernel.hpp"
#include "stipple/run.hpp"

namespace stipple::kernels {

struct MedianDistance {
    double value = 0;         ///< mean of the two middle distances if `pairs` is even
    std::uint64_t pairs = 0;  ///< number of pairs used
    bool of_all = true;       ///< false if the pairs are a random sample, always the same
};

/// Median distance between two of the union of `points` and `others`, from the first `dimension`
/// coordinates. Uses all pairs, or a sample of 2^22 if there are more.
MedianDistance median_distance(const Columns& points, const Columns& others, std::size_t dimension,
                               const RunContext& run = {});

/// Root mean square distance of two uniform points in the unit cube, sqrt(d / 6).
double uniform_distance(std::size_t dimension);

}  // namespace stipple::kernels
