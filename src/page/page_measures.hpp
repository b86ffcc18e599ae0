// SPDX-License-Identifier: MIT
//
// What a report page measures of every set: by which analyzers, with which limits.
//
// Promise  results depend on the points and on the limits alone: searches that could take long end
//          after so many comparisons, not by the clock.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "page/page_content.hpp"

namespace stipple {

struct PageLimits {
    std::int64_t work = 1'000'000'000;  ///< comparisons of each search for a worst box
};

/// How the points of a set are named to `stipple analyze`: what stands behind the analyzer.
struct PageInput {
    std::string words;        ///< "points.csv --domain disk", "--generate halton -n 64"
    bool bounds = false;      ///< takes --bounds behind them
    std::string remark = {};  ///< " # the third of its results"; else empty
};

/// All measures, in the order of the page. What an analyzer does not take is left out with its
/// reason; so is what would compare more pairs of points than the limits allow.
/// @throws Error(cancelled), Error(io)
std::vector<PageMeasure> measure_set(const PointSet& points, const PageInput& input,
                                     const PageLimits& limits, const RunContext& run);

/// Names of all measures, as their keys begin.
std::vector<std::string> page_measures();

/// The analyzer of the measure of that name; nullptr if there is none.
const Analyzer* page_analyzer(std::string_view measure);

}  // namespace stipple
