// SPDX-License-Identifier: MIT
//
// What was typed: the verb, its unit, inputs and options.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/parsing/catalog.hpp"
#include "cli/parsing/verb_options.hpp"

namespace stipple::cli {

/// What `--check` without a condition stands for.
inline constexpr std::string_view bare_check = "valid";

struct Arguments {
    std::optional<Verb> verb;
    std::string unit;  ///< empty: none named
    std::vector<std::string> inputs;
    std::vector<std::pair<std::string, std::string>> common;    ///< long name, text
    std::vector<std::pair<std::string, std::string>> settings;  ///< the unit's own
    bool help = false;
    bool version = false;

    [[nodiscard]] bool has(std::string_view name) const;
    /// The text of a common option, the last one if it was given several times.
    [[nodiscard]] std::optional<std::string> get(std::string_view name) const;
    [[nodiscard]] std::vector<std::string> all(std::string_view name) const;

    /// @throws Error(usage) "--NAME: WHY" for the first of the common options that is given
    void refuse(std::initializer_list<std::string_view> names, std::string_view why) const;

    /// As a number in [low, high]. @throws Error(usage)
    [[nodiscard]] std::optional<std::uint64_t> integer(std::string_view name, std::uint64_t low,
                                                       std::uint64_t high) const;
    /// As a number in the range of the verb's option. @throws Error(usage)
    [[nodiscard]] std::optional<std::uint64_t> integer(std::string_view name) const;
};

/// @throws Error(usage) for a common option whose text is none of its choices
void check_choices(const Arguments& arguments);

/// @throws Error(usage) naming what is unknown and what is nearest to it.
Arguments parse_arguments(int argc, const char* const* argv);

/// The word that names a unit of the kind, alone or in a spec; nullptr: none does.
const std::string* word_of_unit(const std::vector<std::string>& words, const Kind& kind, Verb verb);

}  // namespace stipple::cli
