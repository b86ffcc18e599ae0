// SPDX-License-Identifier: MIT
//
// Fast and exact conversion of doubles to and from decimal text.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace stipple::io {

/// Appends the shortest text that reads back to the same double. With a precision, cuts this text,
/// written without an exponent, to that many digits after the point: values below 1 never print as
/// 1, and cut text that is read and cut again stays the same.
void append_number(std::string& out, double value, std::optional<int> precision = std::nullopt);

/// Text before, between and after the numbers of a row.
struct RowStyle {
    std::string_view open;
    std::string_view between;
    std::string_view close;
};

/// Appends rows of `width` numbers.
void append_rows(std::string& out, std::span<const double> rows, std::size_t width,
                 const RowStyle& style, std::optional<int> precision = std::nullopt);

/// Reads the decimal number (or nan, inf, infinity) at `first`, rounded to the nearest double;
/// infinity if too large, a subnormal or zero if too small. Returns the end of the number; nullptr
/// if the text at `first` is not a number.
const char* read_number(const char* first, const char* last, double& value);

}  // namespace stipple::io
