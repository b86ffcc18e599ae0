// SPDX-License-Identifier: MIT
//
// JSON whose objects keep the order of their keys. Declared only: who looks into one includes
// <nlohmann/json.hpp>.
#pragma once

#include <cstddef>
#include <exception>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace stipple {

using Json = nlohmann::ordered_json;

/// The value as text, on one line unless indented; U+FFFD in place of bytes that are not UTF-8.
std::string json_text(const Json& value, int indent = -1);

/// Whether lists and objects stand in each other more than 20 times, as they do in nothing of ours:
/// what goes through them would use up the stack.
bool is_deep(const Json& value);

/// As messages show a value, in quotes: not whole where it is long, nor where it is deep.
std::string json_shown(const Json& value);

/// Where a text is no JSON, in bytes from 0, and what is wrong there.
struct JsonTrouble {
    std::size_t at;
    std::string what;
};

/// @param error what Json::parse(text) threw
JsonTrouble json_trouble(const std::exception& error, std::string_view text);

}  // namespace stipple
