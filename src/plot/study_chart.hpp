// SPDX-License-Identifier: MIT
//
// Charts of studies: a panel for each result, in it a curve for each generator over the number of
// points: the mean of the sets, with its interval as a band, or the root mean square of results that
// are errors. Legends have the slopes of straight lines fitted to the logarithms of both by least
// squares, where there are three counts or more and all values are above 0.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "plot/chart.hpp"
#include "study/study_summary.hpp"

namespace stipple::plot {

struct StudyChart {
    Chart chart;
    std::vector<std::string> left_out;  ///< results for which there is no room
};

/// key: a result's name, or a part of it between dots; empty: those called "value", or else all.
/// @throws Error(usage) for a key that there is not; Error(input) where there are no numbers
StudyChart study_chart(std::span<const MeanRow> means, const std::string& key = {});

}  // namespace stipple::plot
