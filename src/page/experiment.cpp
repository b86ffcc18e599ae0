// SPDX-License-Identifier: MIT
#include "page/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/json.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "io/format.hpp"
#include "plot/drawing/html_text.hpp"

namespace stipple::page {

using plot::html_text;

namespace {

constexpr std::size_t most_values = 12;  ///< longer lists are cut off after this many values

/// A value in words: "2", "x > 1", "a, b, c".
std::string words_of(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_array()) return json_text(value);
    std::vector<std::string> all;
    for (const Json& item : value) all.push_back(words_of(item));
    if (all.size() <= most_values) return join(all, ", ");
    const std::size_t count = all.size();
    all.resize(most_values);
    return fmt::format("{}, ... ({} in all)", join(all, ", "), count);
}

/// A range in words: "2 to 3".
std::string ends_of(const Json& ends) {
    return ends.is_array() && ends.size() == 2
               ? fmt::format("{} to {}", words_of(ends[0]), words_of(ends[1]))
               : words_of(ends);
}

/// Values of a parameter in words: "uniform from 2 to 3", "normal: mean 0, standard-deviation 1".
std::string law_of(const Json& parameter) {
    std::string text;
    std::vector<std::string> more;
    for (const auto& [key, value] : parameter.items()) {
        if (key == "range")
            text = "range " + ends_of(value);
        else if (key == "integers")
            text = "whole numbers " + ends_of(value);
        else if (key == "levels")
            text = "levels " + words_of(value);
        else if (key == "values")
            text = "measured values " + words_of(value);
        else if (key == "distribution")
            text = words_of(value);
        else if (key == "truncate")
            more.push_back("truncated to " + ends_of(value));
        else if (key != "name" && key != "unit")
            more.push_back(fmt::format("{} {}", key, words_of(value)));
    }
    if (!more.empty()) text += (text.empty() ? "" : "; ") + join(more, ", ");
    return text;
}

std::string row_of(const Json& parameter) {
    const std::string name = words_of(parameter.value("name", Json("")));
    const std::string unit = words_of(parameter.value("unit", Json("")));
    return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n",
                       html_text(name), html_text(unit), html_text(law_of(parameter)));
}

/// Constraints and correlations as a list, one per item.
std::string joined_by(const Json& file) {
    std::string items;
    const auto add = [&items](const std::string& text) {
        items += fmt::format("<li>{}</li>\n", html_text(text));
    };
    if (file.contains("constraints"))
        for (const Json& constraint : file["constraints"]) add(words_of(constraint));
    if (file.contains("correlation"))
        for (const auto& [key, value] : file["correlation"].items()) {
            const bool pairs = value.is_array() && !value.empty() && value[0].is_array();
            for (const Json& pair : pairs ? value : Json())
                add(fmt::format("{} correlation of {}", key, words_of(pair)));
            if (!pairs) add(fmt::format("{}: {}", key, words_of(value)));
        }
    return items.empty() ? "" : "<ul class=\"constraints\">\n" + items + "</ul>\n";
}

/// Parameter file in the spec of an experiment's domain; null for all other domains.
Json file_of(const std::string& domain) {
    if (!is_experiment(domain)) return {};
    const Spec spec = parse_spec(domain);
    const auto text =
        std::ranges::find(spec.settings, "json", [](const auto& s) { return s.first; });
    if (text == spec.settings.end()) return {};
    const Json file = try_parse_json(text->second);
    return file.is_object() && file.contains("parameters") ? file : Json();
}

/// The parameter of each coordinate in the file; an empty object for other coordinates.
std::vector<Json> parameters_of(const PointSet& points) {
    const Json file = file_of(points.domain->spec());
    std::vector<Json> found;
    for (const std::string& name : coordinate_names(points.dimension(), points.provenance)) {
        found.push_back(Json::object());
        for (const Json& parameter : file.is_null() ? Json() : file["parameters"])
            if (words_of(parameter.value("name", Json(""))) == name) found.back() = parameter;
    }
    return found;
}

}  // namespace

bool is_experiment(const std::string& domain) { return domain.starts_with("parameters:"); }

std::vector<bool> log_axes(const PointSet& points) {
    std::vector<bool> logs;
    for (const Json& parameter : parameters_of(points))
        logs.push_back(parameter.value("scale", Json()) == "log" ||
                       parameter.value("distribution", Json()) == "log-uniform");
    return logs;
}

std::vector<std::string> units_of(const PointSet& points) {
    std::vector<std::string> units;
    for (const Json& parameter : parameters_of(points))
        units.push_back(words_of(parameter.value("unit", Json(""))));
    return units;
}

std::string parameter_table(const std::string& domain) {
    const Json file = file_of(domain);
    if (file.is_null()) return {};
    std::string rows;
    for (const Json& parameter : file["parameters"]) rows += row_of(parameter);
    return fmt::format(
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"parameters\">"
        "<table class=\"parameters\">\n<thead><tr><th scope=\"col\">Parameter</th><th "
        "scope=\"col\">Unit</th><th scope=\"col\">Values</th></tr></thead>\n<tbody>\n{}</tbody>"
        "</table></div>\n{}",
        rows, joined_by(file));
}

}  // namespace stipple::page
