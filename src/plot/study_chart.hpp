// SPDX-License-Identifier: MIT
//
// Charts of studies: a panel for each result with a curve for each generator over the number of
// points. Curves show means of the sets with their intervals as bands, or root mean squares of
// results that are errors. Legends give slopes with their standard errors.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "plot/chart.hpp"
#include "study/study_summary.hpp"

namespace stipple::plot {

struct StudyChart {
    Chart chart;
    std::vector<std::string> left_out;  ///< keys of results beyond the limit of four panels
};

/// Draws a study's means. @param key a result, such as centered.value, or a part of its name, such
/// as centered; empty: results called "value", and all results of measures without a "value"
/// @throws Error(usage) for an unknown key; Error(input) if there are no numbers
StudyChart study_chart(std::span<const MeanRow> means, const std::string& key = {});

}  // namespace stipple::plot
