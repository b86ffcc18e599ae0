// SPDX-License-Identifier: MIT
#include "cli/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "core/text.hpp"

namespace stipple::cli {
namespace {

/// Length of the list marker at the front of a line: "- ", "* " or "12. "; 0 for other lines.
std::size_t mark_of_item(std::string_view line) {
    if (line.starts_with("- ") || line.starts_with("* ")) return 2;
    const auto digits = std::min(line.find_first_not_of("0123456789"), line.size());
    return digits > 0 && line.substr(digits).starts_with(". ") ? digits + 2 : 0;
}

bool stands_as_it_is(std::string_view line) {
    return line.empty() || line.starts_with("    ") || line.starts_with('#') ||
           line.starts_with('|') || line.starts_with("<!--");
}

}  // namespace

TerminalSize terminal_size() {
    TerminalSize size;
    winsize found{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &found) != 0) return size;
    if (found.ws_col > 0) size.columns = found.ws_col;
    if (found.ws_row > 0) size.rows = found.ws_row;
    return size;
}

bool colours_wanted() {
    const char* const none = std::getenv("NO_COLOR");
    const char* const terminal = std::getenv("TERM");
    return (none == nullptr || *none == '\0') &&
           (terminal == nullptr || std::string_view(terminal) != "dumb");
}

std::size_t text_columns() {
    constexpr std::size_t most = 110;
    return std::min(terminal_size().columns, most);
}

std::string filled(std::string_view text, std::size_t columns, std::size_t indent) {
    std::string out;
    std::size_t used = indent;
    bool blank = false;  // a blank precedes the next word
    for (std::size_t at = 0; (at = text.find_first_not_of(" \n", at)) != text.npos;) {
        std::size_t end = std::min(text.find_first_of(" \n|", at), text.size());
        if (end < text.size() && text[end] == '|') ++end;  // a line may end after '|'
        const auto word = text.substr(at, end - at);
        const std::size_t letters = code_points(word).size() + (blank ? 1 : 0);
        if (!out.empty() && used + letters > columns) {
            out += "\n" + std::string(indent, ' ');
            used = indent + letters - (blank ? 1 : 0);
        } else {
            out += blank ? " " : "";
            used += letters;
        }
        out += word;
        at = end;
        blank = word.back() != '|' || (at < text.size() && text[at] == ' ');
    }
    return out;
}

std::string beside(std::string_view tag, std::string_view text, std::size_t columns,
                   std::size_t indent) {
    const std::size_t blanks = std::min(tag.find_first_not_of(' '), tag.size());
    const std::string front(blanks, ' ');
    if (tag.size() + 2 > indent)
        return front + filled(tag, columns, blanks + 4) + '\n' + std::string(indent, ' ') +
               filled(text, columns, indent) + '\n';
    return std::string(tag) + std::string(indent - tag.size(), ' ') +
           filled(text, columns, indent) + '\n';
}

std::string filled_page(std::string_view text, std::size_t columns) {
    std::string out;
    std::string part;  // lines of one paragraph or item
    const auto end_part = [&] {
        const std::size_t mark = mark_of_item(part);
        if (!part.empty())
            out += part.substr(0, mark) + filled(part.substr(mark), columns, mark) + "\n";
        part.clear();
    };
    for (const auto line : split(text.substr(0, text.find_last_not_of('\n') + 1), '\n')) {
        if (stands_as_it_is(line) || mark_of_item(line) > 0) end_part();
        if (stands_as_it_is(line))
            out += (line.starts_with('|') ? filled(line, columns, 4) : std::string(line)) + "\n";
        else
            part += std::string(line) + "\n";
    }
    end_part();
    return out;
}

}  // namespace stipple::cli
