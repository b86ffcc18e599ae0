// SPDX-License-Identifier: MIT
//
// The one source that sees CLI11, whose headers take long to compile.
#include "cli/parsing/parser.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>

#include "core/error.hpp"

namespace stipple::cli {
namespace {

void add(CLI::App& app, const Grammar::Word& word, ParsedWords::Texts& texts) {
    const std::string name = word.names.substr(word.names.rfind("--") + 2);
    if (word.flag) {
        app.add_flag_callback(word.names, [&texts, name] { texts.emplace_back(name, "true"); });
        return;
    }
    auto* option =
        app.add_option(word.names, CLI::callback_t([&texts, name](const CLI::results_t& found) {
                           for (const std::string& text : found) texts.emplace_back(name, text);
                           return true;
                       }));
    option->expected(1)->allow_extra_args(false);
    if (word.repeatable) option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_help(CLI::App& app, ParsedWords& parsed) {
    app.set_help_flag();
    app.add_flag_callback("-h,--help", [&parsed] { parsed.help = true; });
}

void add_inputs(CLI::App& app, ParsedWords& parsed) {
    app.add_option("INPUT", CLI::callback_t([&parsed](const CLI::results_t& found) {
                       parsed.inputs = found;
                       return true;
                   }))
        ->expected(1, CLI::detail::expected_max_vector_size)
        ->allow_extra_args();
}

/// Only the unit that the words name is a subcommand, so that a file may be called like another.
void add_unit(CLI::App& parent, const Grammar& grammar, ParsedWords& parsed) {
    CLI::App& app = *parent.add_subcommand(grammar.unit.front());
    for (const std::string& alias : grammar.unit)
        if (alias != grammar.unit.front()) app.alias(alias);
    app.fallthrough();
    app.allow_extras();
    add_help(app, parsed);
    for (const auto& word : grammar.unit_options) add(app, word, parsed.unit_options);
    if (grammar.inputs) add_inputs(app, parsed);
}

[[noreturn]] void refuse(const CLI::ParseError& error) {
    const std::string text = error.what();
    const std::string option = text.substr(0, text.find(':'));
    if (text.find("At Most 1 required") != std::string::npos)
        fail(ErrorKind::usage, "{} is given more than once", option);
    if (text.ends_with("missing")) fail(ErrorKind::usage, "{} needs a value", option);
    fail(ErrorKind::usage, "{}", text);
}

}  // namespace

ParsedWords parse_words(const Grammar& grammar, std::vector<std::string> words) {
    ParsedWords parsed;
    CLI::App app("stipple");
    app.allow_extras();
    add_help(app, parsed);
    for (const auto& word : grammar.options) add(app, word, parsed.options);
    if (!grammar.unit.empty())
        add_unit(app, grammar, parsed);
    else if (grammar.inputs)
        add_inputs(app, parsed);
    std::ranges::reverse(words);
    try {
        app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        refuse(error);
    }
    parsed.unit = !app.get_subcommands().empty();
    parsed.rest = app.remaining(true);
    return parsed;
}

}  // namespace stipple::cli
