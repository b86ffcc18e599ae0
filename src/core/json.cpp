// SPDX-License-Identifier: MIT
#include "core/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "core/utf8.hpp"

namespace stipple {
namespace {

bool is_deeper(const Json& value, int most) {
    if (!value.is_structured()) return false;
    return most == 0 ||
           std::ranges::any_of(value, [most](const Json& v) { return is_deeper(v, most - 1); });
}

}  // namespace

std::string json_text(const Json& value, int indent) {
    return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

bool is_deep(const Json& value) { return is_deeper(value, 20); }

std::string json_shown(const Json& value) {
    return is_deep(value) ? fmt::format("'{}' with many others in each other", value.type_name())
                          : shown(json_text(value));
}

JsonTrouble json_trouble(const std::exception& error, std::string_view text) {
    if (const auto* place = dynamic_cast<const Json::parse_error*>(&error))
        return {std::min(place->byte > 0 ? place->byte - 1 : 0, text.size()), "not JSON"};
    // Its message ends in the number that is too large, in quotes.
    const std::string_view message = error.what();
    const auto number = split(message.substr(message.find('\'') + 1), '\'').front();
    return {std::min(text.find(number), text.size()),
            fmt::format("the number {} is beyond what a double holds", shown(number))};
}

}  // namespace stipple
