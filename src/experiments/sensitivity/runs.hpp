// SPDX-License-Identifier: MIT
//
// Reads the runs of a model from tables: outputs with a separate file of inputs, or both in one
// table.
#pragma once

#include <string>
#include <vector>

#include "experiments/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

/// Requested columns, by names or numbers from 1, separated by commas. Empty: chosen automatically.
struct ColumnsAsked {
    std::string design = {};    ///< file of the inputs; empty: the table contains them
    std::string inputs = {};    ///< columns of the design or, without a design, of the table
    std::string response = {};  ///< output columns of the table
};

struct Runs {
    Inputs inputs;
    std::vector<Response> responses;
};

/// Finds the inputs and outputs. Inputs are, by name, the coordinates of the domain in the
/// provenance of the table or of the design. If neither has a domain, they are all columns of the
/// design, or all of the table except the last. All other columns of the table are outputs, except
/// copies of inputs, which have both the name and the numbers of one. Notes report assumptions and
/// unused columns.
/// @throws Error(input) for different numbers of rows, for a column with the name of an input and
///         other numbers, and for words; Error(usage) for columns that do not exist
Runs runs_of(const PointSet& table, const ColumnsAsked& asked, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
