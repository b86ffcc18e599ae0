// SPDX-License-Identifier: MIT
//
// The command line as data: the verbs, the options that mean the same for all units, and what was
// typed.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/help/guide.hpp"
#include "cli/parsing/catalog.hpp"
#include "core/options.hpp"

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

/// A set of verbs.
constexpr Verb operator|(Verb a, Verb b) {
    return static_cast<Verb>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

struct VerbInfo : VerbPage {
    Verb verb;
    std::string name;
};

const std::vector<VerbInfo>& verbs();

/// The verb of that name; nullptr: there is none.
const VerbInfo* find_verb(std::string_view name);

const VerbInfo& info_of(Verb verb);

/// An option that a verb takes whatever the unit.
struct CommonOption {
    /// @param placeholder its type: empty: a flag; words with | between: all that it may be
    /// @param high above 0: it is a whole number up to it
    CommonOption(std::string_view all_names, std::string_view placeholder,
                 const char* shown_default, const char* help, Verb of_verbs, bool several = false,
                 double low = 0, double high = 0);

    std::string names;     ///< "-n,--count", the long name last
    std::string value;     ///< placeholder; empty: a flag
    std::string fallback;  ///< as help states it; empty: nothing to state
    Option option;         ///< long name, type, range and help
    Verb verbs;            ///< that take it
    bool repeatable;
};

/// All common options that the verb takes.
std::vector<const CommonOption*> options_of(Verb verb);

/// The option of that name ("-n" or "--count") that the verb takes; nullptr: there is none.
const CommonOption* find_common(std::string_view name, Verb verb);

/// A unit's options less those that the verb takes for all units.
std::vector<Option> own_options(Verb verb, const UnitInfo& unit);

/// What `--check` without a condition stands for.
inline constexpr std::string_view bare_check = "valid";

struct Arguments {
    std::optional<Verb> verb;
    std::string unit;                     ///< empty: none named
    std::vector<std::string> specs = {};  ///< of analyzers, where several are named
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
