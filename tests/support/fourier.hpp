// SPDX-License-Identifier: MIT
//
// Fourier sums of points that are all there, fast and plainly.
#pragma once

#include <span>

#include "math/fourier/nufft.hpp"

namespace stipple::testing {

inline FourierSums transform(const Nufft& nufft, std::span<const double> rows,
                             const RunContext& run, Planning planning = Planning::estimated) {
    FourierSummation sum(nufft);
    sum.add(rows, run);
    return sum.finish(planning, run);
}

inline FourierSums fourier_sums_directly(std::span<const double> rows, std::size_t dimension,
                                         std::size_t max_frequency, const RunContext& run,
                                         bool weighted = false) {
    DirectSummation sums(dimension, max_frequency, weighted);
    sums.add(rows, run);
    return sums.finish();
}

}  // namespace stipple::testing
