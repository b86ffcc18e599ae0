// SPDX-License-Identifier: MIT
//
// Parses a command line into Arguments. This is the only source that includes CLI11, whose headers
// are slow to compile.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <filesystem>
#include <utility>

#include "cli/parsing/arguments.hpp"
#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"

namespace stipple::cli {
namespace {

using Text = std::pair<std::string, std::string>;  ///< long name of an option, and its text
using Texts = std::vector<Text>;

/// Adds an option to a parser.
/// @param names such as "-n,--count"
/// @param texts receives name and text each time the option is given
void add(CLI::App& app, const std::string& names, const Option& option, bool repeatable,
         Texts& texts) {
    if (option.type == "flag") {
        app.add_flag_callback(names,
                              [&texts, name = option.name] { texts.emplace_back(name, "true"); });
        return;
    }
    auto* added = app.add_option(
        names, CLI::callback_t([&texts, name = option.name](const CLI::results_t& found) {
            for (const std::string& text : found) texts.emplace_back(name, text);
            return true;
        }));
    added->expected(1)->allow_extra_args(false);
    if (repeatable) added->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

[[noreturn]] void refuse(const CLI::ParseError& error) {
    const std::string text = error.what();
    const std::string option = text.substr(0, text.find(':'));
    if (text.find("At Most 1 required") != std::string::npos)
        fail(ErrorKind::usage, "{} is given more than once", option);
    if (text.ends_with("missing")) fail(ErrorKind::usage, "{} needs a value", option);
    fail(ErrorKind::usage, "{}", text);
}

/// Parses the words after a verb, except the unit's name; returns the words that were not
/// understood.
/// @param own options of the unit
std::vector<std::string> take_words(std::vector<std::string> words, const std::vector<Option>& own,
                                    bool takes_inputs, Arguments& arguments) {
    CLI::App app("stipple");
    app.allow_extras();
    app.set_help_flag();
    app.add_flag_callback("-h,--help", [&arguments] { arguments.help = true; });
    for (const CommonOption* common : options_of(*arguments.verb))
        add(app, common->names, common->option, common->repeatable, arguments.common);
    for (const Option& option : own)
        add(app, "--" + option.name, option, false, arguments.settings);
    if (takes_inputs)
        app.add_option("INPUT", CLI::callback_t([&arguments](const CLI::results_t& found) {
                           arguments.inputs = found;
                           return true;
                       }))
            ->expected(1, CLI::detail::expected_max_vector_size)
            ->allow_extra_args();
    std::ranges::reverse(words);
    try {
        app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        refuse(error);
    }
    return app.remaining();
}

[[noreturn]] void complain(std::string_view what, const std::string& word,
                           const std::vector<std::string>& known) {
    const auto meant = nearest_words(word, known);
    std::string hint = !meant.empty()   ? fmt::format("did you mean {}?", join(meant, " or "))
                       : what == "verb" ? "known: " + join(known, ", ")
                                        : "--help lists the options";
    fail_with_hint(ErrorKind::usage, hint, "unknown {} '{}'", what, word);
}

/// Gives each `--check` without a condition the default one, since the next word may be a file.
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

/// Reports the first word that was not understood, with the nearest known one. @throws Error(usage)
void check_rest(const std::vector<std::string>& rest, const VerbInfo& verb,
                const std::vector<Option>& own, bool lacks_unit) {
    if (rest.empty()) return;
    // A misspelt unit is the most likely reason for words that were not understood.
    if (lacks_unit && rest.front()[0] != '-') unit_of(verb.name, rest.front());
    std::vector<std::string> known = {"--help"};
    for (const CommonOption* option : options_of(verb.verb))
        known.push_back("--" + option->option.name);
    for (const Option& option : own) known.push_back("--" + option.name);
    for (const std::string& word : rest)
        if (word.size() > 1 && word[0] == '-')
            complain("option", word.substr(0, word.find('=')), known);
    fail(ErrorKind::usage, "unexpected argument '{}'", rest.front());
}

/// Specs in a list of several analyzers, "star-discrepancy,periodogram:window=hann"; empty for a
/// single one.
std::vector<std::string> several_specs(const std::string& word, Verb verb) {
    if (verb != Verb::analyze || word.find('@') != std::string::npos) return {};
    auto specs = split_specs(word, "analyze");
    if (specs.size() < 2) specs.clear();
    return specs;
}

/// Rejects an option outside the specs that belongs to one of several analyzers. @throws
/// Error(usage)
void refuse_loose_options(const std::vector<std::string>& rest, const Arguments& arguments,
                          const Kind& kind) {
    for (const std::string& word : rest)
        for (const std::string& text : arguments.specs) {
            const std::string name = parse_spec(text).name;
            const UnitInfo* unit = find_unit(kind, name);
            if (unit == nullptr || !word.starts_with("--")) continue;
            const std::string option = word.substr(2, word.find('=') - 2);
            if (std::ranges::find(unit->options, option, &Option::name) != unit->options.end())
                fail_with_hint(ErrorKind::usage, fmt::format("such as {}:{}=...", name, option),
                               "--{}: with several analyzers, options follow the analyzer's name",
                               option);
        }
}

/// Rejects the name of a second analyzer among the inputs, except if a file has that name. @throws
/// Error(usage)
void refuse_second_unit(const Arguments& arguments, const Kind& kind) {
    for (const std::string& word : arguments.inputs) {
        const std::string name = word.substr(0, word.find_first_of(",:"));
        std::error_code none;
        if (arguments.unit.empty() || find_unit(kind, name) == nullptr ||
            std::filesystem::exists(word, none))
            continue;
        fail_with_hint(
            ErrorKind::usage,
            fmt::format("separate several analyzers by commas: {},{}",
                        arguments.specs.empty() ? arguments.unit : join(arguments.specs, ","),
                        word),
            "{}: is the name of an analyzer, not a file", word);
    }
}

/// Replaces --json by --format.
void settle_format(Arguments& arguments) {
    if (!arguments.has("json")) return;
    std::erase_if(arguments.common, [](const auto& given) { return given.first == "json"; });
    const auto format = std::ranges::find(arguments.common, "format", &Text::first);
    if (format == arguments.common.end())
        arguments.common.emplace_back("format", "json");
    else if (format->second != "json")
        fail(ErrorKind::usage, "--json and --format {}: give one of them", format->second);
}

/// Adds the options in a unit's spec: `warp disk@4,5` means `warp disk --coordinates 4,5`, and
/// `generate sobol:scramble=owen` is the same as with --scramble owen. @throws Error(usage) if an
/// option is given twice
void take_spec(const Spec& spec, const UnitInfo& unit, Arguments& arguments) {
    if (!spec.coordinates.empty()) {
        if (arguments.verb != Verb::warp)
            fail(ErrorKind::usage, "{}@{}: only warps and scrambles take coordinates after @",
                 spec.name, format_coordinates(spec.coordinates));
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

/// Moves options before the verb, such as -q in `stipple -q generate halton`, behind it.
void put_verb_first(std::vector<std::string>& words) {
    for (std::size_t at = 1; at < words.size(); ++at) {
        const VerbInfo* info = find_verb(words[at]);
        std::size_t i = 0;
        while (info != nullptr && i < at) {
            const auto end = words[i].find('=');
            const CommonOption* known = find_common(words[i].substr(0, end), info->verb);
            if (known == nullptr) break;
            i += known->option.type == "flag" || end != std::string::npos ? 1 : 2;
        }
        if (i == at) return void(std::rotate(&words[0], &words[at], &words[at] + 1));
    }
}

Arguments parse_without_verb(const std::vector<std::string>& words) {
    Arguments arguments;
    if (words.empty()) return arguments;
    const std::string& word = words.front();
    arguments.help = word == "-h" || word == "--help";
    arguments.version = word == "--version";
    if (arguments.help || arguments.version) return arguments;
    if (word.starts_with('-') && std::ranges::any_of(words, find_verb))
        fail(ErrorKind::usage,
             "{}: options follow the verb, such as 'stipple generate halton -n 16'", word);
    if (word.starts_with('-')) complain("option", word, {"--help", "--version"});
    std::vector<std::string> names;
    for (const VerbInfo& info : verbs()) names.push_back(info.name);
    complain("verb", word, names);
}

}  // namespace

const std::string* word_of_unit(const std::vector<std::string>& words, const Kind& kind,
                                Verb verb) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        const CommonOption* common = find_common(words[i], verb);
        if (common != nullptr && common->option.type != "flag")
            ++i;  // skips the option's value
        else if (find_unit(kind, words[i].substr(0, words[i].find_first_of("@:,;"))) != nullptr)
            return &words[i];
    }
    return nullptr;
}

Arguments parse_arguments(int argc, const char* const* argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    put_verb_first(words);
    const VerbInfo* info = words.empty() ? nullptr : find_verb(words.front());
    if (info == nullptr) return parse_without_verb(words);
    words.erase(words.begin());
    const auto mark = std::ranges::find(words, "--");  // all words after "--" are inputs
    std::vector<std::string> inputs(mark, words.end());
    words.erase(mark, words.end());
    const Verb verb = info->verb;
    const Kind* kind = units_for(info->name);
    if (verb == Verb::analyze) complete_checks(words);
    Arguments arguments{.verb = verb, .unit = {}, .inputs = {}, .common = {}, .settings = {}};
    const UnitInfo* unit = nullptr;
    std::vector<Option> own;
    Spec spec;
    if (const std::string* named = kind ? word_of_unit(words, *kind, verb) : nullptr) {
        unit = find_unit(*kind, *named);
        if (unit == nullptr) {
            arguments.specs = several_specs(*named, verb);
            spec = parse_spec(arguments.specs.empty() ? *named : arguments.specs.front());
            unit = find_unit(*kind, spec.name);
        }
        const auto word = words.begin() + (named - words.data());
        if (unit == nullptr) {
            *word = spec.name;  // the message of check_rest() then names only the unit
        } else {
            if (arguments.specs.empty()) own = own_options(verb, *unit);
            arguments.unit = unit->name;
            words.erase(word);
        }
    }
    const bool makes = verb == Verb::generate || verb == Verb::emit;
    const bool takes_inputs = kind == nullptr || (unit != nullptr && !makes);
    const auto rest = take_words(std::move(words), own, takes_inputs, arguments);
    if (verb == Verb::analyze && !arguments.help) refuse_second_unit(arguments, *kind);
    if (makes && inputs.size() > 1) fail(ErrorKind::usage, "unexpected argument '{}'", inputs[1]);
    if (!inputs.empty())
        arguments.inputs.insert(arguments.inputs.end(), inputs.begin() + 1, inputs.end());
    if (!arguments.help) {
        if (!arguments.specs.empty()) refuse_loose_options(rest, arguments, *kind);
        check_rest(rest, *info, own, kind != nullptr && unit == nullptr);
    }
    if (unit != nullptr && !spec.name.empty() && arguments.specs.empty())
        take_spec(spec, *unit, arguments);
    settle_format(arguments);
    return arguments;
}

}  // namespace stipple::cli
