// SPDX-License-Identifier: MIT
//
// Statistics of a power spectrum, or of any grid with P(-f) = P(f), over the rings k - 1/2 <= |f| <
// k + 1/2, k = 1..F, always without frequency 0. The formulas are at the top of
// spectrum/periodogram.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

/// Means, variances and numbers of cells of rings; index 0 is ring 1.
struct Rings {
    std::vector<double> power;
    std::vector<double> variance;
    std::vector<std::int64_t> cells;
};

/// @param power at the frequencies -F..F of each axis, one row for each (f_2, f_1)
Rings rings_of(const Grid& power, const RunContext& run);

/// Converts a ratio of powers, which is above 0, to decibels.
double decibels(double ratio);

/// Anisotropy of a ring in dB, at least -100; -100 also if the mean is at most `least`.
double anisotropy_db(double variance, double mean, double least = 0);

/// Effective Nyquist frequency: half the radius of the largest disk of frequencies with a mean
/// power of at most 0.1. @param rings rings_of(power)
double effective_nyquist(const Grid& power, const Rings& rings, const RunContext& run);

/// Oscillation; complete if a ring's power reaches 0.98 and all rings of its definition are known.
struct Oscillation {
    double value;
    bool complete;
};
Oscillation oscillation(const Rings& rings, double regular_nyquist);

double total_variation(const Rings& rings);

/// Slope of log power against log frequency over the lowest rings with a power above `least`;
/// nullopt for fewer than 3 of these rings.
std::optional<double> low_frequency_exponent(const Rings& rings, double regular_nyquist,
                                             double least);

}  // namespace stipple::analyzers
