// SPDX-License-Identifier: MIT
//
// The command files of data/lectures are correct: each passes unchanged, and fails with a changed
// number.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "places.hpp"
#include "support/program.hpp"

namespace stipple::testing::lectures_test {
namespace {

const std::filesystem::path folder = STIPPLE_SOURCE_DIR "/data/lectures";

/// A line of a command file, or a unique part of one, and its replacement with another number.
struct Change {
    std::string before;
    std::string after;
};

const std::map<std::string, Change> changes = {
    {"antialiasing", {"errors jittered 0.0497 0.0621", "errors jittered 0.0621 0.0745"}},
    {"cosine_hemisphere", {"mean_is 0.6666666667 cosine", "mean_is 0.5 cosine"}},
    {"cube_root", {"mean_is 0.125 ", "mean_is 0.5 "}},
    {"dice", {"conditional 0.1666666667 'x == 5'", "conditional 0.2 'x == 5'"}},
    {"discrete", {"share 0.5 3", "share 0.4 3"}},
    {"disk", {"half_radius 0.5 naive", "half_radius 0.25 naive"}},
    {"halton_100", {"value>0.050235", "value>0.051"}},
    {"latitude_longitude", {"mean_is 0.5 naive-lat-long", "mean_is 0.3333333333 naive-lat-long"}},
    {"mixture", {"--exact 0.3 ", "--exact 0.31 "}},
    {"point_sets", {"relative_radius>0.7", "relative_radius>0.8"}},
    {"quadrature", {"errors random 64 'x^2' 0.03317 0.04137", "errors random 64 'x^2' 0.02 0.03"}},
    {"radical_inverses", {"estimate==0.875", "estimate==0.75"}},
    {"rejection", {"-ge 52208", "-ge 52359"}},  // without its hole, the whole ball has pi/6
    {"square_directions", {"mean_is -0.1415926536 ", "mean_is 0 "}},
    {"triangle_density", {"mean_is -0.0277777778 ", "mean_is 0 "}},
};

/// Names of the command files, without extensions.
std::vector<std::string> lectures() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".sh") names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    return names;
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

class Lecture : public ::testing::TestWithParam<std::string> {
  protected:
    /// Runs a command file in a directory of its own.
    [[nodiscard]] Outcome run(const std::string& commands) const {
        box_.write("lecture.sh", commands);
        return box_.shell("sh lecture.sh");
    }

    const std::string text = text_of(folder / (GetParam() + ".sh"));

  private:
    Sandbox box_;
};

INSTANTIATE_TEST_SUITE_P(All, Lecture, ::testing::ValuesIn(lectures()),
                         [](const auto& file) { return file.param; });

}  // namespace

TEST_P(Lecture, Holds) {
    const Outcome outcome = run(text);
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    EXPECT_NE(outcome.out, "") << "it shows no number";
}

TEST_P(Lecture, FailsWithAnotherNumber) {
    ASSERT_TRUE(changes.contains(GetParam())) << "no change is known that it must notice";
    const auto& [before, after] = changes.at(GetParam());
    const auto at = text.find(before);
    ASSERT_NE(at, std::string::npos) << before;
    ASSERT_EQ(text.find(before, at + 1), std::string::npos) << before << ": not the only one";
    const Outcome outcome = run(std::string(text).replace(at, before.size(), after));
    EXPECT_EQ(outcome.code, 1) << outcome.out << outcome.err;
}

TEST(Lectures, AreAllInTheTable) {
    const std::string table = text_of(folder / "README.md");
    EXPECT_EQ(lectures().size(), changes.size());
    for (const std::string& name : lectures())
        EXPECT_NE(table.find("| `" + name + ".sh` |"), std::string::npos) << name;
}

}  // namespace stipple::testing::lectures_test
