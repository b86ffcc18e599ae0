// SPDX-License-Identifier: MIT
//
// Data moves in one direction along the folders of src/; a folder includes only those to its left,
// and engines do not see each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "places.hpp"

namespace stipple::testing::layering_test {
namespace {

/// The folders of src/ in their order; those on one line do not include each other. The public API
/// comes first: its headers include nothing else.
const std::vector<std::vector<std::string>> line = {
    {"stipple"},  {"core"},   {"math"},
    {"media"},    {"io"},     {"generators", "scrambles", "warps", "analyzers"},
    {"pipeline"}, {"report"}, {"study"},
    {"plot"},     {"page"},   {"cli"}};

/// Folders whose folders are engines, which do not see each other.
const std::set<std::string> of_engines = {"generators", "warps", "analyzers"};

/// Where on the line a folder stands.
std::size_t place_of(const std::string& folder) {
    for (std::size_t i = 0; i < line.size(); ++i)
        if (std::ranges::find(line[i], folder) != line[i].end()) return i;
    return line.size();
}

/// "core" and "" of core/rng.hpp, "warps" and "planar" of warps/planar/disk.cpp.
std::pair<std::string, std::string> folders_of(const std::filesystem::path& path) {
    const std::vector<std::string> parts(path.begin(), path.end());
    return {parts.front(), parts.size() > 2 ? parts[1] : ""};
}

/// Whether a file below src/ may include another one.
bool may_include(const std::filesystem::path& file, const std::filesystem::path& included) {
    const auto [folder, engine] = folders_of(file);
    const auto [left, other] = folders_of(included);
    if (folder != left) return place_of(left) < place_of(folder);
    return !of_engines.contains(folder) || other.empty() || other == engine;
}

/// The sources and headers of a folder of src/.
std::vector<std::filesystem::path> files_of(const std::string& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(STIPPLE_SOURCE_DIR "/src/" + folder)) {
        const auto extension = entry.path().extension();
        if (extension == ".cpp" || extension == ".hpp") files.push_back(entry.path());
    }
    return files;
}

/// Includes of a file that it may not have.
std::vector<std::string> wrong_includes(const std::filesystem::path& file) {
    static const std::regex include(R"re(^\s*#\s*include\s*"([^"]+)")re");
    const auto inner = std::filesystem::relative(file, STIPPLE_SOURCE_DIR "/src");
    std::vector<std::string> wrong;
    std::ifstream in(file);
    std::smatch match;
    for (std::string text; std::getline(in, text);)
        if (std::regex_search(text, match, include) && !may_include(inner, match[1].str()))
            wrong.push_back(text);
    return wrong;
}

void expect_nowhere(const std::regex& forbidden, const std::string& folder) {
    for (const auto& file : files_of(folder)) {
        std::ifstream in(file);
        for (std::string text; std::getline(in, text);)
            EXPECT_FALSE(std::regex_search(text, forbidden)) << file << ": " << text;
    }
}

}  // namespace

TEST(Layering, EveryFileIncludesOnlyWhatStandsLeftOfIt) {
    std::size_t files = 0;
    for (const auto& place : line)
        for (const auto& folder : place)
            for (const auto& file : files_of(folder)) {
                ++files;
                for (const auto& text : wrong_includes(file)) ADD_FAILURE() << file << ": " << text;
            }
    EXPECT_GT(files, 40U);
}

TEST(Layering, NoFolderIsLeftOut) {
    for (const auto& entry : std::filesystem::directory_iterator(STIPPLE_SOURCE_DIR "/src"))
        EXPECT_TRUE(!entry.is_directory() || place_of(entry.path().filename()) < line.size())
            << entry.path();
}

// What the rule "only cli/ prints" means in code.
TEST(Layering, OnlyTheCommandLinePrintsOrExits) {
    const std::regex forbidden(
        R"(\b(std::cout|std::cerr|std::clog|printf\(|fmt::print|std::exit|std::abort|std::getenv)\b)");
    for (const auto& place : line)
        for (const auto& folder : place)
            if (folder != "cli") expect_nowhere(forbidden, folder);
}

// Names differ between libraries and machines; clocks and engines make points that nobody can
// repeat.
TEST(Layering, PointsComeFromNoClockAndNoStandardDistribution) {
    const std::regex forbidden(
        R"(std::(uniform_\w+_distribution|normal_distribution|random_device|default_random_engine)|std::chrono|\btime\(|\bclock\()");
    for (const char* folder :
         {"core", "math", "media", "generators", "scrambles", "warps", "analyzers"})
        expect_nowhere(forbidden, folder);
}

}  // namespace stipple::testing::layering_test
