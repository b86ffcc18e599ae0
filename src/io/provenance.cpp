// SPDX-License-Identifier: MIT
#include "io/provenance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/json.hpp"
#include "core/text.hpp"
#include "io/columns.hpp"
#include "io/source_text.hpp"

namespace stipple::io {
namespace {

/// Converts a text to a JSON boolean or number if that reproduces it exactly; otherwise to a
/// string.
Json typed(const std::string& text) {
    if (text == "true") return true;
    if (text == "false") return false;
    const auto integer = parse_integer(text);
    if (integer && std::to_string(*integer) == text) return *integer;
    const auto number = parse_number(text);
    if (number && format_number(*number) == text) return *number;
    return text;
}

std::string untyped(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return format_number(value.get<double>());
    return json_text(value);
}

using Pairs = std::vector<std::pair<std::string, std::string>>;

// Parsers of JSON values; each returns whether the type is right.
bool take(const Json& value, std::string& text) {
    if (value.is_string()) text = value.get<std::string>();
    return value.is_string();
}

template <class Whole>
bool take_whole(const Json& value, Whole& number) {
    if (value.is_number_unsigned()) number = value.get<Whole>();
    return value.is_number_unsigned();
}

bool take(const Json& value, Pairs& pairs) {
    if (!value.is_object()) return false;
    pairs.clear();
    for (const auto& [name, text] : value.items())
        if (text.is_primitive()) pairs.emplace_back(name, untyped(text));
    return pairs.size() == value.size();
}

bool take(const Json& value, std::vector<std::string>& texts) {
    if (!value.is_array() || !std::ranges::all_of(value, &Json::is_string)) return false;
    texts = value.get<std::vector<std::string>>();
    return true;
}

/// Parses column names; drops the defaults, and replaces names that could not be in a header.
bool take_columns(const Json& value, std::vector<std::string>& names) {
    const bool texts = take(value, names);
    replace_names(names, false);
    names = kept_names(std::move(names));
    return texts;
}

bool take_levels(const Json& value, Levels& levels) {
    if (!value.is_object()) return false;
    levels.clear();
    for (const auto& [column, words] : value.items())
        if (!take(words, levels.emplace_back(column, std::vector<std::string>()).second))
            return false;
    return true;
}

bool take_precision(const Json& value, std::optional<int>& digits) {
    constexpr std::int64_t most = 1000;
    const auto whole = value.is_number_integer() ? value.get<std::int64_t>() : -1;
    if (whole >= 0 && whole <= most) digits = static_cast<int>(whole);
    return whole >= 0 && whole <= most;
}

bool take_efficiency(const Json& value, double& efficiency) {
    if (!value.is_number()) return false;
    efficiency = value.get<double>();
    return efficiency > 0 && efficiency <= 1;
}

bool take_versions(const Json& value,
                   std::vector<std::pair<std::string, std::uint64_t>>& versions) {
    if (!value.is_object() || !std::ranges::all_of(value, &Json::is_number_unsigned)) return false;
    versions.clear();
    for (const auto& [unit, version] : value.items())
        versions.emplace_back(unit, version.get<std::uint64_t>());
    return true;
}

bool take_dtype(const Json& value, bool& single) {
    single = value == "f32";
    return value.is_string();
}

/// Parses the value of one key. Returns whether it is valid; nullopt for an unknown key.
std::optional<bool> take_value(std::string_view key, const Json& value, Provenance& to) {
    if (key == "tool") return true;
    if (key == "version") return take(value, to.version);
    if (key == "generator") return take(value, to.generator);
    if (key == "options") return take(value, to.options);
    if (key == "seed") return take_whole(value, to.seed);
    if (key == "count") return take_whole(value, to.count);
    if (key == "dimension") return take_whole(value, to.dimension);
    if (key == "columns") return take_columns(value, to.columns);
    if (key == "levels") return take_levels(value, to.levels);
    if (key == "start") return take_whole(value, to.start);
    if (key == "domain") return take(value, to.domain);
    if (key == "bounds") return take(value, to.bounds);
    if (key == "shard") return take(value, to.shard);
    if (key == "command") return take(value, to.command);
    if (key == "inputs") return take(value, to.inputs);
    if (key == "found") return take(value, to.found);
    if (key == "dtype") return take_dtype(value, to.single);
    if (key == "efficiency") return take_efficiency(value, to.efficiency);
    if (key == "precision") return take_precision(value, to.precision);
    if (key == "warps") return take(value, to.warps);
    if (key == "stream_versions") return take_versions(value, to.stream_versions);
    return std::nullopt;
}

/// Parses the value of one key and records a flaw if the value is invalid; null is valid if the
/// generator is not known. Returns false for an unknown key.
bool take(std::string_view key, const Json& value, Provenance& to) {
    const auto good = take_value(key, value, to);
    if (good == false && to.flaw.empty() && !(value.is_null() && to.generator.empty()))
        to.flaw = fmt::format("its {} cannot be {}", key, shown(json_text(value)));
    return good.has_value();
}

}  // namespace

Json to_json(const Provenance& provenance) {
    Json meta{{"tool", "stipple"}, {"version", provenance.version}};
    // Without a generator, fields with default values are unknown, and become null.
    const auto fact = [&, usual = Provenance()](auto Provenance::*field) {
        const bool known = !provenance.generator.empty() || provenance.*field != usual.*field;
        return known ? Json(provenance.*field) : Json();
    };
    meta["generator"] = provenance.generator;
    Json& options = meta["options"] = Json::object();
    for (const auto& [name, text] : provenance.options) options[name] = typed(text);
    meta["seed"] = fact(&Provenance::seed);
    meta["count"] = provenance.count;
    meta["dimension"] = provenance.dimension;
    if (!provenance.columns.empty()) meta["columns"] = provenance.columns;
    for (const auto& [column, words] : provenance.levels) meta["levels"][column] = words;
    meta["start"] = fact(&Provenance::start);
    meta["warps"] = provenance.warps;
    meta["domain"] = provenance.warps.empty() ? fact(&Provenance::domain) : Json(provenance.domain);
    if (!provenance.bounds.empty()) meta["bounds"] = provenance.bounds;
    if (!provenance.shard.empty()) meta["shard"] = provenance.shard;
    if (provenance.efficiency < 1) meta["efficiency"] = provenance.efficiency;
    if (provenance.precision) meta["precision"] = *provenance.precision;
    if (provenance.single) meta["dtype"] = "f32";
    for (const auto& [file, bytes] : provenance.inputs) meta["inputs"][file] = bytes;
    for (const auto& [name, text] : provenance.found) meta["found"][name] = typed(text);
    for (const auto& [unit, version] : provenance.stream_versions)
        meta["stream_versions"][unit] = version;
    meta["command"] = provenance.command;
    return meta;
}

Provenance provenance_from(const Json& meta) {
    Provenance provenance;
    if (meta.is_object())
        for (const auto& [key, value] : meta.items()) take(key, value, provenance);
    return provenance;
}

std::string to_comment_lines(const Provenance& provenance, std::string_view begin) {
    std::string lines;
    const Json meta = to_json(provenance);
    // Replaces invalid UTF-8, such as in a file name in the command, instead of failing.
    for (const auto& [key, value] : meta.items())
        lines += fmt::format("{}{}: {}\n", begin, key, json_text(value));
    return lines;
}

bool take_comment_line(std::string_view line, Provenance& provenance) {
    const auto colon = line.find(": ");
    if (colon == std::string_view::npos) return false;
    const Json value = try_parse_json(line.substr(colon + 2));
    if (!value.is_discarded()) return take(line.substr(0, colon), value, provenance);
    // A number beyond the range of doubles is not valid JSON. It is passed on as text, so that
    // take() records a flaw. Other text that is not JSON is ignored.
    const std::string text(line.substr(colon + 2));
    if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string::npos)
        return false;
    return take(line.substr(0, colon), Json(text), provenance);
}

void note_count(const std::string& source, const Provenance& stated, std::uint64_t found,
                const RunContext& run) {
    if (stated.count == 0 || stated.count == found) return;
    run.notify(fmt::format("{}: {} points, but its provenance states {}; it was cut off or edited",
                           source_name(source), found, stated.count));
}

namespace {

/// Whether --column picks all coordinates that the provenance describes, in order.
bool picks_all(const Columns& columns, const ReadOptions& options, const Provenance& made) {
    const std::size_t first = columns.has(Columns::set_number) ? 1 : 0;
    bool all =
        options.columns.size() == made.dimension && first + made.dimension <= columns.width();
    for (std::size_t k = 0; all && k < made.dimension; ++k) all = columns.role[first + k] == k;
    return all;
}

}  // namespace

void tell_columns(Provenance& provenance, const Columns& columns, const ReadOptions& options) {
    if (!options.columns.empty() && !picks_all(columns, options, provenance)) {
        Provenance whole = std::exchange(provenance, {});
        provenance.count = whole.count;
        provenance.levels = whole.levels;
        provenance.precision = whole.precision;
        provenance.single = whole.single;
        // The rest is equal for sets that differ only in their seeds, which are averaged.
        whole.seed = provenance.seed;
        if (whole.command.find(" --count ") == std::string::npos) whole.count = 0;
        whole.command.clear();
        whole.found.clear();
        if (!whole.generator.empty())
            provenance.flaw =
                "--column picked coordinates of points with\n" + to_comment_lines(whole);
    }
    provenance.density_column = columns.density;
    provenance.columns = kept_names(columns.names);
}

void record_cuts(Provenance& meta) {
    if (meta.single) meta.warps.emplace_back(cut_to_single);
    if (meta.precision) meta.warps.push_back(fmt::format("{}{}", cut_to_digits, *meta.precision));
    meta.single = false;
    meta.precision.reset();
}

Provenance without_making(const Provenance& meta) {
    Provenance known;
    known.columns = meta.columns;
    known.levels = meta.levels;
    known.count = meta.count;
    known.dimension = meta.dimension;
    known.domain = meta.domain;
    return known;
}

}  // namespace stipple::io
