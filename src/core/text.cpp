// SPDX-License-Identifier: MIT
#include "core/text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <boost/locale/utf.hpp>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace stipple {
namespace {

template <class T>
std::optional<T> parse_whole(std::string_view text, int base = 10) {
    T value{};
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value, base);
    if (error != std::errc() || stopped != end) return std::nullopt;
    return value;
}

/// Parses a number and multiplies it; nullopt if the result is not whole, or not in [0, 2^64).
std::optional<std::uint64_t> scaled(std::string_view text, double factor) {
    const auto value = parse_number(text);
    const double product = value.value_or(-1) * factor;
    if (product != std::floor(product) || product < 0 || product >= 0x1p64) return std::nullopt;
    return static_cast<std::uint64_t>(product);
}

std::optional<std::uint64_t> power(std::string_view base_text, std::string_view exponent_text) {
    const auto base = parse_whole<std::uint64_t>(base_text);
    const auto exponent = parse_whole<std::uint32_t>(exponent_text);
    if (!base || !exponent) return std::nullopt;
    const std::uint32_t factors = *base > 1 ? *exponent : std::min(*exponent, 1U);
    std::uint64_t value = 1;
    for (std::uint32_t i = 0; i < factors; ++i)
        if (__builtin_mul_overflow(value, *base, &value)) return std::nullopt;
    return value;
}

/// Factor of a size suffix (k, M, G, T); 0 for other characters.
double suffix_factor(char suffix) {
    constexpr std::string_view letters = "KMGT";
    const auto place = letters.find(suffix == 'k' ? 'K' : suffix);
    return place == letters.npos ? 0 : std::ldexp(1.0, 10 * static_cast<int>(place + 1));
}

/// A whole number in one of the notations: 1000, 1e6, 2^20 or 64k.
std::optional<std::uint64_t> magnitude(std::string_view text) {
    if (const auto caret = text.find('^'); caret != std::string_view::npos)
        return power(text.substr(0, caret), text.substr(caret + 1));
    if (const auto plain = parse_whole<std::uint64_t>(text)) return plain;
    const double factor = text.empty() ? 0 : suffix_factor(text.back());
    return factor != 0 ? scaled(text.substr(0, text.size() - 1), factor) : scaled(text, 1);
}

/// Smallest number of edits that turn a into b; an edit inserts, deletes or replaces a letter, or
/// swaps two neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before;  // row of the prefix of `a` two letters shorter
    std::vector<std::size_t> last;
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        before = std::exchange(last, row);
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            row[j + 1] = std::min({last[j] + (a[i] != b[j]), row[j] + 1, last[j + 1] + 1});
            if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j])
                row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
        }
    }
    return row.back();
}

}  // namespace

std::optional<std::int64_t> parse_integer(std::string_view text) {
    const bool minus = text.starts_with('-');
    if (text.starts_with("-+") || (minus && text.find('^') != text.npos)) return std::nullopt;
    const auto size = magnitude(text.substr(minus ? 1 : 0));
    constexpr std::uint64_t most = std::uint64_t{1} << 63;
    if (!size || *size > (minus ? most : most - 1)) return std::nullopt;
    return static_cast<std::int64_t>(minus ? 0 - *size : *size);
}

std::optional<std::uint64_t> parse_unsigned(std::string_view text) {
    if (text.starts_with("0x") || text.starts_with("0X"))
        return parse_whole<std::uint64_t>(text.substr(2), 16);
    return magnitude(text);
}

std::optional<double> parse_number(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stopped != end || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::optional<std::uint64_t> parse_bytes(std::string_view text) {
    if (text.ends_with('B')) text.remove_suffix(text.ends_with("iB") ? 2 : 1);
    if (text.empty()) return std::nullopt;
    const double factor = suffix_factor(text.back());
    const auto value = parse_number(factor != 0 ? text.substr(0, text.size() - 1) : text);
    if (!value || *value < 0) return std::nullopt;
    const double bytes = *value * (factor != 0 ? factor : 1);
    if (bytes >= 0x1p63) return std::nullopt;
    return static_cast<std::uint64_t>(bytes);
}

std::string format_number(double value) { return fmt::format("{}", value); }

std::string format_bytes(double bytes) {
    constexpr std::array units = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    std::size_t unit = 0;
    // 1000 and above would be written as 1e+03, and 999.5 rounds to 1000.
    while (bytes >= (unit == 0 ? 1024 : 999.5) && unit + 1 < units.size()) {
        bytes /= 1024;
        ++unit;
    }
    return fmt::format("{:.{}g} {}", bytes, unit == 0 ? 4 : 3, units[unit]);
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (!text.empty()) {
        const auto at = text.find(separator);
        parts.push_back(text.substr(0, at));
        if (at == std::string_view::npos) return parts;
        text.remove_prefix(at + 1);
        if (text.empty()) parts.emplace_back();
    }
    return parts;
}

std::vector<std::string_view> split_outside(std::string_view brackets, std::string_view text,
                                            std::string_view separator) {
    std::vector<std::string_view> parts;
    std::size_t begin = 0;
    int open = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        open += text[i] == brackets[0] ? 1 : text[i] == brackets[1] ? -1 : 0;
        if (open > 0 || !text.substr(i).starts_with(separator)) continue;
        parts.push_back(text.substr(begin, i - begin));
        begin = i + separator.size();
    }
    if (!text.empty()) parts.push_back(text.substr(begin));
    return parts;
}

std::string join(std::span<const std::string> words, std::string_view between) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += between;
        text += words[i];
    }
    return text;
}

std::string join(std::span<const double> numbers, std::string_view between) {
    std::vector<std::string> words;
    for (const double number : numbers) words.push_back(format_number(number));
    return join(words, between);
}

std::string lower_case(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

std::string capitalised(std::string text) {
    if (!text.empty())
        text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

std::string_view trim(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n\v\f";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string> nearest_words(std::string_view word, std::span<const std::string> known) {
    constexpr std::size_t most = 3;
    const std::string wanted = lower_case(word);
    const std::size_t limit = std::max<std::size_t>(2, wanted.size() / 3);
    std::vector<std::pair<std::size_t, std::string>> near;
    for (const std::string& candidate : known) {
        const std::string letters = lower_case(candidate);
        const bool begins = wanted.size() >= 3 && letters.starts_with(wanted);
        const std::size_t distance = begins ? 1 : edit_distance(wanted, letters);
        if (distance <= limit && distance < candidate.size())
            near.emplace_back(distance, candidate);
    }
    std::ranges::stable_sort(near, {}, &std::pair<std::size_t, std::string>::first);
    std::vector<std::string> words;
    for (auto& [distance, candidate] : near)
        if (words.size() < most && distance == near[0].first &&
            std::ranges::find(words, candidate) == words.end())
            words.push_back(candidate);
    return words;
}

std::string quoted_list(std::vector<std::string> words, std::string_view last) {
    for (std::string& word : words) word = "'" + word + "'";
    if (words.size() < 2) return join(words, "");
    const std::string end = words.back();
    words.pop_back();
    return fmt::format("{} {} {}", join(words, ", "), last, end);
}

std::string suggest(std::string_view word, std::span<const std::string> known) {
    if (const auto meant = nearest_words(word, known); !meant.empty())
        return fmt::format("did you mean {}?", quoted_list(meant, "or"));
    return fmt::format("known: {}", join(known, ", "));
}

namespace {

using Utf8 = boost::locale::utf::utf_traits<char>;

/// Whether a terminal would interpret the letter instead of showing it: control characters, line
/// ends, marks that change the direction of writing, and noncharacters.
bool is_obeyed(char32_t letter) {
    const auto in = [letter](char32_t low, char32_t high) {
        return letter >= low && letter <= high;
    };
    return letter < 0x20 || in(0x7F, 0x9F) || in(0x200E, 0x200F) || in(0x2028, 0x202E) ||
           in(0x2066, 0x2069) || letter == 0xFEFF || in(0xFFFE, 0xFFFF);
}

void append_escaped(std::string& out, char32_t letter) {
    const auto code = static_cast<std::uint32_t>(letter);
    if (letter == U'\n')
        out += "\\n";
    else if (letter == U'\r')
        out += "\\r";
    else if (letter == U'\t')
        out += "\\t";
    else if (code < 0x80)
        out += fmt::format("\\x{:02x}", code);
    else
        out += fmt::format("\\u{:04x}", code);
}

/// The front of a text, up to the maximum number of letters shown in messages.
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
            out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
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

std::string shell_word(const std::string& word) {
    constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+,./:@%^";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string quoted = word;
    replace_all(quoted, "'", "'\\''");
    return "'" + quoted + "'";
}

std::string shown(std::string_view text) {
    const std::string_view front = front_of(text);
    if (front.size() == text.size()) return "'" + printable(text) + "'";
    return fmt::format("'{}...' ({} bytes)", printable(front), text.size());
}

}  // namespace stipple
