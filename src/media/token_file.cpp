// SPDX-License-Identifier: MIT
#include "media/token_file.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "core/bytes/file_bytes.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Appends the limits to `what`: "a number in [low, high]".
std::string expected(std::string_view what, std::uint64_t low, std::uint64_t high) {
    if (low == high) return fmt::format("{}, {}", what, low);
    if (high != ~std::uint64_t{0}) return fmt::format("{} in [{}, {}]", what, low, high);
    return low > 0 ? fmt::format("{}, at least {}", what, low) : std::string(what);
}

}  // namespace

TokenFile::TokenFile(const std::string& path) : TokenFile(read_file(path), path) {}

TokenFile::TokenFile(std::string bytes, std::string name)
    : name_(std::move(name)), bytes_(std::move(bytes)) {
    if (bytes_.starts_with("\xEF\xBB\xBF")) bytes_.erase(0, 3);
    pass_blanks();
    front_ = at_;
}

bool TokenFile::is_headed(std::string_view words) const {
    const auto lines = split(std::string_view(bytes_).substr(0, front_), '\n');
    return std::ranges::any_of(lines,
                               [&](std::string_view line) { return line.starts_with(words); });
}

bool TokenFile::comment_has(std::string_view words) const {
    const auto line = std::string_view(bytes_).substr(at_, bytes_.find('\n', at_) - at_);
    const auto comment = line.find('#');
    return comment != std::string_view::npos && line.find(words, comment) != std::string_view::npos;
}

void TokenFile::pass_blanks() {
    for (; at_ != bytes_.size(); ++at_) {
        if (bytes_[at_] == '#') at_ = std::min(bytes_.find('\n', at_), bytes_.size());
        if (at_ == bytes_.size() || !is_blank(bytes_[at_])) return;
        if (bytes_[at_] == '\n') {
            ++line_;
            line_begin_ = at_ + 1;
        }
    }
}

Token TokenFile::peek() const {
    const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(at_);
    const auto end =
        std::find_if(begin, bytes_.end(), [](char c) { return is_blank(c) || c == '#'; });
    Token token = here();
    token.text = {begin, end};
    return token;
}

Token TokenFile::next(std::string_view what) {
    const Token token = peek();
    if (token.text.empty()) refuse(token, fmt::format("the file ends here; expected {}", what));
    last_line_ = line_;
    last_end_ = token.column + token.text.size();
    at_ += token.text.size();
    pass_blanks();
    return token;
}

std::uint64_t TokenFile::number(std::string_view what, std::uint64_t low, std::uint64_t high) {
    const Token token = next(expected(what, low, high));
    const char* const last = token.text.data() + token.text.size();
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(token.text.data(), last, value);
    if (end != last || error == std::errc::invalid_argument)
        refuse(token, fmt::format("{} is not a whole number; expected {}", shown(token.text),
                                  expected(what, low, high)));
    if (error == std::errc::result_out_of_range || value < low || value > high)
        refuse(token, fmt::format("{} is out of range; expected {}", shown(token.text),
                                  expected(what, low, high)));
    return value;
}

Token TokenFile::next_on_line(std::string_view what) {
    if (line_is_short()) refuse_short(what);
    return next(what);
}

std::uint64_t TokenFile::number_on_line(std::string_view what, std::uint64_t low,
                                        std::uint64_t high) {
    if (line_is_short()) refuse_short(expected(what, low, high));
    return number(what, low, high);
}

void TokenFile::refuse_short(std::string_view what) const {
    refuse({{}, last_line_, last_end_}, fmt::format("the line ends here; expected {}", what));
}

void TokenFile::expect_line_end() const {
    if (at_line_end()) return;
    const Token token = peek();
    refuse(token, fmt::format("unexpected {}; expected the end of the line", shown(token.text)));
}

void TokenFile::skip_line() {
    if (at_end()) return;
    do next("a line");
    while (!at_line_end());
}

void TokenFile::refuse(const Token& at, const std::string& what) const {
    fail(ErrorKind::input, "{}:{}:{}: {}", name_, at.line, at.column, what);
}

void TokenFile::refuse_whole(const std::string& what) const {
    fail(ErrorKind::input, "{}: {}", name_, what);
}

}  // namespace stipple
