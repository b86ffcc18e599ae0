// SPDX-License-Identifier: MIT
//
// A spec names a unit with its options in one word:
//
//     NAME[@I,J...][:OPT=VALUE[,OPT=VALUE...]]      a value with commas stands in [brackets]
//
// and may hold pairs of brackets: components=[cone:axis=[1,0,0]|hemisphere].
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/options.hpp"

namespace stipple {

struct Spec {
    std::string name;
    std::vector<std::size_t> coordinates;                       ///< from 0; empty: all
    std::vector<std::pair<std::string, std::string>> settings;  ///< option, text

    /// The settings laid over the schema's defaults. @throws Error(usage)
    [[nodiscard]] Values values(const Schema& schema) const;
};

/// @throws Error(usage) naming the column at which the text stops being a spec.
Spec parse_spec(std::string_view text);

/// Specs separated by commas or semicolons, outside of brackets. A comma before OPT= goes on with
/// the spec before it, so that 'sobol:scramble=owen,seed=3,halton' is two; a semicolon never does.
/// @throws Error(usage) naming `who` and the column of what is missing.
std::vector<std::string> split_specs(std::string_view text, std::string_view who);

/// NAME or NAME:OPT=V,... with what differs from the defaults; parses back to the same.
std::string format_spec(std::string_view name, const Values& values, const Schema& schema);

/// The options as one types them, less those without a default that were not given.
std::vector<std::pair<std::string, std::string>> typed_settings(const Values& values,
                                                                const Schema& schema);

/// Coordinates as they stand behind @, counted from 1: "4,5".
std::string format_coordinates(const std::vector<std::size_t>& coordinates);

}  // namespace stipple
