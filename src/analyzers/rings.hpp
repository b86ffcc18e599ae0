// SPDX-License-Identifier: MIT
//
// What follows from a power spectrum, or any grid with P(-f) = P(f), by its rings k - 1/2 <= |f| <
// k + 1/2, k = 1..F, frequency 0 being left out everywhere; the formulas are at the top of
// periodogram.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

/// Means and variances over rings; index 0 is ring 1.
struct Rings {
    std::vector<double> power;
    std::vector<double> variance;
    std::vector<std::int64_t> cells;
};

/// @param power at the frequencies -F..F of each axis, one row for each (f_2, f_1).
Rings rings_of(const Grid& power, const RunContext& run);

/// A ratio above 0 of powers.
double decibels(double ratio);

/// Of a ring in dB, no less than -100; that, too, where its mean is no more than `least`.
double anisotropy_db(double variance, double mean, double least = 0);

/// Half the radius up to which the mean power of all frequencies is 0.1 at most, the largest one.
/// @param rings those of the power.
double effective_nyquist(const Grid& power, const Rings& rings, const RunContext& run);

/// Complete, if its rings begin where the power first reaches 0.98 and none are cut off by F.
struct Oscillation {
    double value;
    bool complete;
};
Oscillation oscillation(const Rings& rings, double regular_nyquist);

double total_variation(const Rings& rings);

/// Nothing where fewer than 3 of the lowest rings have a power above `least`.
std::optional<double> low_frequency_exponent(const Rings& rings, double regular_nyquist,
                                             double least);

}  // namespace stipple::analyzers
