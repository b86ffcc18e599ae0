// SPDX-License-Identifier: MIT
//
// Measures of a report page: the analyzers that are applied to every set, and their work limits.
//
// Promise  results depend only on the points and the work limit: long searches end after a number
//          of comparisons, not by time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "page/content.hpp"
#include "stipple/run.hpp"

namespace stipple::page {

/// Default limit of comparisons in each search for a worst box.
inline constexpr std::int64_t usual_work = 1'000'000'000;

/// Arguments by which `stipple analyze` reads the points of a set.
struct Input {
    /// Points as arguments: "points.csv --domain disk", "--generate halton -n 64"; empty if no
    /// command can read them.
    std::string words;
    bool bounds = false;  ///< whether --bounds can be appended
    /// Appended to commands, such as "  # result 2 of the array"; usually empty.
    std::string remark = {};
};

/// Results of all measures, in the order of the page. Measures that do not accept the points, or
/// would compare more pairs than `work` allows, have a reason instead of results.
/// @throws Error(cancelled), Error(io)
std::vector<Measure> measure_set(const PointSet& points, const Input& input, std::int64_t work,
                                 const RunContext& run);

/// Completes a set with its size, all measures and, if requested, pictures. Grids are removed from
/// the results, since the pictures show them. `number` selects the colour.
/// @throws Error(cancelled), Error(io)
Set finished_set(Set set, const PointSet& points, const Input& input, std::int64_t work,
                 std::size_t number, bool with_pictures, const RunContext& run);

}  // namespace stipple::page
