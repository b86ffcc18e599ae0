// SPDX-License-Identifier: MIT
//
// Numbers, sizes and names as people write them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stipple {

/// A whole number: 1000, 1e6, 2^20, 64k (= 65536), 3M, 1G; nothing when it is not one.
/// A number that does not fit 64 signed bits gives nothing, too.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// As parse_integer, for the 64 unsigned bits of a seed; also 0x hexadecimal.
std::optional<std::uint64_t> parse_unsigned(std::string_view text);

/// A finite decimal number, or nothing; the whole text must be one.
std::optional<double> parse_number(std::string_view text);

/// A size in bytes: 500000, 64k, 2G, 1.5G; nothing when it is not one.
std::optional<std::uint64_t> parse_bytes(std::string_view text);

/// The shortest text that reads back to the same double.
std::string format_number(double value);

/// 1536 -> "1.5 KiB".
std::string format_bytes(double bytes);

/// Puts `to` wherever `from` stands.
void replace_all(std::string& text, std::string_view from, std::string_view to);

/// Parts between separators; "a,b" -> {"a", "b"}, "" -> {}.
std::vector<std::string_view> split(std::string_view text, char separator);

/// The same, less separators in parentheses: "1,min(2,3)" -> {"1", "min(2,3)"}.
std::vector<std::string_view> split_formulas(std::string_view text, char separator);

std::string join(std::span<const std::string> words, std::string_view between);

/// The text with a capital letter at its front.
std::string capitalised(std::string text);

/// The text with the capital letters of ASCII made small.
std::string lower_case(std::string_view text);

/// The text without white space at its ends.
std::string_view trim(std::string_view text);

/// The words of `known` that are nearest to `word`, three at most, if they are near enough to be
/// meant. Capital letters count as small ones.
std::vector<std::string> nearest_words(std::string_view word, std::span<const std::string> known);

/// "'a', 'b' or 'c'", the last behind that word.
std::string quoted_list(std::vector<std::string> words, std::string_view last);

/// "did you mean 'halton'?" for a word near enough to known ones, else a sentence that lists them.
std::string suggest(std::string_view word, std::span<const std::string> known);

// UTF-8 taken apart and put together, and text from strangers (files, arguments, other programs) as
// messages, tables, pictures and pages show it.

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
