// SPDX-License-Identifier: MIT
//
// Size of the terminal, and text wrapped to it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace stipple::cli {

struct TerminalSize {
    std::size_t columns = 80;
    std::size_t rows = 40;
};

/// Size of the terminal in letters; the defaults if standard output is not a terminal.
TerminalSize terminal_size();

/// Whether the environment allows colours: NO_COLOR is not set and TERM is not "dumb".
bool colours_wanted();

/// Columns of running text: the terminal's, up to a readable maximum.
std::size_t text_columns();

/// Wraps text to `columns` letters, at blanks and line ends and after '|'. Indents all lines except
/// the first by `indent` blanks; the first is assumed to be indented already. Adds no newline at
/// the end.
std::string filled(std::string_view text, std::size_t columns, std::size_t indent = 0);

/// A tag with wrapped text beside it, from column `indent`. If the tag is too long, the text is on
/// the next line. Ends with a newline.
std::string beside(std::string_view tag, std::string_view text, std::size_t columns,
                   std::size_t indent);

/// Wraps each paragraph, list item and row of a table. Does not change headings and lines indented
/// by four blanks.
std::string filled_page(std::string_view text, std::size_t columns);

}  // namespace stipple::cli
