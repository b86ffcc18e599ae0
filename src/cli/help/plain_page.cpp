// SPDX-License-Identifier: MIT
#include "cli/help/plain_page.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <optional>

#include "core/text.hpp"

namespace stipple::cli {
namespace {

/// A link or picture at the start of a text: its words, target, and number of characters.
struct Link {
    std::string_view words;
    std::string_view target;
    std::size_t length;
};

std::optional<Link> link_at(std::string_view text) {
    if (!text.starts_with('[')) return std::nullopt;
    int depth = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        depth += text[at] == '[' ? 1 : text[at] == ']' ? -1 : 0;
        if (depth > 0) continue;
        if (!text.substr(at + 1).starts_with('(')) return std::nullopt;
        const std::size_t end = text.find(')', at);
        if (end == text.npos) return std::nullopt;
        return Link{text.substr(1, at - 1), text.substr(at + 2, end - at - 2), end + 1};
    }
    return std::nullopt;
}

/// Name of the page that a link leads to; empty for other targets.
std::string_view page_of(std::string_view target) {
    const std::string_view file = target.substr(0, target.find('#'));
    return file.ends_with(".md") && file.find('/') == file.npos ? file.substr(0, file.size() - 3)
                                                                : std::string_view();
}

std::string quoted_code(std::string_view code) {
    return code.find_first_of(" \n") == code.npos ? std::string(code) : fmt::format("'{}'", code);
}

/// Length of the emphasised words, `*words*`, at the front of a text; 0 if there are none, also if
/// the text begins with the sign of a product.
std::size_t emphasis_at(std::string_view text) {
    const auto end = text.find('*', 2);
    const bool marked = text.starts_with('*') && end != text.npos &&
                        text.find_first_of(" *\n", 1) != 1 && text[end - 1] != ' ';
    return marked ? end + 1 : 0;
}

/// A paragraph, heading, item or table without the marks of Markdown.
std::string plain_prose(std::string_view text) {
    const bool leads_on = text.starts_with("Read on:");
    std::string out;
    while (!text.empty()) {
        const bool picture = text.starts_with("![");
        std::size_t used = 1;
        if (const auto link = link_at(text.substr(picture ? 1 : 0))) {
            const std::string_view page = page_of(link->target);
            const bool named = !page.empty() && trim(out).ends_with("See");
            if (leads_on && !page.empty())
                out += fmt::format("'stipple help {}'", page);
            else if (!picture)
                out += plain_prose(link->words);
            if (named) out += fmt::format(" ('stipple help {}')", page);
            used = link->length + (picture ? 1 : 0);
        } else if (text.starts_with("**")) {
            used = 2;
        } else if (const auto length = emphasis_at(text); length > 0) {
            out += plain_prose(text.substr(1, length - 2));
            used = length;
        } else if (const auto end = text.find('`', 1); text[0] == '`' && end != text.npos) {
            out += quoted_code(text.substr(1, end - 1));
            used = end + 1;
        } else {
            out += text[0];
        }
        text.remove_prefix(used);
    }
    return out;
}

/// Collects the blocks of a page: prose, which ends at an empty line, and code.
class PlainPage {
  public:
    void add(std::string_view line) {
        if (line.starts_with("```")) {
            end_prose();
            in_code_ = !in_code_;
        } else if (in_code_) {
            out_ += line.empty() ? "\n" : fmt::format("    {}\n", line);
        } else if (line.starts_with("<!-- ")) {
            end_prose();
            in_table_ = line.starts_with("<!-- stipple ") || line.starts_with("<!-- scripts/");
            constexpr std::string_view units = "<!-- scripts/guide --table ";
            if (line.starts_with(units))
                out_ +=
                    fmt::format("    stipple list {}\n", split(line.substr(units.size()), ' ')[0]);
        } else if (line.empty() || line.starts_with("    ")) {
            end_prose();
            add_line(line);
        } else if (!in_table_) {
            prose_ += fmt::format("{}\n", line);
        }
    }

    std::string text() {
        end_prose();
        return out_.substr(0, out_.find_last_not_of('\n') + 1) + "\n";
    }

  private:
    void end_prose() {
        const std::string plain = plain_prose(prose_);
        if (!trim(plain).empty()) out_ += plain;
        prose_.clear();
    }

    /// Adds a line, except an empty line after an empty line, as a removed picture leaves it.
    void add_line(std::string_view line) {
        if (!line.empty() || !out_.ends_with("\n\n")) out_ += fmt::format("{}\n", line);
    }

    std::string out_;
    std::string prose_;
    bool in_code_ = false;
    bool in_table_ = false;
};

}  // namespace

std::string plain_page(std::string_view page) {
    PlainPage plain;
    for (const auto line : split(page, '\n')) plain.add(line);
    return plain.text();
}

}  // namespace stipple::cli
