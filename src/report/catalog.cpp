// SPDX-License-Identifier: MIT
#include "report/catalog.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/text.hpp"
#include "generators/generator.hpp"
#include "io/format.hpp"
#include "pipeline/units.hpp"
#include "scrambles/scramble.hpp"
#include "warps/warp.hpp"

namespace stipple {
namespace {

constexpr std::size_t any_dimension = 1'000'000;

std::string dimensions(std::size_t low, std::size_t high) {
    if (low == high) return fmt::format("dimension {}", low);
    if (high >= any_dimension)
        return low == 1 ? "any dimension" : fmt::format("dimension {} and up", low);
    return fmt::format("dimensions {} to {}", low, high);
}

std::string seed_use(const Generator& unit) {
    if (uses_seed(unit, unit.options.defaults())) return "uses the seed";
    return unit.traits.seeded ? "uses the seed when scrambled" : "does not use the seed";
}

std::shared_ptr<const Json> shared(Json json) {
    return std::make_shared<const Json>(std::move(json));
}

/// Fields that records of several kinds share, if the type Unit has them.
template <class Unit>
UnitInfo base_info(const Unit& unit) {
    UnitInfo out{.name = unit.name, .summary = unit.summary, .source = unit.source};
    if constexpr (requires { unit.family; }) out.family = unit.family;
    if constexpr (requires { unit.strata; }) out.strata = unit.strata;
    if constexpr (requires { unit.aliases; }) out.aliases = unit.aliases;
    if constexpr (requires { unit.stream_version; }) out.stream_version = unit.stream_version;
    if constexpr (requires { unit.options; }) out.options = unit.options.options();
    return out;
}

UnitInfo info(const Generator& unit) {
    const auto& t = unit.traits;
    UnitInfo out = base_info(unit);
    out.traits = shared({{"min_dimension", t.min_dimension},
                         {"max_dimension", t.max_dimension},
                         {"sequence", t.sequence},
                         {"prefix", t.prefix},
                         {"seeded", t.seeded},
                         {"max_index", t.max_index}});
    out.remarks = {
        dimensions(t.min_dimension, t.max_dimension) +
            (t.more_dimensions.empty() ? "" : ", more with --" + t.more_dimensions),
        t.sequence ? "streams in constant memory" : "holds the whole set in memory",
        t.prefix ? "the first n points are the same for any count; accepts --start and --shard"
                 : "the points depend on the count; accepts --shard",
        seed_use(unit)};
    return out;
}

UnitInfo info(const Scramble& unit) {
    UnitInfo out = base_info(unit);
    out.traits = shared({{"min_dimension", 1}, {"max_dimension", any_dimension}, {"seeded", true}});
    out.remarks = {"any dimension", "uses the seed"};
    return out;
}

UnitInfo info(const Warp& unit) {
    const auto& t = unit.traits;
    UnitInfo out = base_info(unit);
    out.traits = shared({{"invertible", t.invertible}, {"drops", t.drops}, {"biased", t.biased}});
    out.remarks = {t.invertible ? "has an inverse" : "has no inverse"};
    if (t.drops) out.remarks.emplace_back("can drop points");
    if (t.biased) out.remarks.emplace_back("can be biased, on purpose");
    return out;
}

UnitInfo info(const Analyzer& unit) {
    const auto& t = unit.traits;
    UnitInfo out = base_info(unit);
    out.traits = shared({{"min_dimension", t.min_dimension},
                         {"max_dimension", t.max_dimension},
                         {"unit_cube", t.unit_cube},
                         {"boxed", t.boxed}});
    out.remarks = {dimensions(t.min_dimension, t.max_dimension),
                   t.unit_cube ? "takes points of the closed unit cube"
                   : t.boxed   ? "takes points of the unit cube or a box"
                               : "takes any domain"};
    out.results = unit.results;
    return out;
}

UnitInfo info(const Format& unit) {
    UnitInfo out = base_info(unit);
    const bool reads = unit.read != nullptr;
    out.traits = shared({{"extensions", unit.extensions},
                         {"reads", reads},
                         {"writes", unit.rows != nullptr},
                         {"binary", unit.traits.binary},
                         {"equal_sets", unit.traits.equal_sets},
                         {"min_dimension", unit.traits.min_dimension},
                         {"max_dimension", unit.traits.max_dimension}});
    out.remarks = {reads ? "read and write" : "write only",
                   unit.extensions.empty() ? "by name" : join(unit.extensions, " ")};
    return out;
}

template <class Unit>
Kind kind_of(std::string name, std::string verb, const std::vector<Unit>& units) {
    Kind kind{std::move(name), std::move(verb), {}};
    for (const Unit& unit : units) kind.units.push_back(info(unit));
    return kind;
}

constexpr const char* generators_verb = "generate";
constexpr const char* warps_verb = "warp";
constexpr const char* analyzers_verb = "analyze";

// Each kind is made at its first use: making all took a quarter of the time of a short command.
const Kind& generator_kind() {
    static const Kind kind = kind_of("generators", generators_verb, generators::all());
    return kind;
}

const Kind& analyzer_kind() {
    static const Kind kind = kind_of("analyzers", analyzers_verb, analyzers::all());
    return kind;
}

Json value_json(const Value& value) {
    return std::visit([](const auto& held) -> Json { return held; }, value);
}

Json option_json(const Option& option) {
    Json out = {{"name", option.name}, {"type", option.type}};
    out["default"] = option.optional ? Json(nullptr) : value_json(option.fallback);
    if (!option.range().empty() && option.type != "choice") out["range"] = option.range();
    if (!option.choices.empty()) out["choices"] = option.choices;
    if (!option.unit.empty()) out["unit"] = option.unit;
    out["help"] = option.help;
    return out;
}

Json unit_json(const UnitInfo& unit, std::string_view kind) {
    Json out = {{"name", unit.name},       {"aliases", unit.aliases}, {"summary", unit.summary},
                {"source", unit.source},   {"traits", *unit.traits},  {"remarks", unit.remarks},
                {"options", Json::array()}};
    if (!unit.family.empty()) out["family"] = unit.family;
    if (!unit.strata.empty()) out["strata"] = unit.strata;
    if (unit.stream_version > 0) out["stream_version"] = unit.stream_version;
    for (const Option& option : unit.options) out["options"].push_back(option_json(option));
    if (kind == "analyzers") {
        out["results"] = Json::array();
        for (const ResultKey& result : unit.results) {
            out["results"].push_back({{"key", result.key}, {"help", result.help}});
            if (result.better != Better::neither)
                out["results"].back()["better"] = word_of(result.better);
        }
    }
    return out;
}

}  // namespace

const std::vector<Kind>& catalog() {
    static const std::vector<Kind> all = {generator_kind(),
                                          kind_of("scrambles", warps_verb, scrambles::all()),
                                          kind_of("warps", warps_verb, warps::all()),
                                          analyzer_kind(), kind_of("formats", "", io::all())};
    return all;
}

const Kind* units_for(std::string_view verb) {
    if (verb == generators_verb || verb == "emit") return &generator_kind();
    if (verb == analyzers_verb) return &analyzer_kind();
    if (verb != warps_verb) return nullptr;
    static const Kind moving = [] {
        Kind both = kind_of("warps", warps_verb, scrambles::all());
        std::ranges::move(kind_of("warps", warps_verb, warps::all()).units,
                          std::back_inserter(both.units));
        return both;
    }();
    return &moving;
}

const UnitInfo* find_unit(const Kind& kind, std::string_view name) {
    for (const UnitInfo& unit : kind.units)
        if (unit.name == name || std::ranges::find(unit.aliases, name) != unit.aliases.end())
            return &unit;
    return nullptr;
}

std::vector<std::string> names_of(const Kind& kind) {
    std::vector<std::string> names;
    for (const UnitInfo& unit : kind.units) {
        names.push_back(unit.name);
        names.insert(names.end(), unit.aliases.begin(), unit.aliases.end());
    }
    return names;
}

const UnitInfo& unit_of(std::string_view verb, std::string_view name) {
    const Kind& kind = *units_for(verb);
    if (const UnitInfo* unit = find_unit(kind, name)) return *unit;
    const std::string singular = kind.name.substr(0, kind.name.size() - 1);
    refuse_unit(singular, name);
}

std::string option_usage(const Option& option) {
    if (option.type == "flag") return "--" + option.name;
    const std::string_view placeholder = option.type == "integer"   ? "N"
                                         : option.type == "number"  ? "X"
                                         : option.type == "choice"  ? "WORD"
                                         : option.type == "file"    ? "FILE"
                                         : option.type == "numbers" ? "X,Y,..."
                                         : option.type == "points"  ? "'X,Y X,Y ...'"
                                         : option.type == "extents" ? "NxM..."
                                                                    : "TEXT";
    return fmt::format("--{} {}", option.name, placeholder);
}

std::string option_notes(const Option& option) {
    std::vector<std::string> notes;
    if (!option.range().empty())
        notes.push_back(option.type == "choice" ? option.range() : "in " + option.range());
    if (!option.unit.empty()) notes.push_back(option.unit);
    if (!option.optional && option.type != "flag")
        notes.push_back("default " + format_value(option.fallback));
    return notes.empty() ? "" : " (" + join(notes, "; ") + ")";
}

Json json_of(const std::vector<Kind>& kinds) {
    Json out = {{"format", "stipple.list"}, {"version", 1}, {"stipple", STIPPLE_VERSION}};
    for (const Kind& kind : kinds) {
        out[kind.name] = Json::array();
        for (const UnitInfo& unit : kind.units)
            out[kind.name].push_back(unit_json(unit, kind.name));
    }
    return out;
}

}  // namespace stipple
