// SPDX-License-Identifier: MIT
//
// All units of all kinds in one form, for `list`, help and the guide's tables.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "core/json.hpp"
#include "core/options.hpp"

namespace stipple {

struct UnitInfo {
    std::string name;
    std::string summary;
    std::string source;
    std::string family = {};           ///< such as "blue noise"; empty for formats
    std::string strata = {};           ///< for warps: how strata in the unit cube are mapped
    std::uint64_t stream_version = 0;  ///< 0 for units that neither generate nor move points
    std::vector<std::string> aliases = {};
    std::shared_ptr<const Json> traits = {};
    std::vector<std::string> remarks = {};  ///< the traits in words, for help
    std::span<const Option> options = {};
    std::span<const ResultKey> results = {};  ///< keys of results, for analyzers
};

struct Kind {
    std::string name;  ///< such as "generators"
    std::string verb;  ///< verb that accepts units of this kind, or empty
    std::vector<UnitInfo> units;
};

/// Generators, scrambles, warps, analyzers, formats.
const std::vector<Kind>& catalog();

/// The kinds as JSON for `list --json`.
Json json_of(const std::vector<Kind>& kinds);

/// All units that a verb accepts, as one Kind with the name of the last of their kinds; nullptr if
/// the verb accepts none.
const Kind* units_for(std::string_view verb);

/// Unit by name or alias; nullptr if there is none.
const UnitInfo* find_unit(const Kind& kind, std::string_view name);

/// Names and aliases of all units of a kind.
std::vector<std::string> names_of(const Kind& kind);

/// The unit with this name that the verb accepts. @throws Error(usage) if there is none
const UnitInfo& unit_of(std::string_view verb, std::string_view name);

/// Notes after an option in help, such as " (in [0, 9]; steps; default 1)".
std::string option_notes(const Option& option);

/// An option as users type it, such as "--radius X".
std::string option_usage(const Option& option);

}  // namespace stipple
