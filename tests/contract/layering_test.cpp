// SPDX-License-Identifier: MIT
//
// Data moves in one direction along the folders of src/; a folder includes only those to its left.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "places.hpp"

namespace {

/// A line of folders, and the units, which don't see each other.
std::map<std::string, std::set<std::string>> folders_to_the_left() {
    std::map<std::string, std::set<std::string>> allowed;
    std::set<std::string> left;
    const auto next = [&](const std::vector<std::string>& side_by_side) {
        for (const auto& folder : side_by_side) allowed[folder] = left;
        left.insert(side_by_side.begin(), side_by_side.end());
    };
    next({"core"});
    next({"math"});
    next({"media"});
    next({"io"});
    next({"generators", "scrambles", "warps", "analyzers"});
    next({"pipeline"});
    next({"report", "study"});
    next({"plot"});
    next({"page"});
    next({"cli"});
    return allowed;
}

const std::map<std::string, std::set<std::string>> allowed = folders_to_the_left();

/// Includes of a file that its folder may not have.
std::vector<std::string> wrong_includes(const std::filesystem::path& file,
                                        const std::string& folder) {
    static const std::regex include(R"re(^\s*#\s*include\s*"([^"/]+)/[^"]*")re");
    std::vector<std::string> wrong;
    std::ifstream in(file);
    std::smatch match;
    for (std::string line; std::getline(in, line);)
        if (std::regex_search(line, match, include) && match[1] != folder &&
            !allowed.at(folder).contains(match[1]))
            wrong.push_back(line);
    return wrong;
}

}  // namespace

TEST(Layering, EveryFolderIncludesOnlyFoldersToItsLeft) {
    std::size_t files = 0;
    for (const auto& [folder, left] : allowed)
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(STIPPLE_SOURCE_DIR "/src/" + folder)) {
            if (!entry.is_regular_file()) continue;
            ++files;
            for (const auto& line : wrong_includes(entry.path(), folder))
                ADD_FAILURE() << entry.path() << ": " << line;
        }
    EXPECT_GT(files, 40U);
}

TEST(Layering, NoFolderIsLeftOut) {
    for (const auto& entry : std::filesystem::directory_iterator(STIPPLE_SOURCE_DIR "/src"))
        EXPECT_TRUE(!entry.is_directory() || allowed.contains(entry.path().filename().string()))
            << entry.path();
}

// What the rule "only cli/ prints" means in code.
TEST(Layering, OnlyTheCommandLinePrintsOrExits) {
    const std::regex forbidden(
        R"(\b(std::cout|std::cerr|std::clog|printf\(|fmt::print|std::exit|std::abort|std::getenv)\b)");
    for (const auto& [folder, left] : allowed) {
        if (folder == "cli") continue;
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(STIPPLE_SOURCE_DIR "/src/" + folder)) {
            std::ifstream in(entry.path());
            for (std::string line; std::getline(in, line);)
                EXPECT_FALSE(std::regex_search(line, forbidden)) << entry.path() << ": " << line;
        }
    }
}

// Names differ between libraries and machines; clocks and engines make points that nobody can
// repeat.
TEST(Layering, PointsComeFromNoClockAndNoStandardDistribution) {
    const std::regex forbidden(
        R"(std::(uniform_\w+_distribution|normal_distribution|random_device|default_random_engine)|std::chrono|\btime\(|\bclock\()");
    for (const char* folder :
         {"core", "math", "media", "generators", "scrambles", "warps", "analyzers"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(
                 std::string(STIPPLE_SOURCE_DIR "/src/") + folder)) {
            std::ifstream in(entry.path());
            for (std::string line; std::getline(in, line);)
                EXPECT_FALSE(std::regex_search(line, forbidden)) << entry.path() << ": " << line;
        }
}
