// SPDX-License-Identifier: MIT
//
// The command line as data: the verbs, and the options that mean the same for all units.
#pragma once

#include <string>
#include <string_view>
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

}  // namespace stipple::cli
