// SPDX-License-Identifier: MIT
//
// Charts of a report page: those that `stipple plot` draws of a measure's curves, with their
// numbers beside them for the page's script to show.
#pragma once

#include <span>
#include <string>

#include "page/page_content.hpp"

namespace stipple {

/// Radial power of the sets of these numbers, with the 95 % band of white noise where it is the
/// same for all; empty where no set has it.
std::string radial_power_figure(std::span<const PageSet> sets, std::span<const std::size_t> which);

/// Pair correlation, with the band of two standard deviations of independent points for one set.
std::string pair_correlation_figure(std::span<const PageSet> sets,
                                    std::span<const std::size_t> which);

}  // namespace stipple
