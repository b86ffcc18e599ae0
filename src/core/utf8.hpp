// SPDX-License-Identifier: MIT
//
// UTF-8 taken apart and put together, and text from strangers (files, arguments, other programs) as
// messages, tables, pictures and pages show it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace stipple {

struct Letter {
    char32_t point;    ///< U+FFFD where the bytes are no letter
    std::size_t size;  ///< bytes
    bool valid = true;
};

/// The letter at the front of a text that is not empty; one byte where there is none.
Letter first_letter(std::string_view text);

/// Code points of UTF-8; bytes that are none become U+FFFD.
std::u32string code_points(std::string_view text);

/// The way back.
void append_utf8(std::string& out, char32_t letter);
std::string utf8_of(std::u32string_view letters);

/// The text on one line, with nothing that a terminal obeys: control characters, those that turn the
/// direction of writing, and bytes that are not UTF-8 as \n, \x1b, \u202e, \xff.
std::string printable(std::string_view text);

/// The text with words of more than 1000 bytes, and what is behind 8000 bytes, cut short: messages
/// repeat what somebody gave.
std::string cut_short(std::string_view text);

/// Such a text in quotes, with its number of bytes where only its first 80 letters are shown.
std::string shown(std::string_view text);

}  // namespace stipple
