// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/parsing/arguments.hpp"
#include "cli/terminal.hpp"
#include "core/text.hpp"
#include "math/fourier/fft.hpp"
#include "report/catalog.hpp"
#include "support/program.hpp"

namespace stipple::testing::help_test {

using namespace stipple::cli;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

namespace {

std::string one_line(const std::string& text) { return filled(text, text.size()); }

}  // namespace

TEST(Help, EveryVerbAndUnitHasItFromTheRecord) {
    const Sandbox box;
    EXPECT_THAT(box.run({"--help"}).out, HasSubstr("generate"));
    for (const VerbInfo& verb : verbs()) {
        const Outcome outcome = box.run({verb.name, "--help"});
        EXPECT_EQ(outcome.code, 0);
        EXPECT_THAT(one_line(outcome.out), HasSubstr(verb.summary));
        EXPECT_THAT(outcome.out, HasSubstr("Examples:"));
    }
    for (const Kind& kind : catalog())
        for (const UnitInfo& unit : kind.units) {
            if (kind.verb.empty()) continue;
            const Outcome outcome = box.run({kind.verb, unit.name, "-h"});
            EXPECT_EQ(outcome.code, 0);
            EXPECT_THAT(one_line(outcome.out), HasSubstr(unit.summary));
            for (const auto& option : unit.options)
                EXPECT_THAT(outcome.out, HasSubstr("--" + option.name)) << unit.name;
        }
}

// Two options with one name could not be distinguished. (A scramble's seed is an option in specs;
// for verbs with --seed, it is that.)
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

// The examples of each verb run in order in an empty folder.
TEST(Help, ExamplesRun) {
    for (const VerbInfo& verb : verbs()) {
        const Sandbox box;
        std::istringstream lines(verb.examples);
        for (std::string line; std::getline(lines, line);) {
            const Outcome outcome = box.shell(line);
            EXPECT_EQ(outcome.code, 0) << line << '\n' << outcome.err;
        }
    }
}

TEST(Help, VersionNamesTheLibraries) {
    const Sandbox box;
    const Outcome outcome = box.run({"--version"});
    EXPECT_TRUE(outcome.out.starts_with("stipple ")) << outcome.out;
    for (const char* name :
         {"CLI11", "fmt", "nlohmann-json", "oneTBB", "Boost", "Random123", "libpng"})
        EXPECT_THAT(outcome.out, HasSubstr(name));
    EXPECT_THAT(outcome.out, HasSubstr(fft_library()));
    EXPECT_THAT(outcome.out, HasSubstr(fft_library().starts_with("fftw")
                                           ? "this program, with FFTW in it, under the GPL"
                                           : "under the MIT licence; so is this program"));
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
        EXPECT_TRUE(one.out.starts_with(kind.name)) << one.out;
        const std::string all = good(box.run({"list", kind.name, "--long"}));
        for (const UnitInfo& unit : kind.units) {
            EXPECT_THAT(one.out,
                        HasSubstr("\n  " + unit.name + (unit.name.size() < 21 ? " " : "\n")));
            EXPECT_THAT(all, HasSubstr("\n  " + unit.name + "\n"));
            for (const Option& option : unit.options)
                EXPECT_THAT(all, HasSubstr("\n    " + option_usage(option)));
        }
        EXPECT_EQ(box.run({"list", kind.name.substr(0, kind.name.size() - 1)}).out, one.out);
    }
    expect_refusal(box.run({"list", "nonsense"}), 2, "unknown kind 'nonsense'; known: generators");
    for (const std::string word : {"disk", "discrepancy", "poisson-disk"}) {
        const std::string help = "'stipple help " + word + "' explains it; known: generators";
        EXPECT_THAT(box.run({"list", word}).err, HasSubstr(help));
    }
}

TEST(Help, NamesTheOtherUnitOfTheSameName) {
    const Sandbox box;
    EXPECT_THAT(good(box.run({"help", "poisson-disk"})),
                EndsWith("\n\n'stipple analyze poisson-disk --help' is about the analyzer of this "
                         "name.\n"));
    EXPECT_THAT(good(box.run({"analyze", "poisson-disk", "--help"})),
                EndsWith("\n\n'stipple generate poisson-disk --help' is about the generator of "
                         "this name.\n"));
    EXPECT_THAT(good(box.run({"help", "halton"})), Not(HasSubstr("of this name")));
}

// Also with long tags, multi-byte letters, and words that are too long.
TEST(Help, FillsLines) {
    EXPECT_EQ(filled("one two\nthree  four", 9), "one two\nthree\nfour");
    EXPECT_EQ(filled("one two three", 11, 4), "one two\n    three");
    EXPECT_EQ(filled("\u00e9\u00e9\u00e9 \u00e9\u00e9\u00e9", 7),
              "\u00e9\u00e9\u00e9 \u00e9\u00e9\u00e9");
    EXPECT_EQ(filled("unbreakable word", 3), "unbreakable\nword");
    EXPECT_EQ(filled(" \n ", 9), "");
    EXPECT_EQ(beside("  -n N", "points in a set", 20, 10),
              "  -n N    points in\n          a set\n");
    EXPECT_EQ(beside("  --long-name", "it", 20, 10), "  --long-name\n          it\n");
    EXPECT_EQ(filled_page("# A title that is long\n\nOne two\nthree.\n- an item\n  of two lines\n"
                          "12. next\n\n    code  as it is\n| a | table |\nend\n",
                          14),
              "# A title that is long\n\nOne two three.\n- an item of\n  two lines\n12. next\n\n"
              "    code  as it is\n| a |\n    table |\nend\n");
}

// A terminal with 60 columns; output to a pipe has 80. Words, commands and examples are not broken.
TEST(Help, FitsTheTerminal) {
    const Sandbox box;
    if (box.shell("script -qec true /dev/null").code != 0)
        GTEST_SKIP() << "this system's script is not that of util-linux";
    const auto longest = [](const std::string& text) {
        std::size_t most = 0;
        for (const auto line : split(text, '\n'))
            if (line.find("stipple") == line.npos) most = std::max(most, code_points(line).size());
        return most;
    };
    for (const char* words : {"list", "list --long", "--help", "generate --help",
                              "analyze star-discrepancy --help", "help security"}) {
        const std::string piped = good(box.shell(fmt::format("stipple {} | cat", words)));
        EXPECT_LE(longest(piped), 80U) << words;
        const std::string narrow = good(box.shell(
            fmt::format("script -qec 'stty cols 60; stipple {}' /dev/null | tr -d '\\r'", words)));
        EXPECT_LE(longest(narrow), 60U) << words;
        EXPECT_GT(longest(piped), 60U) << words;
    }
}

// By letters, ignoring case; by terms of the field; by kind.
TEST(Help, FindsTheUnitThatIsMeant) {
    const Sandbox box;
    const auto says = [&](const std::vector<std::string>& words) {
        const Outcome outcome = box.run(words);
        EXPECT_EQ(outcome.code, 2);
        return outcome.err;
    };
    EXPECT_EQ(says({"generate", "Halton"}),
              "stipple: unknown generator 'Halton'; did you mean 'halton'?\n");
    EXPECT_EQ(says({"generate", "LHS"}), "stipple: unknown generator 'LHS'; did you mean 'lhs'?\n");
    EXPECT_EQ(says({"generate", "korobov"}),
              "stipple: there is no generator 'korobov'; nearest is 'rank1-lattice'\n");
    EXPECT_EQ(says({"generate", "blue_noise"}),
              "stipple: there is no generator 'blue_noise'; nearest are 'gaussian-blue-noise', "
              "'poisson-disk' and 'sample-elimination'\n");
    EXPECT_EQ(says({"analyze", "FFT", "-"}),
              "stipple: there is no analyzer 'FFT'; nearest is 'periodogram'\n");
    EXPECT_THAT(says({"analyze", "spectrum"}), HasSubstr("nearest is 'periodogram'"));
    EXPECT_THAT(says({"analyze", "d-star"}), HasSubstr("nearest is 'star-discrepancy'"));
    EXPECT_THAT(says({"analyze", "minimum-distance"}), HasSubstr("nearest is 'nearest-neighbor'"));
    EXPECT_THAT(says({"generate", "maximin"}),
                HasSubstr("nearest are 'farthest-point' and 'latin-hypercube'"));
    EXPECT_THAT(says({"generate", "disk"}), HasSubstr("'disk' is the name of a warp"));
    EXPECT_THAT(says({"warp", "spherical"}),
                HasSubstr("did you mean 'spherical-cap', 'spherical-rectangle' or "
                          "'spherical-triangle'?"));
    EXPECT_THAT(says({"generate", "qqqq"}), HasSubstr("'stipple list generators' names them"));
    EXPECT_THAT(says({"generate"}), HasSubstr("'stipple list generators' names them"));
    const Outcome nothing = box.run({});
    EXPECT_EQ(nothing.code, 2);
    EXPECT_EQ(nothing.out, "");
    EXPECT_EQ(nothing.err, good(box.run({"--help"})));
}

TEST(List, SaysThatLegacyGeneratorsAreSequential) {
    const Sandbox box;
    EXPECT_THAT(one_line(box.run({"list", "generators"}).out),
                HasSubstr("by a counter or by older engines"));
}

TEST(Help, SaysWhatDomainsAnAnalyzerTakes) {
    const Sandbox box;
    for (const auto& [unit, domains] :
         {std::pair{"star-discrepancy", "takes points of the closed unit cube"},
          {"coverage", "takes points of the unit cube or a box"},
          {"poisson-disk", "takes points of the unit cube or a box"},
          {"nearest-neighbor", "takes any domain"}}) {
        EXPECT_THAT(box.run({"analyze", unit, "--help"}).out, HasSubstr(domains)) << unit;
        EXPECT_THAT(one_line(box.run({"list", "analyzers", "--long"}).out), HasSubstr(domains))
            << unit;
    }
    const auto all = nlohmann::json::parse(box.run({"list", "--json"}).out);
    const std::set<std::string> boxed = {"coverage",        "design",           "differential",
                                         "hyperuniformity", "pair-correlation", "periodogram",
                                         "poisson-disk",    "voronoi"};
    for (const auto& unit : all["analyzers"])
        EXPECT_EQ(unit["traits"]["boxed"], boxed.contains(unit["name"])) << unit["name"];
}

// Help shows a picture of a unit's points, unless that needs a file.
TEST(Help, ShowsPointsInLetters) {
    const Sandbox box;
    const auto dots = [&](const std::string& unit) {
        const std::string help = good(box.run({"help", unit}));
        const auto at = help.find("Picture:\n");
        return at == std::string::npos ? std::string()
                                       : help.substr(at, help.find("Options of", at) - at);
    };
    EXPECT_THAT(dots("halton"), HasSubstr("⠄"));
    EXPECT_NE(dots("halton"), dots("random"));
    EXPECT_THAT(dots("sphere"), HasSubstr("z upward"));
    EXPECT_EQ(dots("image"), "");
    EXPECT_EQ(dots("owen"), "");
    EXPECT_EQ(dots("moments"), "");
}

TEST(Help, KnowsTheNamesOfOtherPackages) {
    const Sandbox box;
    const std::vector<std::pair<const char*, const char*>> names = {
        {"fast_forward", "--start 2"},
        {"random_base2", "-n 2^2 --order gray"},
        {"fill_space", "--radius 0.4 --bounded"},
        {"update_discrepancy", "l2-discrepancy five.csv --kind centered"},
        {"geometric_discrepancy", "spanning-tree five.csv"},
        {"qmc.integers", "stipple warp integers --low 0"},
        {"qmc LatinHypercube", "stipple generate latin-hypercube"},
        {"scipy.stats.qmc Halton", "stipple generate halton"}};
    for (const auto& [name, command] : names)
        EXPECT_THAT(good(box.shell(std::string("stipple help ") + name)),
                    AllOf(StartsWith("SciPy\n"), HasSubstr(command)))
            << name;
    EXPECT_EQ(good(box.run({"help", "van_der_corput"})), good(box.run({"help", "van-der-corput"})));
    EXPECT_EQ(box.run({"help", "qmc", "nothing"}).code, 2);
    for (const char* name : {"rng", "QMCEngine", "qmc.QMCEngine", "MultinomialQMC", "stipple.qmc",
                             "MultivariateNormalQMC", "Engine", "reset", "check_random_state"}) {
        const std::string page = good(box.shell(std::string("stipple help ") + name));
        EXPECT_THAT(page, HasSubstr("SciPy's interface")) << name;
        EXPECT_THAT(page, HasSubstr("'stipple help python' is the whole page.")) << name;
    }
    EXPECT_THAT(good(box.run({"help", "max_memory"})), HasSubstr("four fifths"));
}

// Only analyze accepts lists of units; help is available for all these words.
TEST(Help, OfWordsThatOnlyBeginWithAUnit) {
    const Sandbox box;
    for (const std::string word : {"generate 'sobol;x'", "generate sobol,halton", "warp 'disk;y'",
                                   "analyze 'moments;'", "analyze moments,nobody"}) {
        const Outcome outcome = box.shell("stipple " + word + " --help");
        EXPECT_TRUE(outcome.code == 0 || outcome.code == 2) << word << outcome.code;
        EXPECT_EQ(box.shell("stipple " + word + " < /dev/null").code, 2) << word;
    }
}

}  // namespace stipple::testing::help_test
