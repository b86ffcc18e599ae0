// SPDX-License-Identifier: MIT
//
// JSON whose objects keep the order of their keys. Only forward-declared here: include
// <nlohmann/json.hpp> to access values.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace stipple {

using Json = nlohmann::ordered_json;

/// Formats a value, on one line unless `indent` is given. Bytes that are not UTF-8 become U+FFFD.
std::string json_text(const Json& value, int indent = -1);

/// Extent of the JSON value at the front of a text, found by its quotes and brackets.
struct JsonExtent {
    /// Size in bytes; npos if the text ends within the value.
    std::size_t size = std::string_view::npos;
    /// Position of a bracket nested 21 deep; npos if there is none.
    std::size_t too_deep = std::string_view::npos;
};

/// Scans only up to the end of the value, or up to a bracket nested too deep.
JsonExtent json_extent(std::string_view text);

/// Text that is not valid JSON.
struct JsonError : std::runtime_error {
    JsonError(const std::string& what, std::size_t place) : std::runtime_error(what), at(place) {}
    std::size_t at;  ///< position of the error, in bytes from 0
};

/// Parses untrusted text. Rejects nesting deeper than 20 levels, which stipple itself never writes,
/// because the parser and all recursive code would overflow the stack. @throws JsonError
Json parse_json(std::string_view text);

/// As parse_json(), but returns a discarded value if the text is not valid JSON.
Json try_parse_json(std::string_view text);

/// Parses a file written by a user; duplicate keys in an object are errors.
/// @throws Error(input) "SOURCE:LINE:COLUMN: not JSON", "SOURCE: $.a.b: the key occurs twice"
Json parse_written_json(std::string_view text, const std::string& source);

}  // namespace stipple
