// SPDX-License-Identifier: MIT
//
// A text file in memory, and how its places are named in messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace stipple::io {

/// What is said of a source without a byte: an empty file, or a pipe into which nothing came.
/// @throws Error(input)
[[noreturn]] void refuse_empty(std::string_view source, std::string_view expected);

/// How messages call a source: "-" is "stdin".
std::string source_name(std::string_view source);

/// The bytes of a text without its byte-order mark; owns nothing.
class SourceText {
  public:
    /// @throws Error(input) when it is empty, compressed, or not in one byte a letter.
    SourceText(std::string_view bytes, std::string_view source);

    /// A later part of a text, of which `lines_before` were read.
    SourceText(std::string_view bytes, std::string_view source, char newline,
               std::size_t lines_before);

    [[nodiscard]] const char* begin() const { return bytes_.data(); }
    [[nodiscard]] const char* end() const { return bytes_.data() + bytes_.size(); }
    [[nodiscard]] const std::string& source() const { return source_; }

    /// What ends a line: \n, or \r where the text has no \n.
    [[nodiscard]] char newline() const { return newline_; }

    /// From 1.
    [[nodiscard]] std::size_t line_of(const char* at) const;

    /// @throws Error(input) "FILE:LINE:COLUMN: what", columns being bytes from 1.
    [[noreturn]] void refuse(const char* at, const std::string& what, std::string hint = {}) const;

    /// @throws Error(input) "FILE: what"
    [[noreturn]] void refuse_whole(const std::string& what, std::string hint = {}) const;

  private:
    std::string_view bytes_;
    std::string source_;
    char newline_ = '\n';
    std::size_t lines_before_ = 0;
};

/// The first byte that no text holds, or null.
const char* first_control_byte(std::string_view line);

}  // namespace stipple::io
