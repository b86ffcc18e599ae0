// SPDX-License-Identifier: MIT
//
// What a report page measures of every set: by which analyzers, with how much work.
//
// Promise  results depend on the points and on the work alone: searches that could take long end
//          after so many comparisons, not by the clock.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "page/content.hpp"
#include "stipple/run.hpp"

namespace stipple::page {

/// Comparisons of each search for a worst box, where nobody says how many.
inline constexpr std::int64_t usual_work = 1'000'000'000;

/// How the points of a set are named to `stipple analyze`: what stands behind the analyzer.
struct Input {
    /// "points.csv --domain disk", "--generate halton -n 64"; empty: no command has them
    std::string words;
    bool bounds = false;      ///< takes --bounds behind them
    std::string remark = {};  ///< " # the third of its results"; else empty
};

/// All measures, in the order of the page. What an analyzer does not take is left out with its
/// reason; so is what would compare more pairs of points than `work` allows.
/// @throws Error(cancelled), Error(io)
std::vector<Measure> measure_set(const PointSet& points, const Input& input, std::int64_t work,
                                 const RunContext& run);

/// The set with its size, all measures and, for a page, its pictures; its grids are in these, and
/// left out. `number` picks its colour.
/// @throws Error(cancelled), Error(io)
Set finished_set(Set set, const PointSet& points, const Input& input, std::int64_t work,
                 std::size_t number, bool with_pictures, const RunContext& run);

/// Names of all measures, as their keys begin.
std::vector<std::string> measure_names();

/// The analyzer of the measure of that name; nullptr if there is none.
const Analyzer* analyzer_of(std::string_view measure);

}  // namespace stipple::page
