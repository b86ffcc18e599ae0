// SPDX-License-Identifier: MIT
#include "io/provenance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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
    return value.dump();
}

void take(const Json& meta, const char* key, std::string& text) {
    if (const auto it = meta.find(key); it != meta.end() && it->is_string())
        text = it->get<std::string>();
}

template <class Whole>
void take_whole(const Json& meta, const char* key, Whole& number) {
    if (const auto it = meta.find(key); it != meta.end() && it->is_number_unsigned())
        number = it->get<Whole>();
}

void take_all(const Json& meta, Provenance& provenance) {
    take(meta, "version", provenance.version);
    take(meta, "generator", provenance.generator);
    if (const auto it = meta.find("options"); it != meta.end() && it->is_object()) {
        provenance.options.clear();
        for (const auto& [name, value] : it->items())
            if (value.is_primitive()) provenance.options.emplace_back(name, untyped(value));
    }
    take_whole(meta, "seed", provenance.seed);
    take_whole(meta, "count", provenance.count);
    take_whole(meta, "dimension", provenance.dimension);
    take_whole(meta, "start", provenance.start);
    if (const auto it = meta.find("warps"); it != meta.end() && it->is_array()) {
        provenance.warps.clear();
        for (const auto& warp : *it)
            if (warp.is_string()) provenance.warps.push_back(warp.get<std::string>());
    }
    take(meta, "domain", provenance.domain);
    take(meta, "bounds", provenance.bounds);
    take(meta, "shard", provenance.shard);
    if (const auto it = meta.find("efficiency"); it != meta.end() && it->is_number())
        provenance.efficiency = it->get<double>();
    take(meta, "command", provenance.command);
    if (const auto it = meta.find("precision"); it != meta.end() && it->is_number_integer())
        provenance.precision =
            static_cast<int>(std::clamp<std::int64_t>(it->get<std::int64_t>(), 0, 1000));
    if (const auto it = meta.find("dtype"); it != meta.end()) provenance.single = *it == "f32";
    if (const auto it = meta.find("inputs"); it != meta.end() && it->is_object()) {
        provenance.inputs.clear();
        for (const auto& [file, bytes] : it->items())
            if (bytes.is_string()) provenance.inputs.emplace_back(file, bytes.get<std::string>());
    }
    if (const auto it = meta.find("stream_versions"); it != meta.end() && it->is_object()) {
        provenance.stream_versions.clear();
        for (const auto& [unit, version] : it->items())
            if (version.is_number_unsigned())
                provenance.stream_versions.emplace_back(unit, version.get<std::uint64_t>());
    }
}

bool is_known(std::string_view key) {
    constexpr std::array keys{"tool",   "version",         "generator",  "options",   "seed",
                              "count",  "dimension",       "start",      "warps",     "domain",
                              "bounds", "shard",           "efficiency", "precision", "dtype",
                              "inputs", "stream_versions", "command"};
    return std::ranges::find(keys, key) != keys.end();
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
    if (meta.is_object()) take_all(meta, provenance);
    return provenance;
}

std::string to_comment_lines(const Provenance& provenance) {
    std::string lines;
    const Json meta = to_json(provenance);
    // Bytes that are not UTF-8 (a file's name in the command) are replaced, not refused.
    for (const auto& [key, value] : meta.items())
        lines += fmt::format("# {}: {}\n", key,
                             value.dump(-1, ' ', false, Json::error_handler_t::replace));
    return lines;
}

bool take_comment_line(std::string_view line, Provenance& provenance) {
    const auto colon = line.find(": ");
    if (colon == std::string_view::npos || !is_known(line.substr(0, colon))) return false;
    const Json value = Json::parse(line.substr(colon + 2), nullptr, false);
    if (value.is_discarded()) return false;
    take_all(Json{{std::string(line.substr(0, colon)), value}}, provenance);
    return true;
}

}  // namespace stipple::io
