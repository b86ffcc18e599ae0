// SPDX-License-Identifier: MIT
//
// JSON whose objects keep the order of their keys. Declared only: who looks into one includes
// <nlohmann/json.hpp>.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace stipple {

using Json = nlohmann::ordered_json;

/// The value as text, on one line unless indented; U+FFFD in place of bytes that are not UTF-8.
std::string json_text(const Json& value, int indent = -1);

/// How far the value at the front of a text reaches, as quotes and brackets tell.
struct JsonExtent {
    std::size_t size = std::string_view::npos;      ///< bytes; npos: the text ends before the value
    std::size_t too_deep = std::string_view::npos;  ///< the bracket that opens a 21st level
};

/// Looks no further than to the end of the value, or to where it is too deep.
JsonExtent json_extent(std::string_view text);

/// What is wrong with a text that is no JSON.
struct JsonError : std::runtime_error {
    JsonError(const std::string& what, std::size_t place) : std::runtime_error(what), at(place) {}
    std::size_t at;  ///< where, in bytes from 0
};

/// The value of a text from a stranger. Refuses lists and objects that stand in each other more than
/// 20 times, as they do in nothing of ours: the parser itself, which copies values, and all that goes
/// through them would use up the stack.
/// @throws JsonError
Json parse_json(std::string_view text);

/// The same, but a discarded value for a text that is none.
Json try_parse_json(std::string_view text);

/// The value of a file that somebody wrote, in which no key stands twice in an object.
/// @throws Error(input) "SOURCE:LINE:COLUMN: not JSON", "SOURCE: $.a.b: the key stands twice"
Json parse_written_json(std::string_view text, const std::string& source);

}  // namespace stipple
