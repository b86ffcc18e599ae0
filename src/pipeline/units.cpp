// SPDX-License-Identifier: MIT
#include "pipeline/units.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

/// Whether a unit is called so, by its own name or another.
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
    std::vector<std::string> names;
    for (const Unit& unit : units) {
        names.push_back(unit.name);
        if constexpr (requires { unit.aliases; })
            names.insert(names.end(), unit.aliases.begin(), unit.aliases.end());
    }
    if constexpr (std::is_same_v<Unit, Warp>)
        for (const Scramble& scramble : scrambles::all()) names.push_back(scramble.name);
    fail_with_hint(ErrorKind::usage, suggest(name, names), "unknown {} '{}'", kind, name);
}

}  // namespace

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

void complete(Provenance& provenance) {
    const Generator* generator = generator_named(provenance.generator);
    provenance.independent = generator != nullptr && generator->traits.independent;
}

}  // namespace stipple
