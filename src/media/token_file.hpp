// SPDX-License-Identifier: MIT
//
// Reader for text files of words and whole numbers separated by white space; `#` starts a comment
// up to the end of its line.
//
//     TokenFile file("joe-kuo.txt");
//     while (!file.at_end()) {
//         const auto d = file.number("a dimension", 2, 21201);
//         ...
//     }
//
// Promise  every error names the file, the line and the column (both from 1, columns in bytes).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace stipple {

/// A word of the file and its position; valid as long as the TokenFile exists.
struct Token {
    std::string_view text;
    std::size_t line = 0;
    std::size_t column = 0;
};

class TokenFile {
  public:
    /// Reads the whole file. @throws Error(io): missing, a directory, unreadable; Error(limit)
    explicit TokenFile(const std::string& path);

    /// Takes a text in memory; messages call it `name`.
    TokenFile(std::string bytes, std::string name);

    TokenFile(const TokenFile&) = delete;
    TokenFile& operator=(const TokenFile&) = delete;

    [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }

    /// Whether no token is left on the line of the last token; true before the first one.
    [[nodiscard]] bool at_line_end() const { return at_end() || line_ != last_line_; }

    /// The first line of the file, where some formats have a comment with their name.
    [[nodiscard]] std::string_view first_line() const {
        return std::string_view(bytes_).substr(0, bytes_.find_first_of("\r\n"));
    }

    /// Whether a comment line before the first token begins with `words`.
    [[nodiscard]] bool is_headed(std::string_view words) const;

    /// Whether the line of the next token ends in a comment that contains `words`.
    [[nodiscard]] bool comment_has(std::string_view words) const;

    /// Returns the next token without consuming it; its text is empty at the end of the file.
    [[nodiscard]] Token peek() const;

    /// Consumes the next token. @throws Error(input) naming `what` at the end of the file
    Token next(std::string_view what);

    /// Like next(), but the token must be on the line of the previous one.
    Token next_on_line(std::string_view what);

    /// Consumes a whole number in [low, high]. @throws Error(input) naming `what` as expected
    std::uint64_t number(std::string_view what, std::uint64_t low = 0,
                         std::uint64_t high = ~std::uint64_t{0});

    /// Like number(), but the number must be on the line of the previous token.
    std::uint64_t number_on_line(std::string_view what, std::uint64_t low = 0,
                                 std::uint64_t high = ~std::uint64_t{0});

    /// Checks that the line of the last token ends after it. @throws Error(input)
    void expect_line_end() const;

    /// Skips all tokens on the line of the next token.
    void skip_line();

    /// Reports an error at a token. @throws Error(input) "FILE:LINE:COLUMN: what"
    [[noreturn]] void refuse(const Token& at, const std::string& what) const;

    /// Reports an error of the whole file. @throws Error(input) "FILE: what"
    [[noreturn]] void refuse_whole(const std::string& what) const;

  private:
    /// Advances to the next token or the end.
    void pass_blanks();
    [[nodiscard]] bool line_is_short() const { return at_line_end() && last_line_ > 0; }
    [[noreturn]] void refuse_short(std::string_view what) const;
    [[nodiscard]] Token here() const { return {{}, line_, at_ - line_begin_ + 1}; }

    std::string name_;
    std::string bytes_;
    std::size_t at_ = 0;     ///< byte index of the next token, or of the end
    std::size_t front_ = 0;  ///< byte index of the first token
    std::size_t line_ = 1;
    std::size_t line_begin_ = 0;
    std::size_t last_line_ = 0;  ///< line of the last token
    std::size_t last_end_ = 0;   ///< column after the last token
};

}  // namespace stipple
