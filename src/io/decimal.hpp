// SPDX-License-Identifier: MIT
//
// Doubles as decimal text and back, fast and exact.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace stipple::io {

/// Appends the shortest text that reads back to the same double, or, with a precision, that many
/// digits after the point, cut toward zero: what was below 1 never prints as 1.
void append_number(std::string& out, double value, std::optional<int> precision = std::nullopt);

/// What stands before, between and behind the numbers of a row.
struct RowStyle {
    std::string_view open;
    std::string_view between;
    std::string_view close;
};

/// Appends rows of `width` numbers.
void append_rows(std::string& out, std::span<const double> rows, std::size_t width,
                 const RowStyle& style, std::optional<int> precision = std::nullopt);

/// Reads the decimal number (or nan, inf, infinity) that begins at `first`, rounded to the nearest
/// double; what is too large gives an infinity, what is too small a subnormal number or zero.
/// Returns its end, or null where no number begins.
const char* read_number(const char* first, const char* last, double& value);

}  // namespace stipple::io
