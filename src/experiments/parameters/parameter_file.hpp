// SPDX-License-Identifier: MIT
//
// Parameter files: JSON as documented in data/parameters.schema.json and `stipple help parameters`.
#pragma once

#include <string>
#include <string_view>

#include "experiments/parameters/parameter_space.hpp"
#include "stipple/run.hpp"

namespace stipple::parameters {

/// Parses a parameter file's text; texts that refer to other files are rejected.
/// @param source name of the text in messages
/// @throws Error(input) "SOURCE: $.parameters[2].range: error; what is expected"
ParameterSpace parse_parameters(std::string_view json, const std::string& source);

/// Text of a parameter file, in which references to columns of other files are replaced by their
/// numbers.
/// @throws Error(input), Error(io)
std::string text_with_columns(const std::string& path, const RunContext& run);

/// The text of a parameter file on one line, for specs and provenance. @throws Error(input)
std::string one_line(std::string_view json, const std::string& source);

}  // namespace stipple::parameters
