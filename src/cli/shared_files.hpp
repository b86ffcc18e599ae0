// SPDX-License-Identifier: MIT
//
// The files of a command as one set that ranks share.
#pragma once

#include <string>

#include "analyzers/analyzer.hpp"
#include "cli/arguments.hpp"
#include "pipeline/shared_analysis.hpp"

namespace stipple::cli {

/// All inputs as one set, mapped as --bounds says. `strengths` names a column behind the
/// coordinates.
SharedSet shared_files(const Arguments& arguments, const Analyzer& analyzer,
                       const std::string& strengths, Ranks& ranks, const RunContext& run);

}  // namespace stipple::cli
