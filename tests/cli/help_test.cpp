// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/parsing/arguments.hpp"
#include "cli/parsing/catalog.hpp"
#include "support/program.hpp"

namespace stipple::testing::help_test {

using namespace stipple::cli;
using ::testing::HasSubstr;

TEST(Help, EveryVerbAndUnitHasItFromTheRecord) {
    const Sandbox box;
    EXPECT_THAT(box.run({"--help"}).out, HasSubstr("generate"));
    for (const VerbInfo& verb : verbs()) {
        const Outcome outcome = box.run({verb.name, "--help"});
        EXPECT_EQ(outcome.code, 0);
        EXPECT_THAT(outcome.out, HasSubstr(verb.summary));
        EXPECT_THAT(outcome.out, HasSubstr("Examples:"));
    }
    for (const Kind& kind : catalog())
        for (const UnitInfo& unit : kind.units) {
            if (kind.verb.empty()) continue;
            const Outcome outcome = box.run({kind.verb, unit.name, "-h"});
            EXPECT_EQ(outcome.code, 0);
            EXPECT_THAT(outcome.out, HasSubstr(unit.summary));
            for (const auto& option : unit.options)
                EXPECT_THAT(outcome.out, HasSubstr("--" + option.name)) << unit.name;
        }
}

// Two options of one name could not be told apart. (A scramble's seed is for specs; where the verb
// takes one, it is that.)
TEST(Help, NoUnitOptionHidesACommonOne) {
    for (const Kind& kind : catalog())
        for (const VerbInfo& verb : verbs()) {
            if (kind.verb != verb.name) continue;
            std::set<std::string> common;
            for (const CommonOption* option : options_of(verb.verb))
                EXPECT_TRUE(common.insert(option->option.name).second) << option->names;
            for (const UnitInfo& unit : kind.units)
                for (const auto& option : unit.options)
                    EXPECT_EQ(common.contains(option.name),
                              kind.name == "scrambles" && option.name == "seed")
                        << unit.name << ' ' << option.name;
        }
}

TEST(Help, ExamplesRun) {
    const Sandbox box;
    ASSERT_EQ(
        box.shell("stipple generate random -n 500 -d 3 -o table.csv && stipple generate random -n "
                  "500 -o points.csv && cp points.csv a.csv && cp points.csv b.csv && stipple "
                  "generate random -d 3 -o points.bin")
            .code,
        0);
    for (const VerbInfo& verb : verbs()) {
        std::istringstream lines(verb.examples);
        for (std::string line; std::getline(lines, line);) {
            const Outcome outcome = box.shell(line);
            const bool checks = line.find("--check") != std::string::npos;
            EXPECT_TRUE(outcome.code == 0 || (checks && outcome.code == 1)) << line << outcome.err;
        }
        // The examples of later verbs read what those of earlier ones made, on the unit square.
        if (verb.verb != Verb::generate) continue;
        EXPECT_EQ(box.shell("stipple generate random -n 500 -o points.csv").code, 0);
    }
}

TEST(Help, VersionNamesTheLibraries) {
    const Sandbox box;
    const Outcome outcome = box.run({"--version"});
    EXPECT_TRUE(outcome.out.starts_with("stipple ")) << outcome.out;
    for (const char* name : {"CLI11", "fmt", "nlohmann-json", "fftw", "oneTBB", "Boost",
                             "Random123", "libpng", "muParser"})
        EXPECT_THAT(outcome.out, HasSubstr(name));
}

TEST(List, IsTheWholeRegistry) {
    const Sandbox box;
    const auto out = nlohmann::json::parse(box.run({"list", "--json"}).out);
    EXPECT_EQ(out["format"], "stipple.list");
    for (const Kind& kind : catalog()) {
        ASSERT_EQ(out[kind.name].size(), kind.units.size());
        for (std::size_t i = 0; i < kind.units.size(); ++i) {
            EXPECT_EQ(out[kind.name][i]["name"], kind.units[i].name);
            EXPECT_EQ(out[kind.name][i]["options"].size(), kind.units[i].options.size());
            const bool makes = kind.name != "analyzers" && kind.name != "formats";
            EXPECT_EQ(out[kind.name][i].contains("stream_version"), makes);
        }
        const Outcome one = box.run({"list", kind.name});
        EXPECT_TRUE(one.out.starts_with(kind.name + "\n")) << one.out;
        EXPECT_EQ(box.run({"list", kind.name.substr(0, kind.name.size() - 1)}).out, one.out);
    }
    EXPECT_EQ(box.run({"list", "nonsense"}).code, 2);
}

TEST(List, SaysThatLegacyGeneratorsAreSequential) {
    const Sandbox box;
    EXPECT_THAT(box.run({"list", "generators"}).out, HasSubstr("sequential"));
}

TEST(Help, SaysWhatDomainsAnAnalyzerTakes) {
    const Sandbox box;
    for (const auto& [unit, domains] :
         {std::pair{"star-discrepancy", "takes points of the closed unit cube"},
          {"coverage", "takes points of the unit cube or a box"},
          {"poisson-disk", "takes points of the unit cube or a box"},
          {"nearest-neighbor", "takes any domain"}}) {
        EXPECT_THAT(box.run({"analyze", unit, "--help"}).out, HasSubstr(domains)) << unit;
        EXPECT_THAT(box.run({"list", "analyzers"}).out, HasSubstr(domains)) << unit;
    }
    const auto all = nlohmann::json::parse(box.run({"list", "--json"}).out);
    const std::set<std::string> boxed = {"coverage",         "differential", "hyperuniformity",
                                         "pair-correlation", "periodogram",  "poisson-disk",
                                         "voronoi"};
    for (const auto& unit : all["analyzers"])
        EXPECT_EQ(unit["traits"]["boxed"], boxed.contains(unit["name"])) << unit["name"];
}

}  // namespace stipple::testing::help_test
