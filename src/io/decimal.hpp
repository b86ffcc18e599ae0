// SPDX-License-Identifier: MIT
//
// Doubles as decimal text, fast.
#pragma once

#include <optional>
#include <string>

namespace stipple::io {

/// Appends the shortest text that reads back to the same double, or, with a precision, that many
/// digits after the point, cut toward zero: what was below 1 never prints as 1.
void append_number(std::string& out, double value, std::optional<int> precision = std::nullopt);

/// `value` as float32, cut toward zero: what was below 1 stays below 1.
float to_single(double value);

}  // namespace stipple::io
