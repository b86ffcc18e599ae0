// SPDX-License-Identifier: MIT
//
// The terminal that standard output is, and texts that fit it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace stipple::cli {

struct TerminalSize {
    std::size_t columns = 80;
    std::size_t rows = 40;
};

/// The size of the terminal in letters; the defaults where standard output is none.
TerminalSize terminal_size();

/// Whether the environment lets programs write in colours: NO_COLOR is not set.
bool colours_wanted();

/// Columns of running text: the terminal's, but no more than can be read well.
std::size_t text_columns();

/// The words of a text in lines of `columns` letters, none broken but behind a '|', its own ends of
/// lines gone. All lines but the first begin with `indent` blanks, which the first is taken to have before it.
/// Without an end of line.
std::string filled(std::string_view text, std::size_t columns, std::size_t indent = 0);

/// A tag with its text beside it, filled, which begins in the column `indent`; on the next line
/// where the tag is longer. With an end of line.
std::string beside(std::string_view tag, std::string_view text, std::size_t columns,
                   std::size_t indent);

/// The paragraphs of a text, filled each by itself, and the items of its lists; lines that begin
/// with four blanks, headings and tables stand as they are.
std::string filled_page(std::string_view text, std::size_t columns);

}  // namespace stipple::cli
