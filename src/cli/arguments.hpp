// SPDX-License-Identifier: MIT
//
// The command line as data: verbs, the options that mean the same everywhere, and what was typed.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/catalog.hpp"

namespace stipple::cli {

enum class Verb : unsigned {
    generate = 1,
    warp = 2,
    analyze = 4,
    convert = 8,
    list = 16,
    plot = 32,
    study = 64,
    report = 128,
    reproduce = 256,
    help = 512,
    completions = 1024,
};

struct VerbInfo {
    Verb verb;
    const char* name;
    const char* usage;
    const char* summary;
    const char* text;      ///< paragraphs for --help
    const char* examples;  ///< lines for --help
};

const std::vector<VerbInfo>& verbs();

/// An option that a verb takes whatever the unit.
struct CommonOption {
    const char* names;  ///< "-n,--count"
    const char* value;  ///< placeholder; empty: a flag
    const char* fallback;
    const char* help;
    unsigned verbs;  ///< Verb bits
    bool repeatable = false;
};

const std::vector<CommonOption>& common_options();

bool takes(const CommonOption& option, Verb verb);

/// The option of that name ("-n" or "--count") that the verb takes; nullptr: there is none.
const CommonOption* find_common(std::string_view name, Verb verb);

/// A unit's options less those that the verb takes for all units.
std::vector<Option> own_options(Verb verb, const UnitInfo& unit);

/// What `--check` without a condition stands for.
inline constexpr std::string_view bare_check = "valid";

/// What was typed.
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

    /// As a number in [low, high]. @throws Error(usage)
    [[nodiscard]] std::optional<std::uint64_t> integer(std::string_view name, std::uint64_t low,
                                                       std::uint64_t high) const;
};

/// @throws Error(usage) naming what is unknown and what is nearest to it.
Arguments parse_arguments(int argc, const char* const* argv, const std::vector<Kind>& kinds);

}  // namespace stipple::cli
