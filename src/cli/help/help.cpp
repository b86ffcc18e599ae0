// SPDX-License-Identifier: MIT
//
// Pages for --help, the verb `help` and the manual, made from the units' records.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/help/guide.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "pipeline/generated.hpp"
#include "pipeline/units.hpp"
#include "plot/text_picture.hpp"

namespace stipple::cli {
namespace {

/// Escapes text for roff, so that it appears literally and no line is taken as a request.
std::string escaped(std::string_view text) {
    std::string out(text);
    for (const auto& [plain, roff] : {std::pair{"\\", "\\e"},
                                      {"-", "\\-"},
                                      {"'", "\\(aq"},
                                      {"`", "\\(ga"},
                                      {"^", "\\(ha"},
                                      {"~", "\\(ti"},
                                      {"|", "|\\:"},  // allows a line break
                                      {"\n.", "\n\\&."}})
        replace_all(out, plain, roff);
    return out.starts_with('.') ? "\\&" + out : out;
}

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

/// A help page in one of two styles: plain text for terminals, or man(7).
class HelpPage {
  public:
    enum class Style { text, man };

    explicit HelpPage(Style style) : style_(style), columns_(text_columns()) {}

    [[nodiscard]] bool for_man() const { return style_ == Style::man; }
    [[nodiscard]] const std::string& text() const { return text_; }

    /// Starts the page. @param number section of the manual
    void title(const std::string& name, int number, const std::string& summary,
               const std::string& usage = {}) {
        if (!for_man()) {
            text_ +=
                fmt::format("{}\n\nUsage: {}\n", filled(name + ": " + summary, columns_), usage);
            return;
        }
        text_ += fmt::format(
            ".TH {} {} \"\" \"stipple {}\" \"stipple manual\"\n.ad l\n.SH NAME\n{} \\- {}\n",
            escaped(upper(name)), number, STIPPLE_VERSION, escaped(name), escaped(summary));
        if (!usage.empty()) {
            section("Synopsis");
            lines(usage);
        }
        section("Description");
    }

    void section(const std::string& name) {
        text_ += for_man() ? fmt::format(".SH {}\n", escaped(upper(name)))
                           : fmt::format("\n{}:\n", name);
    }

    /// Starts a subsection; call it only for the manual.
    void subsection(const std::string& name) { text_ += fmt::format(".SS {}\n", escaped(name)); }

    void paragraph(const std::string& text) {
        text_ +=
            for_man() ? fmt::format(".P\n{}\n", escaped(text)) : "\n" + filled_page(text, columns_);
    }

    /// Adds sentences, each on its own line.
    void facts(const std::vector<std::string>& sentences) {
        text_ += "\n";
        for (const std::string& sentence : sentences) text_ += filled(sentence, columns_, 2) + "\n";
    }

    /// Adds an option, verb or result with its explanation.
    void entry(const std::string& tag, const std::string& help) {
        constexpr std::size_t tags = 28;  // columns for the tag
        text_ += for_man() ? fmt::format(".TP\n.B {}\n{}\n", escaped(trim(tag)), escaped(help))
                           : beside("  " + tag, help, columns_, tags);
    }

    /// Adds lines unchanged.
    void lines(std::string_view text) {
        const std::string ended = std::string(text) + (text.ends_with('\n') ? "" : "\n");
        text_ += for_man() ? ".nf\n" + escaped(ended) + ".fi\n" : ended;
    }

    /// Refers to the pages of all verbs and topics except `but`; does nothing outside the manual.
    void see_also(const std::string& but) {
        if (!for_man()) return;
        std::vector<std::string> pages;
        const auto add = [&](const std::string& page, int number) {
            if (page != but) pages.push_back(fmt::format(".BR {} ({})", escaped(page), number));
        };
        add("stipple", 1);
        for (const VerbInfo& info : verbs()) add("stipple-" + info.name, 1);
        for (const Topic& topic : topics()) add("stipple-" + topic.name, 7);
        section("See also");
        text_ += join(pages, ",\n") + "\n";
    }

  private:
    Style style_;
    std::size_t columns_;
    std::string text_;
};

void add_common_options(HelpPage& page, Verb verb) {
    for (const CommonOption* common : options_of(verb)) {
        std::string names = common->names;
        if (names.starts_with("--")) names.insert(0, "    ");
        replace_all(names, ",", ", ");
        if (!common->value.empty()) names += " " + common->value;
        std::string help = common->option.help;
        if (common->repeatable) help += "; repeatable";
        if (!common->fallback.empty()) help += fmt::format(" (default {})", common->fallback);
        page.entry(names, help);
    }
    page.entry("-h, --help", "show this help");
}

void add_options_of(HelpPage& page, Verb verb, const UnitInfo& unit) {
    for (const Option& option : own_options(verb, unit))
        page.entry("    " + option_usage(option), option.help + option_notes(option));
}

void add_results(HelpPage& page, const UnitInfo& unit) {
    for (const ResultKey& result : unit.results) page.entry(result.key, result.help);
}

/// Sentences about a unit: source, remarks, strata, other names.
std::vector<std::string> facts_of(const UnitInfo& unit) {
    std::vector<std::string> facts = {"Source: " + unit.source + ".",
                                      capitalised(join(unit.remarks, "; ")) + "."};
    if (!unit.strata.empty()) facts.push_back(fmt::format("Strata: {}.", unit.strata));
    if (!unit.aliases.empty())
        facts.push_back(fmt::format("Also called {}.", join(unit.aliases, ", ")));
    return facts;
}

/// Adds the exit codes and their meanings, which the topic exit-codes lists as indented lines.
void add_exit_codes(HelpPage& page) {
    const std::string_view text = std::ranges::find(topics(), "exit-codes", &Topic::name)->text;
    const std::string_view codes = text.substr(text.find("\n    ") + 1);
    for (const auto line : split(codes.substr(0, codes.find("\n\n")), '\n')) {
        const std::string_view entry = trim(line);
        const auto blank = entry.find(' ');
        page.entry(std::string(entry.substr(0, blank)), std::string(trim(entry.substr(blank))));
    }
}

/// Adds commands with their comments, indented.
void add_examples(HelpPage& page, const std::string& examples) {
    page.section("Examples");
    std::string lines = "  " + examples;
    replace_all(lines, "\nstipple", "\n  stipple");
    page.lines(lines);
}

/// First screen: what the program is, five commands to begin with, and where to go on.
HelpPage page_of_program(HelpPage::Style style) {
    HelpPage page(style);
    const VerbPage about = verb_page("stipple");
    page.title("stipple", 1, about.summary, about.usage);
    page.paragraph(about.text);
    add_examples(page, about.examples);
    page.section("Verbs");
    for (const VerbInfo& info : verbs()) page.entry(info.name, info.summary);
    for (const TopicGroup& group : topic_groups()) {
        page.section(group.heading);
        for (const Topic* topic : group.topics) page.entry(topic->name, topic->summary);
    }
    page.paragraph(
        "'stipple help WORD' explains a topic, a verb, a unit, a term of the field, or what\n"
        "another package calls something; 'stipple list' names all units.");
    if (page.for_man()) {
        page.section("Exit status");
        add_exit_codes(page);
    }
    page.see_also("stipple");
    return page;
}

/// Adds a unit to the manual page of its verb.
void add_unit(HelpPage& page, Verb verb, const UnitInfo& unit) {
    page.subsection(unit.name);
    page.paragraph(capitalised(unit.summary) + ".\n" + join(facts_of(unit), "\n"));
    add_options_of(page, verb, unit);
    if (!unit.results.empty()) page.paragraph("Results:");
    add_results(page, unit);
}

HelpPage page_of_verb(const VerbInfo& info, HelpPage::Style style) {
    HelpPage page(style);
    const bool man = page.for_man();
    page.title((man ? "stipple-" : "stipple ") + info.name, 1, info.summary, info.usage);
    page.paragraph(info.text);
    for (const Kind& kind : catalog()) {
        if (kind.verb != info.name) continue;
        page.section(capitalised(kind.name));
        for (const UnitInfo& unit : kind.units)
            man ? add_unit(page, info.verb, unit) : page.entry(unit.name, unit.summary);
    }
    if (!man && units_for(info.name))
        page.lines(fmt::format("'stipple {} UNIT --help' shows a unit's own options.", info.name));
    page.section("Options");
    add_common_options(page, info.verb);
    add_examples(page, info.examples);
    page.see_also("stipple-" + info.name);
    return page;
}

/// Points of a generator with options for a short run, mapped by the warps; nullopt on failure.
std::optional<PointSet> sample_of(const char* generator, std::uint64_t count, std::size_t dimension,
                                  std::vector<Spec> warps) {
    const Generator& made_by = find_generator(generator);
    try {
        return GeneratedSets({.generator = &made_by,
                              .options = quick_options(made_by),
                              .request = {.count = count, .dimension = dimension},
                              .warps = std::move(warps)},
                             {})
            .made(0, {});
    } catch (const Error&) {
        return std::nullopt;
    }
}

/// Picture of a generator's points or a warp's image, drawn with characters; empty for other units,
/// and if an option is required.
std::string picture_in_letters(Verb verb, const UnitInfo& unit) {
    std::optional<PointSet> points;
    if (verb == Verb::generate) points = sample_of(unit.name.c_str(), 256, 2, {});
    if (verb == Verb::warp && scramble_named(unit.name) == nullptr)
        for (std::size_t d = 1; d <= 3 && !points; ++d)
            points = sample_of("jittered", d == 3 ? 1000 : 900, d, {parse_spec(unit.name)});
    if (!points) return {};
    plot::PointsPicture picture{.sets = {&*points}, .names = {unit.name}};
    return plot::points_as_text(picture, {.columns = 48, .rows = 24});
}

HelpPage page_of_unit(const VerbInfo& info, const UnitInfo& unit) {
    std::string usage = info.usage;
    const auto word = usage.find(' ', sizeof "stipple");
    const auto end = usage.find(' ', word + 1);
    // Only the part before '[' of "ANALYZER[,ANALYZER...]" is replaced by the unit's name.
    const std::string wanted = usage.substr(word + 1, end - word - 1);
    const std::string others = wanted.substr(std::min(wanted.find('['), wanted.size()));
    usage.replace(word + 1, wanted.size(), unit.name + others);
    HelpPage page(HelpPage::Style::text);
    page.title(unit.name, 1, unit.summary, usage);
    page.facts(facts_of(unit));
    if (!own_options(info.verb, unit).empty()) page.section("Options of " + unit.name);
    add_options_of(page, info.verb, unit);
    if (!unit.results.empty()) page.section("Results");
    add_results(page, unit);
    if (const std::string picture = picture_in_letters(info.verb, unit); !picture.empty()) {
        page.section("Picture");
        page.lines(picture);
    }
    page.section("Options of " + info.name);
    add_common_options(page, info.verb);
    page.paragraph(info.text);
    for (const Kind& kind : catalog())
        if (kind.verb != info.name && find_verb(kind.verb) && find_unit(kind, unit.name))
            page.paragraph(fmt::format("'stipple {} {} --help' is about the {} of this name.",
                                       kind.verb, unit.name,
                                       kind.name.substr(0, kind.name.size() - 1)));
    return page;
}

/// Converts the Markdown of a topic to a manual page.
HelpPage page_of_topic(const Topic& topic) {
    HelpPage page(HelpPage::Style::man);
    page.title("stipple-" + topic.name, 7, topic.summary);
    std::string_view rest = topic.text;
    rest.remove_prefix(rest.find("\n\n") + 2);
    while (!rest.empty()) {
        const auto end = std::min(rest.find("\n\n"), rest.size());
        const std::string_view part = rest.substr(0, end);
        if (part.starts_with("## "))
            page.section(std::string(part.substr(3)));
        else if (part.starts_with("### "))
            page.subsection(std::string(part.substr(4)));
        else if (part.starts_with("    "))
            page.lines(part);
        else if (part.starts_with("- ") || part.starts_with('|'))
            page.lines(filled_page(part, 72));  // man indents by seven columns
        else
            page.paragraph(std::string(trim(part)));
        rest.remove_prefix(std::min(end + 2, rest.size()));
    }
    page.see_also("stipple-" + topic.name);
    return page;
}

/// Replaces blanks and underscores by hyphens, so that "star_discrepancy" names a unit.
std::string hyphenated(std::string name) {
    std::ranges::replace(name, ' ', '-');
    std::ranges::replace(name, '_', '-');
    return name;
}

const Topic* find_topic(const std::string& name) {
    const auto it = std::ranges::find(topics(), name, &Topic::name);
    return it == topics().end() ? nullptr : &*it;
}

[[noreturn]] void refuse_name(const std::string& name) {
    const std::vector<std::string> known = explained_words();
    fail_with_hint(ErrorKind::usage,
                   nearest_words(name, known).empty() ? "'stipple help' lists topics and verbs"
                                                      : suggest(name, known),
                   "help: unknown word '{}': no topic, verb, unit or term", name);
}

/// Help for a unit named without its verb, for a term, or for what another package calls something.
std::string help_of_word(const std::string& name) {
    std::string found = filled_page(glossary_entry(name), text_columns());
    for (const Kind& kind : catalog()) {
        const UnitInfo* unit = find_unit(kind, hyphenated(name));
        if (unit == nullptr) continue;
        if (const VerbInfo* info = find_verb(kind.verb))
            return found + (found.empty() ? "" : "\n") + page_of_unit(*info, *unit).text();
        // Formats, such as csv, have no verb; one topic is about all of them.
        if (const Topic* topic = find_topic(kind.name))
            return filled_page(topic->text, text_columns());
    }
    std::string lines = coming_from(name);
    if (found.empty() && lines.empty())
        lines = coming_from(name.substr(name.rfind(' ') + 1));  // the last word of "qmc Halton"
    if (!lines.empty()) found += (found.empty() ? "" : "\n") + filled_page(lines, text_columns());
    if (found.empty()) found = filled_page(python_section(name), text_columns());
    if (!found.empty()) return found;
    refuse_name(name);
}

std::string help_on(const std::vector<std::string>& words) {
    Arguments asked;
    if (words.empty()) return help_text(asked);
    if (const Topic* topic = find_topic(hyphenated(join(words, " "))))
        return filled_page(topic->text, text_columns());
    const VerbInfo* info = find_verb(words[0]);
    if (info == nullptr) return help_of_word(join(words, " "));
    if (words.size() > 2 || (words.size() > 1 && !units_for(info->name)))
        fail_with_hint(ErrorKind::usage, fmt::format("'stipple help {}'", words[0]),
                       "help: unexpected '{}' after '{}'", words.back(), words[0]);
    asked.verb = info->verb;
    if (words.size() > 1) asked.unit = words[1];
    return help_text(asked);
}

/// Manual page of the program (empty name), a verb or a topic. @throws Error(usage)
std::string manual_page(const std::string& name) {
    if (name.empty()) return page_of_program(HelpPage::Style::man).text();
    if (const Topic* topic = find_topic(name)) return page_of_topic(*topic).text();
    if (const VerbInfo* info = find_verb(name))
        return page_of_verb(*info, HelpPage::Style::man).text();
    refuse_name(name);
}

/// Writes all manual pages into a folder, under the names that man expects.
void write_manual(const std::string& folder) {
    write_text(folder + "/stipple.1", manual_page(""));
    for (const VerbInfo& info : verbs())
        write_text(fmt::format("{}/stipple-{}.1", folder, info.name), manual_page(info.name));
    for (const Topic& topic : topics())
        write_text(fmt::format("{}/stipple-{}.7", folder, topic.name), manual_page(topic.name));
}

}  // namespace

std::vector<std::string> explained_words() {
    std::vector<std::string> known;
    for (const Topic& topic : topics()) known.push_back(topic.name);
    for (const VerbInfo& info : verbs()) known.push_back(info.name);
    for (const Kind& kind : catalog())
        for (std::string& unit : names_of(kind)) known.push_back(std::move(unit));
    for (std::string& term : glossary_terms()) known.push_back(std::move(term));
    return known;
}

std::string help_text(const Arguments& arguments) {
    if (!arguments.verb) return page_of_program(HelpPage::Style::text).text();
    const VerbInfo& info = info_of(*arguments.verb);
    if (arguments.unit.empty()) return page_of_verb(info, HelpPage::Style::text).text();
    return page_of_unit(info, unit_of(info.name, arguments.unit)).text();
}

int HelpRequest::perform(Session&) const {
    if (man && inputs.size() > 1)
        fail(ErrorKind::usage, "help --man takes one word at most; {} are given", inputs.size());
    if (output && (!man || !inputs.empty()))
        fail(ErrorKind::usage, "--output: a folder is for all manual pages: help --man -o {}",
             *output);
    if (output) {
        write_manual(*output);
        return 0;
    }
    write_text("-", man ? manual_page(inputs.empty() ? "" : inputs[0]) : help_on(inputs));
    return 0;
}

}  // namespace stipple::cli
