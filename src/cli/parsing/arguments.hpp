// SPDX-License-Identifier: MIT
//
// The command line as data: verbs, options that all units share, and the parsed arguments.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/help/guide.hpp"
#include "core/options.hpp"
#include "pipeline/catalog.hpp"

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

/// Union of sets of verbs.
constexpr Verb operator|(Verb a, Verb b) {
    return static_cast<Verb>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

struct VerbInfo : VerbPage {
    Verb verb;
    std::string name;
};

const std::vector<VerbInfo>& verbs();

/// Verb of that name; nullptr if there is none.
const VerbInfo* find_verb(std::string_view name);

const VerbInfo& info_of(Verb verb);

/// An option that verbs accept for every unit.
struct CommonOption {
    /// @param placeholder type of the value; empty for a flag; alternatives separated by |
    /// @param high above 0: the value is an integer up to this
    CommonOption(std::string_view all_names, std::string_view placeholder,
                 const char* shown_default, const char* help, Verb of_verbs, bool several = false,
                 double low = 0, double high = 0);

    std::string names;     ///< such as "-n,--count", with the long name last
    std::string value;     ///< placeholder; empty for a flag
    std::string fallback;  ///< default as shown in help; may be empty
    Option option;         ///< long name, type, range and help
    Verb verbs;            ///< verbs that accept it
    bool repeatable;
};

/// All common options that the verb accepts.
std::vector<const CommonOption*> options_of(Verb verb);

/// Common option of the verb by name ("-n" or "--count"); nullptr if there is none.
const CommonOption* find_common(std::string_view name, Verb verb);

/// A unit's options without those that the verb accepts for all units.
std::vector<Option> own_options(Verb verb, const UnitInfo& unit);

/// Condition of `--check` without a text.
inline constexpr std::string_view bare_check = "valid";

struct Arguments {
    std::optional<Verb> verb;
    std::string unit;                     ///< empty if none
    std::vector<std::string> specs = {};  ///< analyzers, if several are named
    std::vector<std::string> inputs;
    std::vector<std::pair<std::string, std::string>> common;    ///< long name and text
    std::vector<std::pair<std::string, std::string>> settings;  ///< the unit's own options
    bool help = false;
    bool version = false;

    [[nodiscard]] bool has(std::string_view name) const;
    /// Text of a common option, the last one if repeated; nullopt if not given.
    [[nodiscard]] std::optional<std::string> get(std::string_view name) const;
    [[nodiscard]] std::vector<std::string> all(std::string_view name) const;

    /// @throws Error(usage) "--NAME: WHY" for the first of these common options that is given
    void refuse(std::initializer_list<std::string_view> names, std::string_view why) const;

    /// Value as an integer in [low, high]; nullopt if not given. @throws Error(usage)
    [[nodiscard]] std::optional<std::uint64_t> integer(std::string_view name, std::uint64_t low,
                                                       std::uint64_t high) const;
    /// Value as an integer in the range of the verb's option. @throws Error(usage)
    [[nodiscard]] std::optional<std::uint64_t> integer(std::string_view name) const;
};

/// @throws Error(usage) if the text of a common option is not one of its choices
void check_choices(const Arguments& arguments);

/// @throws Error(usage) naming the unknown word and the most similar known one
Arguments parse_arguments(int argc, const char* const* argv);

/// Word that names a unit of the kind, alone or in a spec; nullptr if there is none.
const std::string* word_of_unit(const std::vector<std::string>& words, const Kind& kind, Verb verb);

}  // namespace stipple::cli
