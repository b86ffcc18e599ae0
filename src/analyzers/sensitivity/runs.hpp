// SPDX-License-Identifier: MIT
//
// The runs of a model as tables hold them: outputs beside a file of inputs, or both in one table.
#pragma once

#include <string>
#include <vector>

#include "analyzers/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

/// Which columns are what, as they are asked for: names or numbers from 1, separated by commas;
/// empty: automatic.
struct ColumnsAsked {
    std::string design = {};    ///< file of the inputs; empty: they are columns of the table
    std::string inputs = {};    ///< of the design, or of the table
    std::string response = {};  ///< of the table
};

struct Runs {
    Inputs inputs;
    std::vector<Response> responses;
};

/// With a design, its columns are the inputs, and the outputs those of the table that neither have
/// the name of an input nor repeat its numbers; without, the last column of the table is the output
/// and the others are the inputs.
/// @throws Error(input) for another number of rows; Error(usage) for columns that are not there
Runs runs_of(const PointSet& table, const ColumnsAsked& asked, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
