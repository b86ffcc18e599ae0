// SPDX-License-Identifier: MIT
//
// What an analyzer is: its record, and the function from points to a report.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/options.hpp"
#include "core/point_set.hpp"
#include "core/report.hpp"
#include "core/run_context.hpp"

namespace stipple {

struct AnalyzerTraits {
    std::size_t min_dimension = 1;
    std::size_t max_dimension = 1'000'000;
    bool unit_cube = true;  ///< takes points of the closed unit cube only
    bool boxed = false;     ///< takes points of the unit cube or a box only
};

/// One key of the results, for help and `list`.
struct ResultKey {
    std::string key;
    std::string help;
};

struct Analyzer {
    std::string name;
    std::string summary;
    std::string source;
    AnalyzerTraits traits;
    Schema options;
    std::vector<ResultKey> results;

    /// Measures one set. Dimension and domain were checked against the traits before.
    std::function<Report(const PointSet&, const Values&, const RunContext&)> analyze;

    /// Called with the mean of `sets` reports (numbers, curves and grids averaged): works out anew
    /// what a mean of results is not, such as an anisotropy. May be empty.
    std::function<void(Report& mean, std::size_t sets, const Values&)> refine = {};
};

/// @throws Error(input) when the points' dimension is not one that the analyzer takes.
void check_dimension(const Analyzer& analyzer, std::size_t dimension);

namespace analyzers {
/// All analyzers, in alphabetical order.
const std::vector<Analyzer>& all();
}  // namespace analyzers

}  // namespace stipple
