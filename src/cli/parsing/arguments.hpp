// SPDX-License-Identifier: MIT
//
// The command line as data: verbs, options common to all units, and the parsed arguments.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/help/guide.hpp"
#include "core/options.hpp"
#include "report/catalog.hpp"

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
    emit = 2048,
};

/// Union of sets of verbs.
constexpr Verb operator|(Verb a, Verb b) {
    return static_cast<Verb>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

struct Arguments;
struct Request;
class Session;

/// When progress is shown on stderr; `automatic`: only on terminals.
enum class ProgressMode { automatic, always, never };

struct VerbInfo : VerbPage {
    Verb verb;
    std::string name;
    std::unique_ptr<Request> (*fill)(const Arguments&);  ///< makes the request; see request_of()
};

const std::vector<VerbInfo>& verbs();

/// Verb of that name; nullptr if there is none.
const VerbInfo* find_verb(std::string_view name);

const VerbInfo& info_of(Verb verb);

/// An option that some verbs accept, whatever the unit.
struct CommonOption {
    std::string names;     ///< such as "-n,--count", with the long name last
    std::string value;     ///< placeholder; empty for a flag
    std::string fallback;  ///< default as shown in help; may be empty
    Option option;         ///< long name, type, range and help
    Verb verbs;            ///< verbs that accept it
    /// Parses a text and stores it in the request of a verb in `verbs`. @throws Error(usage)
    std::function<void(Request&, const CommonOption&, const std::string& text)> store;
    bool repeatable = false;
};

std::vector<const CommonOption*> options_of(Verb verb);

/// Common option of the verb by name ("-n" or "--count"); nullptr if there is none.
const CommonOption* find_common(std::string_view name, Verb verb);

/// A unit's options without those that the verb accepts for all units.
std::vector<Option> own_options(Verb verb, const UnitInfo& unit);

/// Condition of `--check` without a text.
inline constexpr std::string_view bare_check = "valid";

struct Arguments {
    std::optional<Verb> verb;
    std::string unit;                     ///< empty if no unit is named
    std::vector<std::string> specs = {};  ///< specs of analyzers, if several are named
    std::vector<std::string> inputs;
    std::vector<std::pair<std::string, std::string>> common;    ///< long names and texts, as typed
    std::vector<std::pair<std::string, std::string>> settings;  ///< the unit's own options
    bool help = false;
    bool version = false;

    /// Whether a common option is given.
    [[nodiscard]] bool has(std::string_view name) const;
};

/// Rejects common options. @throws Error(usage) "--NAME: WHY" for the first of them that is given
/// @param names separated by commas
void refuse_options(const Arguments& arguments, std::string_view names, std::string_view why);

/// Values of a unit's own options: those given, otherwise the defaults. @throws Error(usage)
Values settings_of(const Schema& schema, const Arguments& arguments);

/// Parses the words of a command line. @throws Error(usage) naming an unknown word and the nearest
/// known one
Arguments parse_arguments(int argc, const char* const* argv);

/// First word that names a unit of the kind, alone or in a spec; nullptr if no word does.
const std::string* word_of_unit(const std::vector<std::string>& words, const Kind& kind, Verb verb);

}  // namespace stipple::cli
