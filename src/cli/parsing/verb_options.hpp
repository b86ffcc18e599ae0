// SPDX-License-Identifier: MIT
//
// The command line as data: the verbs, and the options that mean the same for all units.
#pragma once

#include <string>
#include <string_view>
#include <vector>

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

struct VerbInfo {
    Verb verb;
    std::string name;
    std::string usage;
    std::string summary;
    std::string text;      ///< paragraphs for --help
    std::string examples;  ///< lines for --help
};

const std::vector<VerbInfo>& verbs();

/// The verb of that name; nullptr: there is none.
const VerbInfo* find_verb(std::string_view name);

const VerbInfo& info_of(Verb verb);

/// An option that a verb takes whatever the unit.
struct CommonOption {
    std::string names;     ///< "-n,--count", the long name last
    std::string value;     ///< placeholder; empty: a flag
    std::string fallback;  ///< as help states it; empty: nothing to state
    Option option;         ///< long name, type, range and help
    unsigned verbs = 0;    ///< Verb bits
    bool repeatable = false;
};

const std::vector<CommonOption>& common_options();

bool takes(const CommonOption& option, Verb verb);

/// All common options that the verb takes.
std::vector<const CommonOption*> options_of(Verb verb);

/// The option of that name ("-n" or "--count") that the verb takes; nullptr: there is none.
const CommonOption* find_common(std::string_view name, Verb verb);

/// A unit's options less those that the verb takes for all units.
std::vector<Option> own_options(Verb verb, const UnitInfo& unit);

}  // namespace stipple::cli
