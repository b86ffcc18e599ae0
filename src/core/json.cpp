// SPDX-License-Identifier: MIT
#include "core/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

constexpr std::size_t deepest = 20;

/// Converts an exception that Json::parse(text) threw.
JsonError error_of(const Json::exception& error, std::string_view text) {
    if (const auto* place = dynamic_cast<const Json::parse_error*>(&error))
        return {"not JSON", std::min(place->byte > 0 ? place->byte - 1 : 0, text.size())};
    // The library's message ends with the number that is too large, in quotes.
    const std::string_view message = error.what();
    const auto number = split(message.substr(message.find('\'') + 1), '\'').front();
    return {fmt::format("the number {} is out of the range of a double", shown(number)),
            std::min(text.find(number), text.size())};
}

/// Rejects duplicate keys in an object; the parser would silently keep only the last.
class Repetitions {
  public:
    explicit Repetitions(const std::string& source) : source_(source) {}

    bool operator()(int, Json::parse_event_t event, const Json& value) {
        if (event == Json::parse_event_t::object_start) objects_.emplace_back();
        if (event == Json::parse_event_t::object_end) objects_.pop_back();
        if (event != Json::parse_event_t::key) return true;
        const auto name = value.get<std::string>();
        auto& keys_here = objects_.back();
        const bool twice = std::ranges::find(keys_here, name) != keys_here.end();
        keys_here.push_back(name);
        if (!twice) return true;
        std::string where = "$";
        for (const auto& object : objects_) where += "." + object.back();
        fail(ErrorKind::input, "{}: {}: the key occurs twice", source_, where);
    }

  private:
    std::string source_;
    std::vector<std::vector<std::string>> objects_;  ///< keys seen so far in each open object
};

}  // namespace

std::string json_text(const Json& value, int indent) {
    return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

JsonExtent json_extent(std::string_view text) {
    std::size_t depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool closes = c == ']' || c == '}';
        if (c == '"') {
            for (++i; i < text.size() && text[i] != '"'; ++i)
                if (text[i] == '\\') ++i;
        } else if (c == '[' || c == '{') {
            if (++depth > deepest) return {.too_deep = i};
        } else if (depth == 0 && (closes || c == ',')) {
            return {.size = i};
        } else if (closes && --depth == 0) {
            return {.size = i + 1};
        }
    }
    return {};
}

Json parse_json(std::string_view text) {
    if (const auto at = json_extent(text).too_deep; at != std::string_view::npos)
        throw JsonError("lists are nested too deeply", at);
    try {
        return Json::parse(text);
    } catch (const Json::exception& error) {
        throw error_of(error, text);
    }
}

Json try_parse_json(std::string_view text) {
    const bool deep = json_extent(text).too_deep != std::string_view::npos;
    return deep ? Json(Json::value_t::discarded) : Json::parse(text, nullptr, false);
}

Json parse_written_json(std::string_view text, const std::string& source) {
    try {
        parse_json(text);  // throws for invalid JSON and deep nesting
        return Json::parse(text, Repetitions(source));
    } catch (const JsonError& e) {
        const auto before = text.substr(0, e.at);
        const auto line = 1 + std::ranges::count(before, '\n');
        const auto last = before.rfind('\n');
        const auto column = last == std::string_view::npos ? e.at + 1 : e.at - last;
        fail(ErrorKind::input, "{}:{}:{}: {}", source, line, column, e.what());
    }
}

}  // namespace stipple
