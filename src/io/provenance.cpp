// SPDX-License-Identifier: MIT
#include "io/provenance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "core/json.hpp"
#include "core/text.hpp"

namespace stipple::io {
namespace {

/// A text as the JSON value that it looks like, if that gives the same text back.
Json typed(const std::string& text) {
    if (text == "true") return true;
    if (text == "false") return false;
    std::int64_t integer = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), integer);
    if (error == std::errc() && std::to_string(integer) == text) return integer;
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

void take(const Json& value, std::string& text) {
    if (value.is_string()) text = value.get<std::string>();
}

template <class Whole>
void take_whole(const Json& value, Whole& number) {
    if (value.is_number_unsigned()) number = value.get<Whole>();
}

void take(const Json& value, Pairs& pairs) {
    if (!value.is_object()) return;
    pairs.clear();
    for (const auto& [name, text] : value.items())
        if (text.is_primitive()) pairs.emplace_back(name, untyped(text));
}

/// Takes the value of one key. False: there is no such key.
bool take(std::string_view key, const Json& value, Provenance& to) {
    if (key == "tool") return true;
    if (key == "version") return take(value, to.version), true;
    if (key == "generator") return take(value, to.generator), true;
    if (key == "options") return take(value, to.options), true;
    if (key == "seed") return take_whole(value, to.seed), true;
    if (key == "count") return take_whole(value, to.count), true;
    if (key == "dimension") return take_whole(value, to.dimension), true;
    if (key == "start") return take_whole(value, to.start), true;
    if (key == "domain") return take(value, to.domain), true;
    if (key == "bounds") return take(value, to.bounds), true;
    if (key == "shard") return take(value, to.shard), true;
    if (key == "command") return take(value, to.command), true;
    if (key == "inputs") return take(value, to.inputs), true;
    if (key == "dtype") return to.single = value == "f32", true;
    if (key == "efficiency" && value.is_number()) to.efficiency = value.get<double>();
    if (key == "precision" && value.is_number_integer())
        to.precision =
            static_cast<int>(std::clamp<std::int64_t>(value.get<std::int64_t>(), 0, 1000));
    if (key == "warps" && value.is_array()) {
        to.warps.clear();
        for (const Json& warp : value)
            if (warp.is_string()) to.warps.push_back(warp.get<std::string>());
    }
    if (key == "stream_versions" && value.is_object()) {
        to.stream_versions.clear();
        for (const auto& [unit, version] : value.items())
            if (version.is_number_unsigned())
                to.stream_versions.emplace_back(unit, version.get<std::uint64_t>());
    }
    return key == "efficiency" || key == "precision" || key == "warps" || key == "stream_versions";
}

}  // namespace

Json to_json(const Provenance& provenance) {
    Json meta{{"tool", "stipple"}, {"version", provenance.version}};
    meta["generator"] = provenance.generator;
    Json& options = meta["options"] = Json::object();
    for (const auto& [name, text] : provenance.options) options[name] = typed(text);
    meta["seed"] = provenance.seed;
    meta["count"] = provenance.count;
    meta["dimension"] = provenance.dimension;
    meta["start"] = provenance.start;
    meta["warps"] = provenance.warps;
    meta["domain"] = provenance.domain;
    if (!provenance.bounds.empty()) meta["bounds"] = provenance.bounds;
    if (!provenance.shard.empty()) meta["shard"] = provenance.shard;
    if (provenance.efficiency < 1) meta["efficiency"] = provenance.efficiency;
    if (provenance.precision) meta["precision"] = *provenance.precision;
    if (provenance.single) meta["dtype"] = "f32";
    for (const auto& [file, bytes] : provenance.inputs) meta["inputs"][file] = bytes;
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
    // Bytes that are not UTF-8 (a file's name in the command) are replaced, not refused.
    for (const auto& [key, value] : meta.items())
        lines += fmt::format("{}{}: {}\n", begin, key, json_text(value));
    return lines;
}

bool take_comment_line(std::string_view line, Provenance& provenance) {
    const auto colon = line.find(": ");
    if (colon == std::string_view::npos) return false;
    const Json value = Json::parse(line.substr(colon + 2), nullptr, false);
    return !value.is_discarded() && take(line.substr(0, colon), value, provenance);
}

}  // namespace stipple::io
