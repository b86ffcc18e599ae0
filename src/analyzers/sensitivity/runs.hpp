// SPDX-License-Identifier: MIT
//
// Runs of a model in tables: outputs with a separate file of inputs, or both in one table.
#pragma once

#include <string>
#include <vector>

#include "analyzers/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

/// Requested columns: names or numbers from 1, separated by commas; empty: automatic.
struct ColumnsAsked {
    std::string design = {};    ///< file of the inputs; empty: they are columns of the table
    std::string inputs = {};    ///< columns of the design, or of the table
    std::string response = {};  ///< columns of the table
};

struct Runs {
    Inputs inputs;
    std::vector<Response> responses;
};

/// The inputs are the coordinates of the domain in the table's provenance, or the design's, by
/// name; where neither knows any, all columns of the design, or all of the table but the last one.
/// All other columns of the table are outputs, except copies of inputs: with the name and the
/// numbers of one. Notes tell what was taken without being known, and which columns are not looked
/// at. @throws Error(input) for another number of rows, for a column with the name of an input and
/// other numbers, for words; Error(usage) for columns that are not there
Runs runs_of(const PointSet& table, const ColumnsAsked& asked, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
