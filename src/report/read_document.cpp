// SPDX-License-Identifier: MIT
#include "report/read_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/options.hpp"

namespace stipple {
namespace {

constexpr const char* wanted = "expected the JSON of 'stipple analyze'";

/// A number or null.
bool is_number(const Json& value) { return value.is_number() || value.is_null(); }

double number_of(const Json& value) {
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

Report report_of(const Json& object);

/// Adds what a report can hold; the rest (lists of words, of lists) is passed over.
void add(Report& report, const std::string& name, const Json& value) {
    if (value.is_boolean())
        report.add(name, value.get<bool>());
    else if (value.is_number_integer())
        report.add(name, value.get<std::int64_t>());
    else if (is_number(value))
        report.add(name, number_of(value));
    else if (value.is_string())
        report.add(name, value.get<std::string>());
    else if (value.is_object())
        report.add(name, report_of(value));
    else if (std::ranges::all_of(value, is_number)) {
        Report::Curve curve;
        for (const Json& item : value) curve.push_back(number_of(item));
        report.add(name, std::move(curve));
    }
}

Report report_of(const Json& object) {
    Report report;
    for (const auto& [name, value] : object.items()) add(report, name, value);
    return report;
}

template <class T>
T value_or(const Json& object, const char* key, T otherwise) {
    const auto it = object.find(key);
    if (it == object.end()) return otherwise;
    if constexpr (std::is_same_v<T, std::string>)
        return it->is_string() ? it->template get<T>() : otherwise;
    else
        return it->is_number_unsigned() ? it->template get<T>() : otherwise;
}

Measurement measurement_of(const Json& object, const std::string& source) {
    const auto part = [&object](const char* key) {
        const auto it = object.find(key);
        return it != object.end() && it->is_object() ? *it : Json::object();
    };
    if (!object.is_object() || value_or<std::string>(object, "format", {}) != "stipple.report")
        fail(ErrorKind::input, "{}: an entry is no report; {}", source, wanted);
    const auto version = value_or<std::uint64_t>(object, "version", 0);
    if (version != 1)
        fail(ErrorKind::input, "{}: a report of version {}; this program reads version 1", source,
             version);
    const Json input = part("input");
    Measurement m{.analyzer = value_or<std::string>(object, "analyzer", "?"),
                  .source = value_or<std::string>(input, "source", "-"),
                  .sets = value_or<std::size_t>(input, "sets", 1),
                  .count = value_or<std::uint64_t>(input, "count", 0),
                  .dimension = value_or<std::size_t>(input, "dimension", 0),
                  .domain = value_or<std::string>(input, "domain", {}),
                  .results = report_of(part("results"))};
    if (input.contains("set")) m.set = value_or<std::size_t>(input, "set", 0);
    const Json options = part("options");
    for (const auto& [name, value] : options.items())
        m.options.emplace_back(name,
                               value.is_string() ? value.get<std::string>() : json_text(value));
    if (object.contains("standard_error")) m.standard_error = report_of(part("standard_error"));
    return m;
}

}  // namespace

bool looks_like_reports(std::string_view bytes) {
    const auto first = bytes.find_first_not_of(" \t\r\n[");
    if (first == std::string_view::npos) return bytes.find('[') != std::string_view::npos;
    if (bytes[first] != '{') return bytes[first] == ']';
    constexpr std::size_t front = 200;
    const std::string_view head = bytes.substr(first, front);
    return head.find("\"stipple.report\"") != std::string_view::npos;
}

std::vector<Measurement> read_reports(std::string_view bytes, const std::string& source) {
    std::vector<Measurement> found;
    std::istringstream in{std::string(bytes)};
    while (in >> std::ws, !in.eof()) {
        Json text;
        try {
            in >> text;
        } catch (const Json::exception& e) {
            const auto [at, what] = json_trouble(e, bytes);
            fail(ErrorKind::input, "{}: no whole JSON, byte {} of a report: {}; {}", source, at + 1,
                 what, wanted);
        }
        if (is_deep(text))
            fail(ErrorKind::input, "{}: lists in lists too deep; {}", source, wanted);
        if (!text.is_array()) text = Json::array({std::move(text)});
        for (const Json& object : text) found.push_back(measurement_of(object, source));
    }
    if (found.empty()) fail(ErrorKind::input, "{}: holds no report; {}", source, wanted);
    return found;
}

}  // namespace stipple
