// SPDX-License-Identifier: MIT
//
// README cannot rot: its tables are the program's, its recipes run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "places.hpp"
#include "support/program.hpp"

using namespace stipple::testing;
using ::testing::HasSubstr;

namespace {

std::string readme() {
    std::ifstream in(STIPPLE_SOURCE_DIR "/README.md");
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The contents of all fenced blocks of a language.
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

}  // namespace

TEST(Readme, TablesAreTheRegistry) {
    const Sandbox box;
    const std::string text = readme();
    for (const char* kind : {"generators", "warps", "analyzers", "formats"})
        EXPECT_THAT(text, HasSubstr(box.run({"list", kind, "--markdown"}).out)) << kind;
}

// Blocks marked `sh` are recipes; they run in order in one folder. `console` blocks are not run.
TEST(Readme, RecipesRun) {
    const Sandbox box;
    const auto recipes = blocks(readme(), "sh");
    EXPECT_GT(recipes.size(), 5U);
    for (const std::string& recipe : recipes) {
        const Outcome outcome =
            box.shell("set -e; export PATH=" STIPPLE_SOURCE_DIR "/scripts:$PATH; " + recipe);
        EXPECT_EQ(outcome.code, 0) << recipe << outcome.err;
    }
}

TEST(Readme, NamesTheTwoCommands) {
    const auto commands = blocks(readme(), "console");
    ASSERT_GE(commands.size(), 2U);
    EXPECT_THAT(commands[0], HasSubstr("scripts/demo"));
    EXPECT_THAT(commands[1], HasSubstr("scripts/test"));
}
