// SPDX-License-Identifier: MIT
//
// Charts of analyzers' reports: one curve per measurement, with a common legend.
//
//     the reports have curves           the curves, such as radial power with the band of white
//                                       noise, or numbers over counts on logarithmic axes
//     results have one or two names     bars with intervals, such as sensitivity indices of inputs
//     as keys                           and of pairs of inputs
//     several reports without curves    one result against the number of points. Files whose names
//                                       differ only in digits form one curve; sets of equal size
//                                       are averaged. If all sets have one size: a histogram
//
// Bands around a curve are standard errors of a mean, or lower and upper bounds.
//
// Source  band of white noise: E. B. Wilson, M. M. Hilferty, PNAS 17 (1931) 684-688,
//         doi:10.1073/pnas.17.12.684; half of a ring's frequencies are independent (P(-f) = P(f)).
#pragma once

#include <span>
#include <string>

#include "plot/chart.hpp"
#include "report/document.hpp"

namespace stipple::plot {

/// Draws the measurements of one analyzer. @param key result to draw; empty: the default for the
/// analyzer
/// @throws Error(input) for reports of different analyzers, or if nothing can be drawn;
/// Error(usage) for an unknown key, naming the possible ones
Chart chart_of(std::span<const Measurement> measurements, const std::string& key = {},
               bool log_x = false);

/// Value of an analyzer's option; empty if the analyzer has no such option.
std::string option_of(const std::vector<std::pair<std::string, std::string>>& options,
                      std::string_view name);

/// 2.5 % and 97.5 % quantiles of a ring's mean power for white noise.
/// @param cells frequencies in the ring
/// @param sets number of sets averaged
std::pair<double, double> white_noise_band(double cells, double sets);

}  // namespace stipple::plot
