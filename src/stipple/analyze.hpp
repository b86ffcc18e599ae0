// SPDX-License-Identifier: MIT
//
// Measuring point sets. An analyzer is named by a spec, NAME or NAME:OPTION=VALUE,...:
// "star-discrepancy", "l2-discrepancy:kind=centered". `stipple list analyzers` shows all of them,
// and `stipple analyze NAME --help` the keys of their results.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "stipple/generate.hpp"
#include "stipple/points.hpp"
#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Names of all analyzers, in alphabetical order.
std::vector<std::string> analyzer_names();

/// Returns the analyzer's results by name: numbers, flags, lists, curves and grids. They depend
/// only on the points and the options.
/// @throws Error(usage) for unknown names and options; Error(input) for points that the analyzer
/// does not accept; Error(limit), Error(cancelled)
Report analyze(std::string_view spec, const PointSet& points, const Settings& settings = {},
               const RunContext& run = {});

/// Formats names, values and units in aligned columns.
std::string to_text(const Report& report);

}  // namespace stipple
