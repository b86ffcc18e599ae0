// SPDX-License-Identifier: MIT
//
// Parameter files: JSON as documented in data/parameters.schema.json and `stipple help parameters`.
#pragma once

#include <string>
#include <string_view>

#include "core/spec.hpp"
#include "stipple/run.hpp"
#include "warps/parameters/parameter_space.hpp"

namespace stipple::parameters {

/// Parses a parameter file's text; texts that refer to other files are rejected.
/// @param source name of the text in messages
/// @throws Error(input) "SOURCE: $.parameters[2].range: error; what is expected"
ParameterSpace parse_parameters(std::string_view json, const std::string& source);

/// The warp of a parameter file, with the file's text in its spec.
struct NamedParameters {
    Spec spec;
    std::string domain;  ///< spec of the images' domain
    std::vector<std::string> names;
    Levels levels;
};

/// Reads a parameter file. Columns of other files that it refers to are read, too, and inserted.
/// @throws Error(input), Error(io)
NamedParameters read_parameters(const std::string& path, const RunContext& run = {});

/// The same warp, but with images in the unit cube.
Spec in_unit_cube(Spec parameters);

/// The text on one line, for specs and provenance. @throws Error(input)
std::string one_line(std::string_view json, const std::string& source);

}  // namespace stipple::parameters
