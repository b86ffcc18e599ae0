// SPDX-License-Identifier: MIT
//
// Parsing, formatting and quoting of text: numbers, sizes, names, UTF-8.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stipple {

/// Parses a whole number: 1000, 1e6, 2^20, 64k (= 65536), 3M, 1G. Returns nullopt if the text is
/// not one, or if it does not fit into 64 signed bits.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// As parse_integer, for 64 unsigned bits such as a seed; also accepts 0x hexadecimal.
std::optional<std::uint64_t> parse_unsigned(std::string_view text);

/// Parses a finite decimal number; nullopt unless the whole text is one.
std::optional<double> parse_number(std::string_view text);

/// Parses a size in bytes: 500000, 64k, 2G, 1.5G; nullopt if the text is not one.
std::optional<std::uint64_t> parse_bytes(std::string_view text);

/// The shortest text that reads back to the same double.
std::string format_number(double value);

/// Formats a size: 1536 -> "1.5 KiB".
std::string format_bytes(double bytes);

void replace_all(std::string& text, std::string_view from, std::string_view to);

/// Parts between separators; "a,b" -> {"a", "b"}, "" -> {}.
std::vector<std::string_view> split(std::string_view text, char separator);

/// As split(), but ignores separators in brackets; with "()", "1,min(2,3)" -> {"1", "min(2,3)"}.
std::vector<std::string_view> split_outside(std::string_view brackets, std::string_view text,
                                            std::string_view separator);

std::string join(std::span<const std::string> words, std::string_view between);
/// Joins numbers, written as by format_number().
std::string join(std::span<const double> numbers, std::string_view between);

/// Joins whole numbers in a list of type List.
template <class List>
requires std::integral<typename List::value_type> std::string join(const List& numbers,
                                                                   std::string_view between) {
    std::string text;
    for (const auto number : numbers) {
        if (!text.empty()) text += between;
        text += std::to_string(number);
    }
    return text;
}

std::string capitalised(std::string text);

/// Converts ASCII capitals to lower case.
std::string lower_case(std::string_view text);

std::string_view trim(std::string_view text);

/// Returns up to three words of `known` of which `word` may be a misspelling; case is ignored.
std::vector<std::string> nearest_words(std::string_view word, std::span<const std::string> known);

/// Formats {a, b, c} as "'a', 'b' or 'c'"; `last` is the word before the last item ("or").
std::string quoted_list(std::vector<std::string> words, std::string_view last);

/// Returns "did you mean 'halton'?" if known words are near enough, otherwise a list of all known
/// words.
std::string suggest(std::string_view word, std::span<const std::string> known);

// UTF-8, and untrusted text (from files, arguments, other programs) made safe for messages, tables,
// pictures and pages.

struct Letter {
    char32_t point;    ///< U+FFFD if the bytes are not valid UTF-8
    std::size_t size;  ///< in bytes
    bool valid = true;
};

/// Decodes the first letter of a text that is not empty; an invalid byte counts as one letter.
Letter first_letter(std::string_view text);

/// Code points of UTF-8 text; each invalid byte becomes U+FFFD.
std::u32string code_points(std::string_view text);

/// Encodes code points as UTF-8.
void append_utf8(std::string& out, char32_t letter);
std::string utf8_of(std::u32string_view letters);

/// Makes text safe for a terminal, on one line: escapes control characters, marks that change the
/// direction of writing, and invalid UTF-8 as \n, \x1b, \u202e, \xff.
std::string printable(std::string_view text);

/// Shortens words of more than 1000 bytes, and texts of more than 8000, for messages.
std::string cut_short(std::string_view text);

/// A word quoted for a shell if necessary.
std::string shell_word(const std::string& word);

/// Quotes and escapes untrusted text for a message. A text of more than 80 letters is cut off, and
/// its size in bytes is added.
std::string shown(std::string_view text);

}  // namespace stipple
