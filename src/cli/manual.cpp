// SPDX-License-Identifier: MIT
//
// The verb `help`, and manual pages in the language of man(7), made from the records.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "cli/help.hpp"
#include "cli/topics.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::cli {
namespace {

/// A text as roff takes it: backslashes and dashes as they stand, no line taken for a request.
std::string plain(std::string_view text) {
    std::string out;
    bool line_begins = true;
    for (const char c : text) {
        if (line_begins && (c == '.' || c == '\'')) out += "\\&";
        line_begins = c == '\n';
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else if (c == '\'')
            out += "\\(aq";
        else if (c == '`')
            out += "\\(ga";
        else if (c == '^')
            out += "\\(ha";
        else if (c == '~')
            out += "\\(ti";
        else
            out += c;
    }
    return out;
}

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

/// Lines as they stand.
std::string verbatim(std::string_view text) {
    return ".nf\n" + plain(text) + (text.ends_with('\n') ? "" : "\n") + ".fi\n";
}

std::string title(const std::string& page, int section) {
    return fmt::format(".TH {} {} \"\" \"stipple {}\" \"stipple manual\"\n", upper(plain(page)),
                       section, STIPPLE_VERSION);
}

std::string name_section(const std::string& page, const std::string& summary) {
    return fmt::format(".SH NAME\n{} \\- {}\n", plain(page), plain(summary));
}

/// An option with its help, as a tagged paragraph.
std::string paragraph(const std::string& tag, const std::string& text) {
    return fmt::format(".TP\n.B {}\n{}\n", plain(tag), plain(text));
}

std::string see_also(const std::string& but) {
    std::vector<std::string> pages;
    const auto add = [&](const std::string& page, int section) {
        if (page != but) pages.push_back(fmt::format(".BR {} ({})", plain(page), section));
    };
    add("stipple", 1);
    for (const VerbInfo& info : verbs()) add(fmt::format("stipple-{}", info.name), 1);
    for (const Topic& topic : topics()) add(fmt::format("stipple-{}", topic.name), 7);
    return ".SH SEE ALSO\n" + join(pages, ",\n") + "\n";
}

std::string page_of_program() {
    std::string text = title("stipple", 1);
    text += name_section("stipple", "makes sample sets, warps them, and judges them");
    text += ".SH SYNOPSIS\n.B stipple\n.I VERB\n[...] [\\fIOPTIONS\\fR]\n";
    text += ".SH DESCRIPTION\n" +
            plain(
                "Points for whatever samples a domain: sequences, nets, lattices and blue noise; "
                "maps of them onto other domains and densities; and measures of how even they "
                "are. Data is the only thing on standard output.\n");
    text += ".SH VERBS\n";
    for (const VerbInfo& info : verbs()) text += paragraph(info.name, info.summary);
    text += ".SH TOPICS\n";
    for (const Topic& topic : topics()) text += paragraph(topic.name, topic.summary);
    text += ".SH EXIT STATUS\n";
    const auto codes = std::ranges::find_if(
        topics(), [](const Topic& topic) { return std::string_view(topic.name) == "exit-codes"; });
    const std::string_view all = codes->text;
    return text + verbatim(all.substr(0, all.find("\n\n") + 1)) + see_also("stipple");
}

std::string common_paragraphs(Verb verb) {
    std::string text;
    for (const CommonOption& option : common_options()) {
        if (!takes(option, verb)) continue;
        std::string names = option.names;
        replace_all(names, ",", ", ");
        std::string help = option.help;
        if (option.repeatable) help += "; repeatable";
        if (*option.fallback != '\0') help += fmt::format(" (default {})", option.fallback);
        text += paragraph(*option.value == '\0' ? names : fmt::format("{} {}", names, option.value),
                          help);
    }
    return text + paragraph("-h, --help", "all about it");
}

std::string unit_section(const VerbInfo& info, const UnitInfo& unit) {
    std::string text = fmt::format(".SS {}\n{}", plain(unit.name), plain(unit.summary));
    text += plain(fmt::format(" ({}).", join(unit.remarks, "; ")));
    if (!unit.strata.empty()) text += plain(fmt::format(" Strata: {}.", unit.strata));
    if (!unit.aliases.empty())
        text += plain(fmt::format(" Also called {}.", join(unit.aliases, ", ")));
    text += plain(fmt::format(" Source: {}.\n", unit.source));
    for (const Option& option : own_options(info.verb, unit))
        text += paragraph(option_usage(option), option.help + option_notes(option));
    if (!unit.results.empty()) text += ".P\nResults:\n";
    for (const auto& [key, help] : unit.results) text += paragraph(key, help);
    return text;
}

std::string page_of_verb(const VerbInfo& info, const std::vector<Kind>& kinds) {
    const std::string page = fmt::format("stipple-{}", info.name);
    std::string text = title(page, 1) + name_section(page, info.summary);
    text += ".SH SYNOPSIS\n" + verbatim(info.usage);
    text += ".SH DESCRIPTION\n" + plain(info.text) + "\n";
    text += ".SH OPTIONS\n" + common_paragraphs(info.verb);
    for (const Kind& kind : kinds) {
        if (kind.verb != info.name) continue;
        text += ".SH " + upper(kind.name) + "\n";
        for (const UnitInfo& unit : kind.units) text += unit_section(info, unit);
    }
    return text + ".SH EXAMPLES\n" + verbatim(info.examples) + see_also(page);
}

std::string page_of_topic(const Topic& topic) {
    const std::string page = fmt::format("stipple-{}", topic.name);
    return title(page, 7) + name_section(page, topic.summary) + ".SH DESCRIPTION\n" +
           verbatim(topic.text) + see_also(page);
}

const Topic* find_topic(const std::string& name) {
    for (const Topic& topic : topics())
        if (name == topic.name) return &topic;
    return nullptr;
}

const VerbInfo* find_verb(const std::string& name) {
    for (const VerbInfo& info : verbs())
        if (name == info.name) return &info;
    return nullptr;
}

[[noreturn]] void refuse_name(const std::string& name, const std::vector<Kind>& kinds) {
    std::vector<std::string> known;
    for (const Topic& topic : topics()) known.emplace_back(topic.name);
    for (const VerbInfo& info : verbs()) known.emplace_back(info.name);
    for (const Kind& kind : kinds)
        for (const UnitInfo& unit : kind.units) {
            known.push_back(unit.name);
            known.insert(known.end(), unit.aliases.begin(), unit.aliases.end());
        }
    if (!nearest_word(name, known))
        fail_with_hint(ErrorKind::usage, "'stipple help' lists topics and verbs",
                       "help: unknown topic, verb or unit '{}'", name);
    fail_with_hint(ErrorKind::usage, suggest(name, known), "help: unknown topic, verb or unit '{}'",
                   name);
}

/// A unit by its name alone.
std::string help_of_unit(const std::string& name, const std::vector<Kind>& kinds) {
    for (const Kind& kind : kinds) {
        const VerbInfo* info = find_verb(kind.verb);
        if (find_unit(kind, name) == nullptr) continue;
        if (info == nullptr) {
            if (const Topic* topic = find_topic(kind.name)) return topic->text;  // csv: formats
            continue;
        }
        Arguments asked;
        asked.verb = info->verb;
        asked.unit = name;
        return help_text(asked, kinds);
    }
    refuse_name(name, kinds);
}

std::string help_on(const std::vector<std::string>& words, const std::vector<Kind>& kinds) {
    Arguments asked;
    if (words.empty()) return help_text(asked, kinds);
    if (const Topic* topic = find_topic(words[0]); topic != nullptr && words.size() == 1)
        return topic->text;
    const VerbInfo* info = find_verb(words[0]);
    if (words.size() > 1 && (info == nullptr || !units_for(kinds, info->name)))
        fail_with_hint(ErrorKind::usage, fmt::format("'stipple help {}' takes one word", words[0]),
                       "help: '{}' is not understood behind '{}', which is no verb with units",
                       words[1], words[0]);
    if (info == nullptr) return help_of_unit(words[0], kinds);
    asked.verb = info->verb;
    if (words.size() > 1) asked.unit = words[1];
    return help_text(asked, kinds);
}

}  // namespace

std::string manual_page(const std::string& name, const std::vector<Kind>& kinds) {
    if (name.empty()) return page_of_program();
    if (const Topic* topic = find_topic(name)) return page_of_topic(*topic);
    if (const VerbInfo* info = find_verb(name)) return page_of_verb(*info, kinds);
    refuse_name(name, kinds);
}

namespace {

/// Every manual page in a folder, under the names that man knows them by.
void write_manual(const std::string& folder, const std::vector<Kind>& kinds) {
    write_text(folder + "/stipple.1", manual_page("", kinds));
    for (const VerbInfo& info : verbs())
        write_text(fmt::format("{}/stipple-{}.1", folder, info.name),
                   manual_page(info.name, kinds));
    for (const Topic& topic : topics())
        write_text(fmt::format("{}/stipple-{}.7", folder, topic.name),
                   manual_page(topic.name, kinds));
}

}  // namespace

int help(const Arguments& arguments, const std::vector<Kind>& kinds) {
    const auto& words = arguments.inputs;
    const std::size_t most = arguments.has("man") ? 1 : 2;
    if (words.size() > most)
        fail(ErrorKind::usage, "help takes {} at most; {} are given",
             most == 1 ? "one word with --man" : "a topic, or a verb and a unit", words.size());
    const auto folder = arguments.get("output");
    if (folder && (!arguments.has("man") || !words.empty()))
        fail(ErrorKind::usage, "--output: a folder is for all manual pages: help --man -o {}",
             *folder);
    if (folder) {
        write_manual(*folder, kinds);
        return 0;
    }
    write_text("-", arguments.has("man") ? manual_page(words.empty() ? "" : words[0], kinds)
                                         : help_on(words, kinds));
    return 0;
}

}  // namespace stipple::cli
