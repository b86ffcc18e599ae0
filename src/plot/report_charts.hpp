// SPDX-License-Identifier: MIT
//
// Charts of what analyzers report: one curve for each measurement, in one legend.
//
//     periodogram        radial power, with what white noise has, and anisotropy
//     pair-correlation   density over distance
//     sensitivity        bars of the indices of inputs and of pairs, with their intervals
//     others             each list over the rising one before it (prefixes: logarithmic), or, for
//                        several reports without lists, one number over the number of points: a
//                        curve for the files of one name but for its digits, means where several
//                        sets have as many points; or, all of one size, its histogram
//
// Bands about a curve are standard errors of a mean, or a lower and an upper bound.
//
// Source  band of white noise: E. B. Wilson, M. M. Hilferty, PNAS 17 (1931) 684-688,
//         doi:10.1073/pnas.17.12.684: half of a ring's frequencies are free (P(-f) = P(f)).
#pragma once

#include <span>
#include <string>

#include "plot/chart.hpp"
#include "report/document.hpp"

namespace stipple::plot {

/// key: of the results, what to draw where there is a choice; empty: what is drawn as a rule.
/// @throws Error(input) for reports of different analyzers, or with nothing to draw: says what
/// there is; Error(usage) for a key that is none.
Chart chart_of(std::span<const Measurement> measurements, const std::string& key = {});

/// 2.5 and 97.5 % points of the mean power of a ring of so many frequencies, over so many sets of
/// white noise.
std::pair<double, double> white_noise_band(double cells, double sets);

}  // namespace stipple::plot
