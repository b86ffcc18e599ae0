// SPDX-License-Identifier: MIT
//
// Parameter files: JSON, as data/parameters.schema.json and `stipple help parameters` say.
#pragma once

#include <string>
#include <string_view>

#include "core/spec.hpp"
#include "stipple/run.hpp"
#include "warps/parameters/parameter_space.hpp"

namespace stipple::parameters {

/// Opens no file: a text that names others is refused.
/// @param source what messages call the text
/// @throws Error(input) "SOURCE: $.parameters[2].range: what is wrong; what is expected"
ParameterSpace parse_parameters(std::string_view json, const std::string& source);

/// The warp onto the parameters of a file, with the file's text in it.
struct NamedParameters {
    Spec spec;
    std::string domain;  ///< of its images, as text
    std::vector<std::string> names;
    Levels levels;
};

/// Columns of other files that it names are read, too, and stand in the text.
/// @throws Error(input), Error(io)
NamedParameters read_parameters(const std::string& path, const RunContext& run = {});

/// The same warp, which leaves the numbers in the unit cube.
Spec in_unit_cube(Spec parameters);

/// The same text on one line, as a spec and a provenance keep it. @throws Error(input)
std::string one_line(std::string_view json, const std::string& source);

}  // namespace stipple::parameters
