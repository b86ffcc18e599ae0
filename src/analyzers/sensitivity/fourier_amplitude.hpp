// SPDX-License-Identifier: MIT
//
// Extended FAST: the design has a curve for each input i. On this curve the input oscillates with a
// high frequency w = floor((N - 1) / (2 M)), and all others with frequencies up to w / (2 M). With
// the power P(f) = |1/N sum_s y_s exp(-2 pi i f s / N)|^2 of the output along the curve,
//
//     S_i = sum_{p = 1..M} P(p w) / V,    ST_i = 1 - sum_{f = 1..w/2} P(f) / V,
//
// where V is the sum of P(f) over all f in [1, (N - 1) / 2].
//
// Shape   n = N k rows, curve after curve, N > 4 M^2.
// Cost    O(n N / (4 M)).
// Beware  errors come from aliasing and from overlapping harmonics, and no interval shows them. ST
//         is too small if harmonics above the M-th matter, and too large in many dimensions.
// Source  A. Saltelli, S. Tarantola, K. P.-S. Chan, Technometrics 41 (1999) 39-56,
//         doi:10.1080/00401706.1999.10485594.
#pragma once

#include "analyzers/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

/// Checks that on each curve nearly all the variance of its own input's ranks is at harmonics of w,
/// and hardly any of the other inputs' ranks.
/// @param harmonics M; if empty, that of the first curve
Layout find_curves(const PointSet& design, std::optional<std::size_t> harmonics,
                   const RunContext& run);

/// @throws Error(input) for failed runs, because a curve with gaps has no spectrum
Effects fourier_amplitudes(const Layout& layout, const Inputs& inputs, const Response& response,
                           const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
