// SPDX-License-Identifier: MIT
//
// A text file of words and whole numbers between blanks, read from front to end; `#` opens a
// comment that reaches to the end of its line.
//
//     TokenFile file("joe-kuo.txt");
//     while (!file.at_end()) {
//         const auto d = file.number("a dimension", 2, 21201);
//         ...
//     }
//
// Promise  every complaint names the file, the line and the column (both from 1, columns in bytes).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace stipple {

/// A word of a file, and where it begins; good as long as the file object lives.
struct Token {
    std::string_view text;
    std::size_t line = 0;
    std::size_t column = 0;
};

class TokenFile {
  public:
    /// Reads the file at once. @throws Error(io): missing, a directory, unreadable; Error(limit).
    explicit TokenFile(const std::string& path);

    /// A text that is there already; messages call it `name`.
    TokenFile(std::string bytes, std::string name);

    TokenFile(const TokenFile&) = delete;
    TokenFile& operator=(const TokenFile&) = delete;

    /// Whether no token is left.
    [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }

    /// Whether no token is left on the line of the last one taken; true at the front of the file.
    [[nodiscard]] bool at_line_end() const { return at_end() || line_ != last_line_; }

    /// The whole first line, where formats put a comment that names them.
    [[nodiscard]] std::string_view first_line() const {
        return std::string_view(bytes_).substr(0, bytes_.find_first_of("\r\n"));
    }

    /// Whether a line before the first token begins so: a comment that says what the file is.
    [[nodiscard]] bool is_headed(std::string_view words) const;

    /// Whether the line of the next token ends in a comment with these words.
    [[nodiscard]] bool comment_has(std::string_view words) const;

    /// The next token, which stays where it is; its text is empty at the end of the file.
    [[nodiscard]] Token peek() const;

    /// Takes the next token. @throws Error(input) saying that `what` is missing at the end.
    Token next(std::string_view what);

    /// As next(), of which at least one more must stand on the line of the last token taken.
    Token next_on_line(std::string_view what);

    /// Takes a whole number in [low, high]. @throws Error(input) saying that `what` was expected.
    std::uint64_t number(std::string_view what, std::uint64_t low = 0,
                         std::uint64_t high = ~std::uint64_t{0});

    /// As number(), of which at least one more must stand on the line of the last token taken.
    std::uint64_t number_on_line(std::string_view what, std::uint64_t low = 0,
                                 std::uint64_t high = ~std::uint64_t{0});

    /// Holds that the line of the last token taken ends there. @throws Error(input)
    void expect_line_end() const;

    /// Takes all that is left of the line of the next token, up to a comment.
    void skip_line();

    /// @throws Error(input) "FILE:LINE:COLUMN: what"
    [[noreturn]] void refuse(const Token& at, const std::string& what) const;

    /// @throws Error(input) "FILE: what"
    [[noreturn]] void refuse_whole(const std::string& what) const;

  private:
    /// Stands at the next token, or at the end.
    void pass_blanks();
    [[nodiscard]] bool line_is_short() const { return at_line_end() && last_line_ > 0; }
    [[noreturn]] void refuse_short(std::string_view what) const;
    [[nodiscard]] Token here() const { return {{}, line_, at_ - line_begin_ + 1}; }

    std::string name_;
    std::string bytes_;
    std::size_t at_ = 0;     ///< of the next token, or the end
    std::size_t front_ = 0;  ///< of the first one
    std::size_t line_ = 1;
    std::size_t line_begin_ = 0;
    std::size_t last_line_ = 0;  ///< of the last token taken
    std::size_t last_end_ = 0;   ///< column just behind it
};

}  // namespace stipple
