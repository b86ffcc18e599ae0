// SPDX-License-Identifier: MIT
#include "report/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/options.hpp"
#include "core/text.hpp"
#include "stipple/analyze.hpp"

namespace stipple {
namespace {

/// Converts an option's value to a JSON number or boolean if it is one.
Json option_json(const std::string& text) {
    if (text == "true" || text == "false") return text == "true";
    if (const auto whole = parse_integer(text); whole && std::to_string(*whole) == text)
        return *whole;
    if (const auto number = parse_number(text)) return *number;
    return text;
}

Json measurement_json(const Measurement& m) {
    Json input = {{"source", m.source}};
    if (m.set) input["set"] = *m.set;
    if (m.sets > 1) input["sets"] = m.sets;
    input["count"] = m.count;
    if (m.largest_count > 0) input["largest_count"] = m.largest_count;
    input["dimension"] = m.dimension;
    input["domain"] = m.domain;
    if (!m.columns.empty()) input["columns"] = m.columns;
    Json object = {{"format", "stipple.report"},    {"version", 1},
                   {"analyzer", m.analyzer},        {"input", input},
                   {"options", json_of(m.options)}, {"results", json_of(m.results)}};
    if (m.standard_error) object["standard_error"] = json_of(*m.standard_error);
    if (m.seconds) object["seconds"] = *m.seconds;
    return object;
}

constexpr std::size_t most_shown = 9;  ///< longest list that is shown on one line

/// A number with six significant digits; integers below 1e15, and the integral parts of numbers
/// below 1e9, are in full.
std::string readable(double x) {
    if (x == 0) return "0";  // also for -0
    const double size = std::abs(x);
    const bool in_full = size < (x == std::floor(x) ? 1e15 : 1e9) && size >= 999'999.5;
    return fmt::format(fmt::runtime(in_full ? "{:.0f}" : "{:.6g}"), x);
}

std::string shortened(const Report::Curve& curve) {
    const std::size_t some = std::min(curve.size(), most_shown);
    std::string text;
    for (std::size_t i = 0; i < some; ++i) text += (i > 0 ? " " : "") + readable(curve[i]);
    if (curve.size() > some) text += fmt::format(" ... ({} values)", curve.size());
    return text;
}

std::string unit_of(const Report& report, const Report::Item* item) {
    for (const auto& [name, value, unit] : report.entries()) {
        if (&value == item) return unit;
        const auto* group = std::get_if<Report>(&value);
        if (const std::string inner = group ? unit_of(*group, item) : ""; !inner.empty())
            return inner;
    }
    return {};
}

std::string source_of(const Measurement& m) {
    std::string source = m.source == "-" ? "standard input" : printable(m.source);
    if (m.set) source += fmt::format(", set {}", *m.set);
    if (m.sets > 1) source += fmt::format(", mean of {} sets", m.sets);
    return source;
}

/// Tables of the lists that are too long for one line; the head of each column is the list's key.
std::string tables_of(const Report& report) {
    std::vector<std::pair<std::string, std::vector<std::string>>> tables;  // group and length, keys
    for (const auto& key : report.keys()) {
        const auto list = list_at(report, key);
        if (!list || list->size() <= most_shown) continue;
        const std::string name =
            fmt::format("{} {}", key.substr(0, key.rfind('.') + 1), list->size());
        auto it = std::ranges::find(tables, name, [](const auto& table) { return table.first; });
        if (it == tables.end()) it = tables.insert(it, {name, {}});
        it->second.push_back(key);
    }
    std::string text;
    for (const auto& [name, keys] : tables) {
        text += "\n ";
        std::vector<Report::Curve> lists;
        for (const auto& key : keys) {
            lists.push_back(*list_at(report, key));
            text += fmt::format(" {:>12}", key);
        }
        for (std::size_t i = 0; i < lists[0].size(); ++i) {
            text += "\n ";
            for (std::size_t k = 0; k < keys.size(); ++k)
                text += fmt::format(" {:>{}}", readable(lists[k][i]),
                                    std::max<std::size_t>(keys[k].size(), 12));
        }
        text += "\n";
    }
    return text;
}

/// First line of a text: the analyzer, and the points that it measured.
std::string head_of(const Measurement& m) {
    const std::string most = m.largest_count > 0 ? fmt::format(" to {}", m.largest_count) : "";
    const std::string of = m.columns.empty() ? "" : ": " + join(m.columns, ", ");
    constexpr std::size_t readable_size = 60;  // longer specs lose their options
    const std::string domain = m.domain.substr(
        0, m.domain.size() > readable_size ? m.domain.find(':') : std::string::npos);
    return fmt::format("{} of {} ({}{} points, dimension {}{}, {})\n", m.analyzer, source_of(m),
                       m.count, most, m.dimension, of, domain);
}

std::string results_of(const Measurement& m, const TextStyle& style = {}) {
    std::string text;
    const auto keys = m.results.keys();
    std::size_t width = 0;
    for (const auto& key : keys) width = std::max(width, key.size());
    for (const auto& key : keys) {
        const Report::Item* item = m.results.find(key);
        const auto list = style.full ? list_at(m.results, key) : std::nullopt;
        if (list && list->size() > most_shown) continue;
        std::string line = fmt::format("  {:<{}}  {}", key, width, text_of(*item));
        const Report::Item* error = m.standard_error ? m.standard_error->find(key) : nullptr;
        if (const auto* number = std::get_if<double>(error))
            line += fmt::format(" +- {:.3g}", *number);
        const std::string unit = unit_of(m.results, item);
        text += unit.empty() ? line + "\n" : fmt::format("{} {}\n", line, unit);
        if (style.below) text += style.below(m, key);
    }
    return style.full ? text + tables_of(m.results) : text;
}

// ---------------------------------------------------------------- parsing

constexpr const char* expected_json = "expected the JSON of 'stipple analyze'";

bool is_number(const Json& value) { return value.is_number() || value.is_null(); }

double number_of(const Json& value) {
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

Report report_of(const Json& object);

/// Adds a value to a report; ignores what it cannot hold (lists of texts or of lists).
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
    else if (!value.empty() && std::ranges::all_of(value, &Json::is_number_integer))
        report.add(name, value.get<Report::Integers>());
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
        fail(ErrorKind::input, "{}: an entry is not a report; {}", source, expected_json);
    const auto version = value_or<std::uint64_t>(object, "version", 0);
    if (version != 1)
        fail(ErrorKind::input, "{}: a report of version {}; expected version 1", source, version);
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

std::string text_of(const Report::Item& item) {
    struct {
        std::string operator()(bool b) const { return b ? "yes" : "no"; }
        std::string operator()(std::int64_t i) const { return std::to_string(i); }
        std::string operator()(double x) const { return readable(x); }
        std::string operator()(const std::string& s) const { return printable(s); }
        std::string operator()(const Report::Curve& curve) const { return shortened(curve); }
        std::string operator()(const Report::Integers& list) const {
            return shortened(Report::Curve(list.begin(), list.end()));
        }
        std::string operator()(const Grid&) const { return {}; }
        std::string operator()(const Report&) const { return {}; }
    } text;
    return std::visit(text, item);
}

Json json_of(const Report& report) {
    Json object = Json::object();
    const auto convert = []<class T>(const T& value) -> Json {
        if constexpr (std::is_same_v<T, Report>) return json_of(value);
        if constexpr (std::is_constructible_v<Json, T>) return value;
        return {};
    };
    for (const auto& [name, value, unit] : report.entries())
        if (!std::holds_alternative<Grid>(value)) object[name] = std::visit(convert, value);
    return object;
}

Json json_of(const std::vector<std::pair<std::string, std::string>>& options) {
    Json object = Json::object();
    for (const auto& [name, text] : options) object[name] = option_json(text);
    return object;
}

std::optional<double> number_at(const Report& report, std::string_view key) {
    const Report::Item* item = report.find(key);
    if (const auto* number = std::get_if<double>(item)) return *number;
    if (const auto* whole = std::get_if<std::int64_t>(item)) return static_cast<double>(*whole);
    return std::nullopt;
}

std::optional<Report::Curve> list_at(const Report& report, std::string_view key) {
    const Report::Item* item = report.find(key);
    if (const auto* curve = std::get_if<Report::Curve>(item)) return *curve;
    if (const auto* whole = std::get_if<Report::Integers>(item))
        return Report::Curve(whole->begin(), whole->end());
    return std::nullopt;
}

std::string to_json(std::span<const Measurement> measurements, bool array) {
    Json all = Json::array();
    for (const Measurement& m : measurements) all.push_back(measurement_json(m));
    return json_text(all.size() == 1 && !array ? all[0] : all, 2) + "\n";
}

std::string to_text(std::span<const Measurement> measurements, const TextStyle& style) {
    std::string text;
    for (const Measurement& m : measurements) text += head_of(m) + results_of(m, style);
    return text;
}

std::string to_text(const Report& report) {
    Measurement measurement;
    measurement.results = report;
    return results_of(measurement);
}

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
    while (!(bytes = trim(bytes)).empty()) {
        const std::string_view piece = bytes.substr(0, json_extent(bytes).size);
        bytes.remove_prefix(piece.size());
        Json text;
        try {
            text = parse_json(piece);
        } catch (const JsonError& e) {
            fail(ErrorKind::input, "{}: incomplete or invalid JSON at byte {} of a report: {}; {}",
                 source, e.at + 1, e.what(), expected_json);
        }
        if (!text.is_array()) text = Json::array({std::move(text)});
        for (const Json& object : text) found.push_back(measurement_of(object, source));
    }
    if (found.empty()) fail(ErrorKind::input, "{}: contains no report; {}", source, expected_json);
    return found;
}

}  // namespace stipple
