// SPDX-License-Identifier: MIT
//
// Keeps README and the guide up to date. Tests of CTest named guide/PAGE run the commands of each page.
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

}  // namespace

// A newcomer's first command shows what it prints; then come the two commands that set everything up.
TEST(Readme, NamesTheTwoCommands) {
    const auto commands = blocks(page("README.md"), "console");
    ASSERT_EQ(commands.size(), 3U);
    EXPECT_TRUE(commands[0].starts_with("$ stipple "));
    EXPECT_EQ(commands[1], "scripts/demo\n");
    EXPECT_EQ(commands[2], "scripts/test\n");
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
}

}  // namespace stipple::testing::readme_test
