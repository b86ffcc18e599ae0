// SPDX-License-Identifier: MIT
//
// A spec names a unit and its options in one word:
//
//     NAME[@I,J...][:OPT=VALUE[,OPT=VALUE...]]      put values with commas in [brackets]
//
// Brackets may be nested: components=[cone:axis=[1,0,0]|hemisphere].
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/options.hpp"

namespace stipple {

struct Spec {
    std::string name;
    std::vector<std::size_t> coordinates;  ///< indices from 0; empty: all coordinates
    /// Names of options, and their values as text.
    std::vector<std::pair<std::string, std::string>> settings;

    /// The schema's defaults, overridden by the settings. @throws Error(usage)
    [[nodiscard]] Values values(const Schema& schema) const;
};

/// A spec as text that parse_spec() reads back.
std::string format_spec(const Spec& spec);

/// Parses one spec. @throws Error(usage) naming the column of the first error
Spec parse_spec(std::string_view text);

/// Splits a list of specs at commas and semicolons outside brackets. A comma before OPT= continues
/// the current spec: 'sobol:scramble=owen,seed=3,halton' has two specs. A semicolon always ends it.
/// @throws Error(usage) naming `who` and the column of the error
std::vector<std::string> split_specs(std::string_view text, std::string_view who);

/// Formats NAME or NAME:OPT=V,... with the options that differ from their defaults; parsing it
/// gives the same values.
std::string format_spec(std::string_view name, const Values& values, const Schema& schema);

/// Options and their values as text, without optional ones that were not given.
std::vector<std::pair<std::string, std::string>> typed_settings(const Values& values,
                                                                const Schema& schema);

/// List of specs for a message. Long specs, such as one that contains the text of a parameter file,
/// are shown without their options.
std::string short_specs(std::span<const std::string> specs);

/// Coordinates in the form used after @, counted from 1: "4,5".
std::string format_coordinates(const std::vector<std::size_t>& coordinates);

}  // namespace stipple
