// SPDX-License-Identifier: MIT
#include "cli/help/guide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "cli/help/plain_page.hpp"
#include "cli/terminal.hpp"
#include "core/bytes/compression.hpp"
#include "core/text.hpp"

namespace stipple::cli {
namespace {

std::string heading_of(std::string_view page) {
    return std::string(page.substr(2, page.find('\n') - 2));
}

std::string trimmed(std::string_view text) { return std::string(trim(text)); }

/// Page about other packages, with a section and a table for each.
constexpr std::string_view peers_page = "coming-from";

/// Page that lists the other ones, in groups.
constexpr std::string_view index_page = "index";

std::string_view text_of(const std::vector<GuidePage>& pages, std::string_view name) {
    return std::ranges::find(pages, name, &GuidePage::name)->text;
}

/// Whether the text contains `word` as a whole word: not next to a letter, digit or underscore.
bool has_word(std::string_view text, std::string_view word) {
    const auto joins = [&](std::size_t at) {
        return at < text.size() &&
               (text[at] == '_' || std::isalnum(static_cast<unsigned char>(text[at])));
    };
    for (auto at = text.find(word); at != text.npos; at = text.find(word, at + 1))
        if (!joins(at - 1) && !joins(at + word.size())) return true;
    return false;
}

/// Turns a table row `| THEIRS | OURS | NOTE |` into indented lines, with the note wrapped.
std::string row_as_text(std::string row) {
    replace_all(row, "\\|", "\1");
    std::string out;
    std::size_t indent = 4;
    for (const auto cell : split(std::string_view(row).substr(1), '|')) {
        std::string text = trimmed(cell);
        const bool code = text.starts_with('`');
        replace_all(text, "\1", "|");
        replace_all(text, "` `", "   # ");
        std::erase(text, '`');
        if (!text.empty())
            out += std::string(indent, ' ') + (code ? text : filled(text, 80, indent)) + "\n";
        indent = 8;
    }
    return out;
}

/// Plain text of the page about other packages, or of one of its sections.
std::string plain_peers(std::string_view markdown) {
    std::string text;
    for (const auto line : split(markdown, '\n')) {
        if (line.starts_with("| `"))
            text += row_as_text(std::string(line));
        else if (!line.starts_with('|') && !line.starts_with("<!--"))
            text += fmt::format("{}\n", line);
    }
    return plain_page(text);
}

/// Term of a paragraph of the glossary, `**term** (other name, other name): ...`, and its other
/// names, in lower case.
std::vector<std::string> terms_of(std::string_view paragraph) {
    const auto end = paragraph.find("**", 2);
    std::vector<std::string> terms = {lower_case(paragraph.substr(2, end - 2))};
    std::string_view rest = paragraph.substr(end + 2);
    if (rest.starts_with(" (") && rest.find("):") != rest.npos)
        for (const auto name : split(rest.substr(2, rest.find("):") - 2), ','))
            terms.push_back(lower_case(trim(name)));
    for (std::string& term : terms) std::erase(term, '`');
    return terms;
}

/// Paragraphs of the glossary, each with its terms.
std::vector<std::pair<std::vector<std::string>, std::string_view>> glossary() {
    std::vector<std::pair<std::vector<std::string>, std::string_view>> found;
    std::string_view rest = text_of(guide(), "glossary");
    while (!rest.empty()) {
        const auto end = std::min(rest.find("\n\n"), rest.size());
        const std::string_view paragraph = rest.substr(0, end);
        if (paragraph.starts_with("**")) found.emplace_back(terms_of(paragraph), paragraph);
        rest.remove_prefix(std::min(end + 2, rest.size()));
    }
    return found;
}

}  // namespace

std::vector<TopicGroup> topic_groups() {
    std::vector<TopicGroup> groups;
    for (const auto line : split(text_of(guide(), index_page), '\n')) {
        if (line.starts_with("## ")) groups.push_back({std::string(line.substr(3)), {}});
        const auto link = line.find("](");
        if (groups.empty() || !line.starts_with("- [") || link == line.npos) continue;
        const std::string_view file = line.substr(link + 2, line.find(')', link) - link - 2);
        const std::string_view name = file.substr(0, file.find(".md"));
        const auto topic = std::ranges::find(topics(), name, &Topic::name);
        if (topic != topics().end()) groups.back().topics.push_back(&*topic);
    }
    std::erase_if(groups, [](const TopicGroup& group) { return group.topics.empty(); });
    return groups;
}

std::vector<std::string> glossary_terms() {
    std::vector<std::string> all;
    for (const auto& [terms, paragraph] : glossary())
        all.insert(all.end(), terms.begin(), terms.end());
    return all;
}

std::string glossary_entry(std::string_view word) {
    const std::string wanted = lower_case(word);
    const auto matches = [&](const std::string& term) {
        return term == wanted || term + 's' == wanted;
    };
    for (const auto& [terms, paragraph] : glossary())
        if (std::ranges::any_of(terms, matches)) return plain_page(paragraph);
    return {};
}

const std::vector<GuidePage>& guide() {
    static const std::string text = [] {
        auto [bytes, size] = compressed_topics();
        std::string all(size, '\0');
        Decompressor(
            Compression::zstd, [&left = bytes] { return std::exchange(left, {}); }, "guide")
            .read(all);
        return all;
    }();
    static const auto pages = [] {
        std::vector<GuidePage> found;
        for (const auto page : split(std::string_view(text).substr(1), '\1')) {
            const auto end = page.find('\n');
            found.push_back({page.substr(0, end), page.substr(end + 1)});
        }
        return found;
    }();
    return pages;
}

const std::vector<Topic>& topics() {
    static const auto all = [] {
        std::vector<Topic> found;
        for (const GuidePage& page : guide())
            if (page.name != index_page)
                found.push_back(
                    {std::string(page.name), heading_of(page.text),
                     page.name == peers_page ? plain_peers(page.text) : plain_page(page.text)});
        return found;
    }();
    return all;
}

std::string coming_from(std::string_view name) {
    std::string word = lower_case(name);
    word.erase(0, word.rfind('.') + 1);  // qmc.Halton becomes halton
    const bool is_name = word.size() > 1 && std::isalpha(static_cast<unsigned char>(word[0])) != 0;
    if (!is_name) return {};
    std::string found;
    std::string_view rest = text_of(guide(), peers_page);
    rest = rest.substr(0, rest.rfind("<!--"));
    constexpr std::string_view mark = "\n## ";
    for (auto at = rest.find(mark); at != rest.npos; at = rest.find(mark)) {
        rest.remove_prefix(at + mark.size());
        const std::string_view section = rest.substr(0, rest.find(mark));
        const std::string heading(section.substr(0, section.find('\n')));
        std::string rows;
        for (const auto line : split(section, '\n'))
            if (line.starts_with("| `") &&
                has_word(lower_case(line.substr(0, line.find("` | `"))), word))
                rows += row_as_text(std::string(line));
        if (has_word(lower_case(heading), word))
            found += plain_peers(section);
        else if (!rows.empty())
            found += fmt::format("{}\n{}", heading, rows);
    }
    return found;
}

std::string python_section(std::string_view name) {
    std::string_view rest = text_of(guide(), "python");
    const std::string word = lower_case(name.substr(name.find_last_of(". ") + 1));
    while (word.size() > 1 && !rest.empty()) {
        const auto end = std::min(rest.find("\n## ", 1), rest.size());
        const std::string_view section = trim(rest.substr(0, end));
        bool code = false;
        for (const auto piece : split(section, '`')) {
            if (code && piece.find('\n') == piece.npos && has_word(lower_case(piece), word))
                return plain_page(section) + "\n\n'stipple help python' is the whole page.\n";
            code = !code;
        }
        rest.remove_prefix(end);
    }
    return {};
}

VerbPage verb_page(const std::string& verb) {
    const std::string_view all = text_of(verb_pages(), "verbs/" + verb);
    const std::string_view usage = all.substr(all.find("\n\n    ") + 2);
    const std::string_view rest = usage.substr(usage.find("\n\n"));
    constexpr std::string_view examples = "\n\n## Examples\n\n";
    const auto end = rest.find(examples);
    VerbPage found{.summary = heading_of(all).substr(verb.size() + 2),
                   .usage = trimmed(usage.substr(0, usage.find('\n'))),
                   .text = trimmed(rest.substr(0, end)),
                   .examples = {}};
    for (const auto line : split(rest.substr(end + examples.size()), '\n'))
        if (!trim(line).empty()) found.examples += trimmed(line) + "\n";
    return found;
}

}  // namespace stipple::cli
