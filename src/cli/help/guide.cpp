// SPDX-License-Identifier: MIT
#include "cli/help/guide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "core/text.hpp"

namespace stipple::cli {
namespace {

std::string heading_of(std::string_view page) {
    return std::string(page.substr(2, page.find('\n') - 2));
}

std::string trimmed(std::string_view text) { return std::string(trim(text)); }

/// Page about other packages, with one table each.
constexpr std::string_view peers_page = "coming-from";

std::string_view text_of(std::string_view name) {
    return std::ranges::find_if(guide(), [&](const GuidePage& page) { return page.name == name; })
        ->text;
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

/// Turns a table row `| THEIRS | OURS | NOTE |` into one line per cell.
std::string row_as_text(std::string row) {
    replace_all(row, "\\|", "\1");
    std::string out;
    std::string_view indent = "  ";
    for (const auto cell : split(std::string_view(row).substr(1), '|')) {
        std::string text = trimmed(cell);
        replace_all(text, "\1", "|");
        replace_all(text, "` `", "   # ");
        std::erase(text, '`');
        if (!text.empty()) out += fmt::format("{}{}\n", indent, text);
        indent = "      ";
    }
    return out;
}

}  // namespace

const std::vector<Topic>& topics() {
    static const auto all = [] {
        std::vector<Topic> found;
        for (const GuidePage& page : guide())
            if (!std::string_view(page.name).starts_with("verbs/") && page.name != peers_page)
                found.push_back({page.name, heading_of(page.text), page.text});
        return found;
    }();
    return all;
}

std::string coming_from(std::string_view name) {
    std::string word = lower_case(name);
    if (const auto dot = word.rfind('.'); dot != word.npos && word != peers_page)
        word.erase(0, dot + 1);
    const bool is_name = word.size() > 1 && std::isalpha(static_cast<unsigned char>(word[0])) != 0;
    if (!is_name) return {};
    std::string found;
    std::string heading;
    bool all = false;
    for (const auto line : split(text_of(peers_page), '\n')) {
        if (line.starts_with("## ")) {
            heading = line.substr(3);
            all = word == peers_page || has_word(lower_case(heading), word);
            if (all) found += heading + "\n";
        } else if (line.starts_with("| `")) {
            const bool asked = has_word(lower_case(line.substr(0, line.find("` | `"))), word);
            if (asked && !all && !heading.empty()) found += std::exchange(heading, "") + "\n";
            if (asked || all) found += row_as_text(std::string(line));
        } else if (all && !line.empty() && !line.starts_with("|") && !line.starts_with("<!--")) {
            found += fmt::format("  {}\n", line);
        }
    }
    return found;
}

VerbPage verb_page(const std::string& verb) {
    const std::string_view all = text_of("verbs/" + verb);
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
