// SPDX-License-Identifier: MIT
#include "pipeline/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

/// Whether a word is the unit's name or one of its aliases.
template <class Unit>
bool is_called(const Unit& unit, std::string_view name) {
    if constexpr (requires { unit.aliases; })
        if (std::ranges::find(unit.aliases, name) != unit.aliases.end()) return true;
    return unit.name == name;
}

template <class Unit>
const Unit* try_unit(const std::vector<Unit>& units, std::string_view name) {
    const auto it =
        std::ranges::find_if(units, [&](const Unit& unit) { return is_called(unit, name); });
    return it == units.end() ? nullptr : &*it;
}

template <class Unit>
const Unit& find_unit(std::string_view kind, const std::vector<Unit>& units,
                      std::string_view name) {
    if (const Unit* unit = try_unit(units, name)) return *unit;
    refuse_unit(kind, name);
}

/// Calls visit(kind, unit) for all units.
template <class Visit>
void for_each_unit(const Visit& visit) {
    for (const Generator& unit : generators::all()) visit("generator", unit);
    for (const Warp& unit : warps::all()) visit("warp", unit);
    for (const Scramble& unit : scrambles::all()) visit("scramble", unit);
    for (const Analyzer& unit : analyzers::all()) visit("analyzer", unit);
}

/// Names that are nearest to a word, at most one for each unit.
/// @param unit_of the unit's name for each name and alias
std::vector<std::string> near_names(const std::map<std::string, std::string>& unit_of,
                                    std::string_view word) {
    std::vector<std::string> all;
    for (const auto& [name, unit] : unit_of) all.push_back(name);
    std::vector<std::string> near = nearest_words(word, all);
    std::set<std::string> units;
    std::erase_if(near, [&](const auto& name) { return !units.insert(unit_of.at(name)).second; });
    return near;
}

}  // namespace

void refuse_unit(std::string_view kind, std::string_view name) {
    std::string word = lower_case(name);
    std::ranges::replace(word, '_', '-');
    std::vector<std::string> related;            // units that list the word as related
    std::map<std::string, std::string> unit_of;  // names of units, by their names and aliases
    for_each_unit([&](std::string_view own, const auto& unit) {
        if (own != kind && is_called(unit, word))
            fail_with_hint(
                ErrorKind::usage,
                fmt::format("'{}' is the name of a{} {}", word, own == "analyzer" ? "n" : "", own),
                "unknown {} '{}'", kind, name);
        if (own != kind && !(kind == "warp" && own == "scramble")) return;
        if (std::ranges::count(unit.related, word) > 0) related.push_back(unit.name);
        unit_of.emplace(unit.name, unit.name);
        if constexpr (requires { unit.aliases; })
            for (const std::string& alias : unit.aliases) unit_of.emplace(alias, unit.name);
    });
    if (!related.empty())
        fail_with_hint(ErrorKind::usage,
                       fmt::format("nearest {} {}", related.size() == 1 ? "is" : "are",
                                   quoted_list(related, "and")),
                       "there is no {} '{}'", kind, name);
    const auto near = near_names(unit_of, word);
    fail_with_hint(ErrorKind::usage,
                   near.empty() ? fmt::format("'stipple list {}s' names them", kind)
                                : fmt::format("did you mean {}?", quoted_list(near, "or")),
                   "unknown {} '{}'", kind, name);
}

const Generator& find_generator(std::string_view name) {
    return find_unit("generator", generators::all(), name);
}
const Warp& find_warp(std::string_view name) { return find_unit("warp", warps::all(), name); }
const Generator* generator_named(std::string_view name) {
    return try_unit(generators::all(), name);
}
const Scramble* scramble_named(std::string_view name) { return try_unit(scrambles::all(), name); }
const Analyzer& find_analyzer(std::string_view name) {
    return find_unit("analyzer", analyzers::all(), name);
}

DomainPtr read_parameters(const std::string& path, const RunContext& run) {
    const auto unit = std::ranges::find_if(
        warps::all(), [](const Warp& warp) { return static_cast<bool>(warp.read); });
    if (unit == warps::all().end())
        fail(ErrorKind::usage, "--parameters: this program was built without STIPPLE_EXPERIMENTS");
    return unit->read(path, run);
}

Spec in_unit_cube(Spec parameters) {
    parameters.settings.emplace_back("unit-cube", "true");
    return parameters;
}

std::string unlike_prefixes(const Provenance& made) {
    const Generator* generator = generator_named(made.generator);
    const std::pair<std::string, std::string> progressive{"order", "progressive"};
    if (generator == nullptr || generator->traits.prefix ||
        std::ranges::find(made.options, progressive) != made.options.end())
        return {};
    return fmt::format(
        "the points of {} depend on the count: a prefix differs from a set of fewer points",
        generator->name);
}

void complete(Provenance& provenance) {
    const Generator* generator = generator_named(provenance.generator);
    provenance.independent = generator != nullptr && generator->traits.independent;
}

namespace {

/// Position of the next option, "-" after a blank and before a letter or "-", outside brackets.
std::size_t next_option(std::string_view text, std::size_t from) {
    int open = 0;
    for (std::size_t i = from; i + 2 < text.size(); ++i) {
        open += text[i] == '[' ? 1 : text[i] == ']' ? -1 : 0;
        const char after = text[i + 2];
        if (open == 0 && text[i] == ' ' && text[i + 1] == '-' &&
            (after == '-' || std::isalpha(static_cast<unsigned char>(after)) != 0))
            return i + 1;
    }
    return text.size();
}

/// Adds an option such as "-w disk" or "--scramble owen". @param whole for messages
void take_option(std::string_view option, std::string_view whole, GeneratorSpec& found) {
    const auto end = std::min(option.find_first_of(" ="), option.size());
    const std::string_view name = option.substr(0, end);
    std::string_view value = trim(option.substr(std::min(end + 1, option.size())));
    if (name == "-w" || name == "--warp") {
        if (value.empty()) fail(ErrorKind::usage, "'{}': {} needs a warp", whole, name);
        found.warps.emplace_back(value);
        return;
    }
    if (!name.starts_with("--") || name.size() == 2)
        fail_with_hint(ErrorKind::usage, "only -w WARP and the generator's --OPTIONs may follow it",
                       "'{}': {} is not understood", whole, name);
    if (value.starts_with('[') && value.ends_with(']')) value = value.substr(1, value.size() - 2);
    found.unit.settings.emplace_back(name.substr(2), value.empty() ? "true" : value);
}

}  // namespace

GeneratorSpec parse_generator(std::string_view text) {
    const std::string_view whole = trim(text);
    std::size_t at = next_option(whole, 0);
    GeneratorSpec found{.unit = parse_spec(trim(whole.substr(0, at)))};
    while (at < whole.size()) {
        const std::size_t end = next_option(whole, at);
        take_option(trim(whole.substr(at, end - at)), whole, found);
        at = end;
    }
    return found;
}

std::string format_own_warps(const std::vector<std::string>& warps) {
    std::string text;
    for (const std::string& warp : warps) text += " -w " + warp;
    return text;
}

}  // namespace stipple
