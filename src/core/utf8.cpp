// SPDX-License-Identifier: MIT
#include "core/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/locale/utf.hpp>
#include <iterator>

namespace stipple {
namespace {

using Utf8 = boost::locale::utf::utf_traits<char>;

/// Ends of lines, marks that turn the direction of writing, and what is no letter.
bool is_obeyed(char32_t letter) {
    const auto in = [letter](char32_t low, char32_t high) {
        return letter >= low && letter <= high;
    };
    return letter < 0x20 || in(0x7F, 0x9F) || in(0x200E, 0x200F) || in(0x2028, 0x202E) ||
           in(0x2066, 0x2069) || letter == 0xFEFF || in(0xFFFE, 0xFFFF);
}

void append_escaped(std::string& out, char32_t letter) {
    const auto code = static_cast<std::uint32_t>(letter);
    const auto end = std::back_inserter(out);
    if (letter == U'\n')
        out += "\\n";
    else if (letter == U'\r')
        out += "\\r";
    else if (letter == U'\t')
        out += "\\t";
    else if (code < 0x80)
        fmt::format_to(end, "\\x{:02x}", code);
    else
        fmt::format_to(end, "\\u{:04x}", code);
}

/// The first letters, as many as a message shows of a text.
std::string_view front_of(std::string_view text) {
    constexpr std::size_t most = 80;
    std::size_t bytes = 0;
    for (std::size_t letters = 0; letters < most && bytes < text.size(); ++letters)
        bytes += first_letter(text.substr(bytes)).size;
    return text.substr(0, bytes);
}

}  // namespace

Letter first_letter(std::string_view text) {
    const char* at = text.data();
    const auto letter = Utf8::decode(at, text.data() + text.size());
    if (!boost::locale::utf::is_valid_codepoint(letter)) return {U'\uFFFD', 1, false};
    return {letter, static_cast<std::size_t>(at - text.data())};
}

std::u32string code_points(std::string_view text) {
    std::u32string letters;
    while (!text.empty()) {
        const Letter letter = first_letter(text);
        letters += letter.point;
        text.remove_prefix(letter.size);
    }
    return letters;
}

void append_utf8(std::string& out, char32_t letter) {
    Utf8::encode(letter, std::back_inserter(out));
}

std::string utf8_of(std::u32string_view letters) {
    std::string out;
    for (const char32_t letter : letters) append_utf8(out, letter);
    return out;
}

std::string printable(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const Letter letter = first_letter(text);
        if (!letter.valid)
            fmt::format_to(std::back_inserter(out), "\\x{:02x}",
                           static_cast<unsigned char>(text[0]));
        else if (is_obeyed(letter.point))
            append_escaped(out, letter.point);
        else
            out += text.substr(0, letter.size);
        text.remove_prefix(letter.size);
    }
    return out;
}

std::string cut_short(std::string_view text) {
    constexpr std::size_t longest_word = 1000;
    constexpr std::size_t longest_text = 8000;
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size() - 1) + 1;
        const std::string_view word = text.substr(at, end - at);
        if (out.size() > longest_text) return out + fmt::format("... ({} bytes)", text.size());
        if (word.size() <= longest_word)
            out += word;
        else
            out += fmt::format("{}... ({} bytes) ", front_of(word), word.size());
        at = end;
    }
    return out;
}

std::string shown(std::string_view text) {
    const std::string_view front = front_of(text);
    if (front.size() == text.size()) return "'" + printable(text) + "'";
    return fmt::format("'{}...' ({} bytes)", printable(front), text.size());
}

}  // namespace stipple
