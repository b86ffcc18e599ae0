// SPDX-License-Identifier: MIT
#include "cli/help.hpp"

#include <fftw3.h>
#include <fmt/format.h>
#include <oneapi/tbb/version.h>
#include <png.h>

#include <CLI/Version.hpp>
#include <algorithm>
#include <boost/version.hpp>

#include "cli/topics.hpp"
#include "core/text.hpp"
#include "math/densities/expression.hpp"
#include "pipeline/ranks.hpp"

namespace stipple::cli {
namespace {

std::string line(const std::string& left, const std::string& right) {
    if (left.size() <= 26) return fmt::format("  {:<26}  {}\n", left, right);
    return fmt::format("  {}\n  {:<26}  {}\n", left, "", right);
}

std::string common_lines(Verb verb) {
    std::string text;
    for (const CommonOption& option : common_options()) {
        if (!takes(option, verb)) continue;
        std::string names = option.names;
        if (names.starts_with("--")) names.insert(0, "    ");
        replace_all(names, ",", ", ");
        if (*option.value != '\0') names += std::string(" ") + option.value;
        std::string help = option.help;
        if (option.repeatable) help += "; repeatable";
        if (*option.fallback != '\0') help += fmt::format(" (default {})", option.fallback);
        text += line(names, help);
    }
    return text + line("-h, --help", "this text");
}

std::string help_program() {
    std::string text =
        "stipple makes sample sets, warps them, and judges them.\n\n"
        "Usage: stipple VERB ... [OPTIONS]\n\nVerbs:\n";
    for (const VerbInfo& info : verbs())
        text += fmt::format("  {:<10} {}\n", info.name, info.summary);
    text += "\nTopics ('stipple help TOPIC'):\n";
    for (const Topic& topic : topics())
        text += fmt::format("  {:<18} {}\n", topic.name, topic.summary);
    text +=
        "\n'stipple VERB --help' says everything about a verb, 'stipple VERB UNIT --help' about a "
        "unit.\n"
        "'stipple --version' names the libraries that are linked.\n\n"
        "Exit codes: 0 done; 1 a check did not hold; 2 wrong usage; 3 bad input; 4 cannot read or\n"
        "write; 5 over a limit; 130 interrupted ('stipple help exit-codes').\n";
    return text;
}

std::string capitalised(std::string text) {
    if (!text.empty())
        text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

std::string verb_help(const VerbInfo& info, const std::vector<Kind>& kinds) {
    std::string text = fmt::format("stipple {}: {}\n\nUsage: {}\n\n{}\n", info.name, info.summary,
                                   info.usage, info.text);
    for (const Kind& kind : kinds) {
        if (kind.verb != info.name) continue;
        text += fmt::format("\n{}:\n", capitalised(kind.name));
        for (const UnitInfo& unit : kind.units)
            text += fmt::format("  {:<18} {}\n", unit.name, unit.summary);
    }
    if (units_for(kinds, info.name))
        text += fmt::format("'stipple {} UNIT --help' shows a unit's own options.\n", info.name);
    text += "\nOptions:\n" + common_lines(info.verb);
    return text + "\nExamples:\n" + info.examples;
}

std::string help_unit(const VerbInfo& info, const UnitInfo& unit) {
    std::string usage = info.usage;
    const auto word = usage.find(' ', sizeof "stipple");
    const auto end = usage.find(' ', word + 1);
    usage.replace(word + 1, end - word - 1, unit.name);
    std::string text =
        fmt::format("{}: {}\n\nUsage: {}\n\nSource: {}\n{}.\n", unit.name, unit.summary, usage,
                    unit.source, capitalised(join(unit.remarks, "; ")));
    if (!unit.strata.empty()) text += fmt::format("Strata: {}.\n", unit.strata);
    if (!unit.aliases.empty()) text += fmt::format("Also called {}.\n", join(unit.aliases, ", "));
    const auto own = own_options(info.verb, unit);
    if (!own.empty()) {
        text += fmt::format("\nOptions of {}:\n", unit.name);
        for (const Option& option : own)
            text += line("    " + option_usage(option), option.help + option_notes(option));
    }
    if (!unit.results.empty()) {
        text += "\nResults:\n";
        for (const auto& [key, help] : unit.results) text += line(key, help);
    }
    return text + fmt::format("\nOptions of {}:\n", info.name) + common_lines(info.verb) + "\n" +
           info.text + "\n";
}

}  // namespace

std::string help_text(const Arguments& arguments, const std::vector<Kind>& kinds) {
    if (!arguments.verb) return help_program();
    const VerbInfo& info = *std::ranges::find(verbs(), *arguments.verb, &VerbInfo::verb);
    if (arguments.unit.empty()) return verb_help(info, kinds);
    return help_unit(info, unit_of(kinds, info.name, arguments.unit));
}

std::string version_text() {
    return fmt::format(
        "stipple {}\nCLI11 {}, fmt {}.{}.{}, nlohmann-json {}.{}.{}, {}, oneTBB {}.{}, Boost "
        "{}.{}.{}, Random123 {}, libpng {}, muParser {}, {}\n",
        STIPPLE_VERSION, CLI11_VERSION, FMT_VERSION / 10000, FMT_VERSION / 100 % 100,
        FMT_VERSION % 100, NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
        NLOHMANN_JSON_VERSION_PATCH, fftw_version, TBB_VERSION_MAJOR, TBB_VERSION_MINOR,
        BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100, RANDOM123_VERSION,
        PNG_LIBPNG_VER_STRING, muparser_version(), has_mpi() ? mpi_version() : "without MPI");
}

}  // namespace stipple::cli
