// SPDX-License-Identifier: MIT
//
// The verb `list`: all units as text or JSON.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/terminal.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::cli {
namespace {

/// Lists each unit in one or two lines, by families.
std::string list_text(const std::vector<Kind>& kinds) {
    constexpr std::size_t names = 24;  // columns before a unit's summary
    const std::size_t columns = text_columns();
    std::string text;
    for (const Kind& kind : kinds) {
        std::map<std::string, std::string> families;
        for (const UnitInfo& unit : kind.units)
            families[unit.family] += beside("  " + unit.name, unit.summary, columns, names);
        for (const auto& [family, lines] : families)
            text += fmt::format("{}{}{}{}\n{}", text.empty() ? "" : "\n", kind.name,
                                family.empty() ? "" : ": ", family, lines);
    }
    return text + "\n'stipple help UNIT' documents a unit, 'stipple list --long' all options.\n";
}

/// Each unit with its traits and options.
std::string list_long(const std::vector<Kind>& kinds) {
    constexpr std::size_t options = 27;  // columns before an option's explanation
    const std::size_t columns = text_columns();
    std::string text;
    for (const Kind& kind : kinds) {
        text += fmt::format("{}{}\n", text.empty() ? "" : "\n", kind.name);
        for (const UnitInfo& unit : kind.units) {
            const auto add = [&](const std::string& sentence) {
                text += fmt::format("    {}\n", filled(sentence, columns, 4));
            };
            text += fmt::format("  {}\n", unit.name);
            add(unit.summary);
            add(fmt::format("[{}]", join(unit.remarks, "; ")));
            if (!unit.aliases.empty()) add("also called " + join(unit.aliases, ", "));
            for (const Option& option : unit.options)
                text += beside("    " + option_usage(option), option.help + option_notes(option),
                               columns, options);
        }
    }
    return text;
}

}  // namespace

int ListRequest::perform(Session&) const {
    std::vector<Kind> kinds = catalog();
    if (inputs.size() > 1)
        fail(ErrorKind::usage, "list takes one KIND; {} are given", inputs.size());
    if (!inputs.empty()) {
        const std::string& wanted = inputs[0];
        std::erase_if(kinds, [&](const Kind& kind) {
            return kind.name != wanted && kind.name != wanted + "s";
        });
        const auto explained = explained_words();
        const bool other = std::ranges::find(explained, wanted) != explained.end();
        if (kinds.empty())
            fail_with_hint(ErrorKind::usage,
                           (other ? fmt::format("'stipple help {}' explains it; ", wanted) : "") +
                               "known: generators, scrambles, warps, analyzers, formats",
                           "unknown kind '{}'", wanted);
    }
    write_text(output.value_or("-"), json   ? json_of(kinds).dump(2) + "\n"
                                     : full ? list_long(kinds)
                                            : list_text(kinds));
    return 0;
}

}  // namespace stipple::cli
