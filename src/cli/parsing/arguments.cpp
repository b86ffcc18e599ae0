// SPDX-License-Identifier: MIT
#include "cli/parsing/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/parsing/parser.hpp"
#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"

namespace stipple::cli {
namespace {

/// Options that may stand here, for suggestions.
std::vector<std::string> known_options(Verb verb, const UnitInfo* unit) {
    std::vector<std::string> names = {"--help"};
    for (const CommonOption* option : options_of(verb)) names.push_back("--" + option->option.name);
    if (unit != nullptr)
        for (const auto& option : own_options(verb, *unit)) names.push_back("--" + option.name);
    return names;
}

[[noreturn]] void complain(std::string_view what, const std::string& word,
                           const std::vector<std::string>& known) {
    const auto meant = nearest_word(word, known);
    std::string hint = meant            ? fmt::format("did you mean {}?", *meant)
                       : what == "verb" ? "known: " + join(known, ", ")
                                        : "--help lists the options";
    fail_with_hint(ErrorKind::usage, hint, "unknown {} '{}'", what, word);
}

/// `--check` takes the next word only if that is a condition, not a file.
void complete_checks(std::vector<std::string>& words) {
    const auto condition = [](const std::string& word) {
        return !word.starts_with('-') && word.find_first_of("<>=") != std::string::npos;
    };
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] != "--check") continue;
        if (i + 1 < words.size() && condition(words[i + 1])) continue;
        words[i] += "=" + std::string(bare_check);
    }
}

/// What the parser is to expect behind a verb.
Grammar grammar_of(Verb verb, const Kind* kind, const UnitInfo* unit) {
    Grammar grammar{.options = {}};
    for (const CommonOption* common : options_of(verb))
        grammar.options.push_back(
            {common->names, common->option.type == "flag", common->repeatable});
    grammar.inputs = kind == nullptr;
    if (unit == nullptr) return grammar;
    grammar.unit = {unit->name};
    grammar.unit.insert(grammar.unit.end(), unit->aliases.begin(), unit->aliases.end());
    for (const Option& option : own_options(verb, *unit))
        grammar.unit_options.push_back({"--" + option.name, option.type == "flag"});
    grammar.inputs = verb != Verb::generate;
    return grammar;
}

void check_rest(const std::vector<std::string>& rest, const VerbInfo& verb, const Kind* kind,
                const UnitInfo* unit) {
    if (rest.empty()) return;
    // A misspelt unit is the likelier reason for whatever else was not understood.
    if (kind != nullptr && unit == nullptr && rest.front()[0] != '-')
        unit_of({*kind}, verb.name, rest.front());
    for (const std::string& word : rest)
        if (word.size() > 1 && word[0] == '-')
            complain("option", word.substr(0, word.find('=')), known_options(verb.verb, unit));
    fail(ErrorKind::usage, "unexpected argument '{}'", rest.front());
}

/// Adds what the unit's own word sets: `warp disk@4,5` means `warp disk --coordinates 4,5`,
/// `generate sobol:scramble=owen` the same as with --scramble owen. @throws Error(usage) where an
/// option sets it, too
void take_spec(const Spec& spec, const UnitInfo& unit, Arguments& arguments) {
    if (!spec.coordinates.empty()) {
        if (arguments.verb != Verb::warp)
            fail(ErrorKind::usage, "{}@{}: coordinates behind @ are for warps", spec.name,
                 format_coordinates(spec.coordinates));
        if (arguments.has("coordinates"))
            fail(ErrorKind::usage, "--coordinates is given more than once");
        arguments.common.emplace_back("coordinates", format_coordinates(spec.coordinates));
    }
    const auto own = own_options(*arguments.verb, unit);
    for (const auto& [name, text] : spec.settings) {
        const bool common =
            std::ranges::find(own, name, &Option::name) == own.end() &&
            std::ranges::find(unit.options, name, &Option::name) != unit.options.end();
        auto& all = common ? arguments.common : arguments.settings;
        for (const auto& [before, value] : all)
            if (before == name) fail(ErrorKind::usage, "--{} is given more than once", name);
        all.emplace_back(name, text);
    }
}

/// Words in place of a verb.
Arguments parse_without_verb(const std::vector<std::string>& words) {
    Arguments arguments;
    if (words.empty()) return arguments;
    const std::string& word = words.front();
    arguments.help = word == "-h" || word == "--help";
    arguments.version = word == "--version";
    if (arguments.help || arguments.version) return arguments;
    if (word.starts_with('-')) complain("option", word, {"--help", "--version"});
    std::vector<std::string> names;
    for (const VerbInfo& info : verbs()) names.push_back(info.name);
    complain("verb", word, names);
}

}  // namespace

bool Arguments::has(std::string_view name) const { return get(name).has_value(); }

std::optional<std::string> Arguments::get(std::string_view name) const {
    const auto texts = all(name);
    return texts.empty() ? std::nullopt : std::optional(texts.back());
}

std::vector<std::string> Arguments::all(std::string_view name) const {
    std::vector<std::string> texts;
    for (const auto& [option, text] : common)
        if (option == name) texts.push_back(text);
    return texts;
}

std::optional<std::uint64_t> Arguments::integer(std::string_view name, std::uint64_t low,
                                                std::uint64_t high) const {
    const auto text = get(name);
    if (!text) return std::nullopt;
    const auto value = parse_unsigned(*text);
    if (value && *value >= low && *value <= high) return value;
    const auto number = parse_number(*text);
    if (!value && (!number || *number != std::floor(*number)))
        fail(ErrorKind::usage, "--{}: '{}' is not a whole number, such as 1000, 1e6, 2^20 or 64k",
             name, *text);
    fail(ErrorKind::usage, "--{}: {} is outside [{}, {}]", name, *text, low, high);
}

std::optional<std::uint64_t> Arguments::integer(std::string_view name) const {
    if (!has(name)) return std::nullopt;
    const Option& option = find_common("--" + std::string(name), *verb)->option;
    return integer(name, static_cast<std::uint64_t>(option.low),
                   static_cast<std::uint64_t>(option.high));
}

void check_choices(const Arguments& arguments) {
    for (const auto& [name, text] : arguments.common) {
        const CommonOption* common = find_common("--" + name, *arguments.verb);
        if (common != nullptr && common->option.type == "choice")
            static_cast<void>(common->option.parse(text));
    }
}

const std::string* word_of_unit(const std::vector<std::string>& words, const Kind& kind,
                                Verb verb) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        const CommonOption* common = find_common(words[i], verb);
        if (common != nullptr && common->option.type != "flag")
            ++i;  // to its value
        else if (find_unit(kind, words[i].substr(0, words[i].find_first_of("@:"))) != nullptr)
            return &words[i];
    }
    return nullptr;
}

Arguments parse_arguments(int argc, const char* const* argv, const std::vector<Kind>& kinds) {
    std::vector<std::string> words(argv + 1, argv + argc);
    const VerbInfo* info = words.empty() ? nullptr : find_verb(words.front());
    if (info == nullptr) return parse_without_verb(words);
    words.erase(words.begin());
    const Verb verb = info->verb;
    const auto kind = units_for(kinds, info->name);
    if (verb == Verb::analyze) complete_checks(words);
    const UnitInfo* unit = nullptr;
    Spec spec;
    if (const std::string* named = kind ? word_of_unit(words, *kind, verb) : nullptr) {
        std::string& word = words[static_cast<std::size_t>(named - words.data())];
        if (find_unit(*kind, word) == nullptr) {
            spec = parse_spec(word);
            word = spec.name;
        }
        unit = find_unit(*kind, word);
    }
    ParsedWords parsed = parse_words(grammar_of(verb, kind ? &*kind : nullptr, unit), words);
    Arguments arguments{.verb = verb,
                        .unit = {},
                        .inputs = std::move(parsed.inputs),
                        .common = std::move(parsed.options),
                        .settings = std::move(parsed.unit_options),
                        .help = parsed.help};
    if (parsed.unit) arguments.unit = unit->name;
    if (!arguments.help)
        check_rest(parsed.rest, *info, kind ? &*kind : nullptr, parsed.unit ? unit : nullptr);
    if (!spec.name.empty()) take_spec(spec, *unit, arguments);
    if (!arguments.help) check_choices(arguments);
    return arguments;
}

}  // namespace stipple::cli
