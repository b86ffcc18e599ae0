// SPDX-License-Identifier: MIT
//
// All units of all kinds in one shape, for `list`, help and the guide's tables.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/json.hpp"
#include "core/options.hpp"

namespace stipple::cli {

struct UnitInfo {
    std::string name;
    std::string summary;
    std::string source;
    std::string family = {};           ///< "blue noise"; of formats: none
    std::string strata = {};           ///< of warps: what becomes of the unit coordinates
    std::uint64_t stream_version = 0;  ///< of units that make or move points; else 0
    std::vector<std::string> aliases = {};
    std::shared_ptr<const Json> traits = {};
    std::vector<std::string> remarks = {};  ///< the traits in words
    std::vector<Option> options = {};
    std::vector<std::pair<std::string, std::string>> results = {};  ///< key, help; of analyzers
};

struct Kind {
    std::string name;  ///< "generators"
    std::string verb;  ///< that takes such a unit, or nothing
    std::vector<UnitInfo> units;
};

/// Generators, scrambles, warps, analyzers, formats.
const std::vector<Kind>& catalog();

/// The kinds as `list --json` has them.
Json json_of(const std::vector<Kind>& kinds);

/// All units that a verb takes, under the name of the last of their kinds; nullptr if it takes
/// none.
const Kind* units_for(std::string_view verb);

/// The unit of that name or alias; nullptr if there is none.
const UnitInfo* find_unit(const Kind& kind, std::string_view name);

/// Names and aliases of all its units.
std::vector<std::string> names_of(const Kind& kind);

/// The unit of a verb. @throws Error(usage)
const UnitInfo& unit_of(std::string_view verb, std::string_view name);

/// "default 1, in [0, 9], steps": what help says behind an option.
std::string option_notes(const Option& option);

/// "--radius R": how an option is typed.
std::string option_usage(const Option& option);

}  // namespace stipple::cli
