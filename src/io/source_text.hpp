// SPDX-License-Identifier: MIT
//
// Text files in memory, with positions for error messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace stipple::io {

/// Reports an empty input: an empty file, or a pipe that delivered nothing. @throws Error(input)
[[noreturn]] void refuse_empty(std::string_view source, std::string_view expected);

/// Name of a source in messages: "-" becomes "stdin".
std::string source_name(std::string_view source);

/// Text without its byte-order mark; does not own the bytes.
class SourceText {
  public:
    /// @throws Error(input) if the text is empty, compressed by gzip, or in UTF-16
    SourceText(std::string_view bytes, std::string_view source);

    /// A part of a text that begins after `lines_before` lines.
    SourceText(std::string_view bytes, std::string_view source, char newline,
               std::size_t lines_before);

    [[nodiscard]] const char* begin() const { return bytes_.data(); }
    [[nodiscard]] const char* end() const { return bytes_.data() + bytes_.size(); }
    [[nodiscard]] const std::string& source() const { return source_; }

    /// The line separator: \n, or \r if the text has no \n.
    [[nodiscard]] char newline() const { return newline_; }

    /// Line number of a position, from 1.
    [[nodiscard]] std::size_t line_of(const char* at) const;

    /// Reports an error at a position. @throws Error(input) "FILE:LINE:COLUMN: what"; columns are
    /// bytes counted from 1.
    [[noreturn]] void refuse(const char* at, const std::string& what, std::string hint = {}) const;

    /// Reports an error of the whole text. @throws Error(input) "FILE: what"
    [[noreturn]] void refuse_whole(const std::string& what, std::string hint = {}) const;

  private:
    std::string_view bytes_;
    std::string source_;
    char newline_ = '\n';
    std::size_t lines_before_ = 0;
};

/// First control byte in a line, except tab; null if the line has none.
const char* first_control_byte(std::string_view line);

}  // namespace stipple::io
