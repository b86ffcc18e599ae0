// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "core/json.hpp"
#include "io/provenance.hpp"
#include "page/html.hpp"
#include "report/document.hpp"

namespace stipple::page {
namespace {

/// Options and results in the format of `stipple analyze`.
Json json_of(const Measure& measure) {
    Json object = {{"name", measure.name},
                   {"analyzer", measure.analyzer},
                   {"options", stipple::json_of(measure.options)}};
    if (!measure.results) {
        object["left_out"] = measure.left_out;
        return object;
    }
    if (!measure.command.empty()) object["command"] = measure.command;
    object["results"] = stipple::json_of(*measure.results);
    const std::string words = verdict_in_words(measure);
    if (!words.empty()) object["in_words"] = words;
    return object;
}

Json json_of(const Set& set) {
    Json object = {{"name", set.name}, {"source", set.source}};
    if (set.number) object["set"] = *set.number;
    if (!set.replications.empty()) object["sets"] = set.replications.size() + 1;
    object["count"] = set.count;
    if (set.left_out > 0) object["rows_left_out"] = set.left_out;
    object["dimension"] = set.dimension;
    object["domain"] = set.domain;
    if (!set.command.empty()) object["command"] = set.command;
    if (!set.provenance.generator.empty()) object["meta"] = io::to_json(set.provenance);
    object["measures"] = Json::array();
    for (const Measure& measure : set.measures) object["measures"].push_back(json_of(measure));
    return object;
}

Json json_of(const Row& row) {
    Json object = {{"key", row.key.key},
                   {"label", row.key.label},
                   {"better", word_of(row.key.better)},
                   {"values", Json::array()},
                   {"best", Json::array()}};
    bool bounds = false;
    bool means = false;
    for (std::size_t i = 0; i < row.values.size(); ++i) {
        const auto& known = row.values[i];
        bounds = bounds || (known && !known->exact());
        means = means || (known && known->error > 0);
        object["values"].push_back(known ? Json(known->value) : Json());
        if (row.best[i]) object["best"].push_back(i);
    }
    for (const auto& known : row.values)
        if (means) object["standard_error"].push_back(known ? Json(known->error) : Json());
    if (!bounds) return object;
    for (const auto& known : row.values) {
        object["lower"].push_back(known ? Json(known->lower) : Json());
        object["upper"].push_back(known ? Json(known->upper) : Json());
    }
    return object;
}

}  // namespace

std::string to_json(const Page& page) {
    Json all = {{"format", "stipple.comparison"},
                {"version", 1},
                {"tool", "stipple " + page.version},
                {"title", page.title},
                {"command", page.command},
                {"notes", notes_on(page.sets)},
                {"sets", Json::array()},
                {"comparison", Json::array()}};
    for (const Set& set : page.sets) all["sets"].push_back(json_of(set));
    for (const Row& row : compare_sets(page.sets)) all["comparison"].push_back(json_of(row));
    return json_text(all, 2) + "\n";
}

}  // namespace stipple::page
