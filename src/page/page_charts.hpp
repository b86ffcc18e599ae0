// SPDX-License-Identifier: MIT
//
// Charts of a report page: curves of one or more sets over the same axes, drawn by the program,
// with their numbers beside them for the page's script to show.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "page/page_content.hpp"

namespace stipple {

/// The curve of a set; `set` is its number in the page and picks its colour.
struct PageCurve {
    std::size_t set = 0;
    std::string name;
    std::vector<double> x;
    std::vector<double> y;
};

/// What chance allows.
struct PageBand {
    std::string name;
    std::vector<double> x;
    std::vector<double> low;
    std::vector<double> high;
};

struct PageChart {
    std::string title;
    std::string x_name;
    std::string y_name;
    std::string alt;
    std::vector<PageCurve> curves;
    std::vector<PageBand> bands = {};
    double guide = 1;  ///< a line across
    bool log_y = false;
};

/// A figure with the chart and its numbers; empty without curves.
std::string chart_figure(const PageChart& chart);

/// Radial power of the sets of these numbers, with the 95 % band of white noise where it is the
/// same for all; empty where no set has it.
std::string radial_power_figure(std::span<const PageSet> sets, std::span<const std::size_t> which);

/// Pair correlation, with the band of two standard deviations of independent points for one set.
std::string pair_correlation_figure(std::span<const PageSet> sets,
                                    std::span<const std::size_t> which);

}  // namespace stipple
