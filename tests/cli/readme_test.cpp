// SPDX-License-Identifier: MIT
//
// Keeps README and the guide up to date: their tables are the program's, their recipes run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "places.hpp"
#include "report/catalog.hpp"
#include "support/program.hpp"

namespace stipple::testing::readme_test {

using ::testing::HasSubstr;

namespace {

std::string page(const std::string& path) {
    std::ifstream in(STIPPLE_SOURCE_DIR "/" + path);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Contents of all fenced blocks of a language.
std::vector<std::string> blocks(const std::string& text, const std::string& language) {
    std::vector<std::string> found;
    const std::string fence = "```" + language + "\n";
    for (auto at = text.find(fence); at != std::string::npos; at = text.find(fence, at)) {
        at += fence.size();
        const auto end = text.find("```", at);
        found.push_back(text.substr(at, end - at));
    }
    return found;
}

/// Runs the blocks marked `sh` in order in one directory; returns their number.
std::size_t run_recipes(const std::string& path) {
    const Sandbox box;
    const auto recipes = blocks(page(path), "sh");
    for (const std::string& recipe : recipes) {
        const Outcome outcome =
            box.shell("set -e; export PATH=" STIPPLE_SOURCE_DIR "/scripts:$PATH; " + recipe);
        EXPECT_EQ(outcome.code, 0) << path << ": " << recipe << outcome.err;
    }
    return recipes.size();
}

}  // namespace

TEST(Readme, RecipesRun) { EXPECT_GE(run_recipes("README.md"), 5U); }

TEST(Readme, NamesTheTwoCommands) {
    const auto commands = blocks(page("README.md"), "console");
    ASSERT_GE(commands.size(), 2U);
    EXPECT_THAT(commands[0], HasSubstr("scripts/demo"));
    EXPECT_THAT(commands[1], HasSubstr("scripts/test"));
}

TEST(Guide, RecipesRun) {
    if (!STIPPLE_EXPERIMENTS) GTEST_SKIP() << "the guide is of all units";
    std::size_t recipes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(STIPPLE_SOURCE_DIR "/data/guide"))
        if (entry.is_regular_file())
            recipes += run_recipes("data/guide/" + entry.path().filename().string());
    EXPECT_GT(recipes, 15U);
}

TEST(Guide, TablesAreTheRegistry) {
    if (!STIPPLE_EXPERIMENTS) GTEST_SKIP() << "the guide is of all units";
    const Sandbox box;
    const std::string text = page("data/guide/units.md");
    for (const char* kind : {"generators", "scrambles", "warps", "analyzers", "formats"})
        EXPECT_TRUE(text.find(box.run({"list", kind, "--markdown"}).out) != std::string::npos)
            << "data/guide/units.md is not as 'stipple list " << kind
            << " --markdown': run scripts/update_guide";
}

TEST(Guide, GalleryHasAllGeneratorsAndWarps) {
    const std::string text = page("data/guide/gallery.md");
    for (const auto& kind : catalog()) {
        if (kind.name != "generators" && kind.name != "warps") continue;
        for (const auto& unit : kind.units)
            EXPECT_THAT(text, HasSubstr("- `" + unit.name + "`: ")) << "run scripts/gallery";
    }
    std::size_t pictures = 0;
    for (auto at = text.find("](../"); at != std::string::npos; at = text.find("](../", at + 1)) {
        const std::string file = text.substr(at + 5, text.find(')', at) - at - 5);
        EXPECT_TRUE(std::filesystem::exists(STIPPLE_SOURCE_DIR "/data/" + file)) << file;
        ++pictures;
    }
    EXPECT_GT(pictures, 10U);
}

// Results of other packages, compared by scripts/peers, which must also detect a wrong number.
TEST(Guide, OtherPackagesNumbersAreOurs) {
    if (!STIPPLE_EXPERIMENTS) GTEST_SKIP() << "the guide is of all units";
    const Sandbox box;
    const std::string peers = "python3 " STIPPLE_SOURCE_DIR "/scripts/peers ";
    const Outcome table = box.shell(peers + "$(command -v stipple)");
    EXPECT_EQ(table.code, 0) << table.err;
    EXPECT_EQ(table.err, "");
    EXPECT_THAT(table.out, HasSubstr("\nSciPy "));
    const Outcome wrong = box.shell(peers + "/bin/true");
    EXPECT_EQ(wrong.code, 1);
    EXPECT_THAT(page("data/guide/coming-from.md"), HasSubstr(good(box.shell(peers + "--guide"))))
        << "run scripts/update_guide";
}

}  // namespace stipple::testing::readme_test
