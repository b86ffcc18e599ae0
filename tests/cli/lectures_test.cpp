// SPDX-License-Identifier: MIT
//
// The command files of data/lectures are correct: each passes unchanged, prints sentences that
// quote the slide, draws its picture, and fails with a changed number.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

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
    {"antialiasing", {"jittered 0.0559 0.0497 0.0621", "jittered 0.0683 0.0621 0.0745"}},
    {"cosine_hemisphere", {"mean_is 2/3 cosine", "mean_is 1/2 cosine"}},
    {"cube_root", {"mean_is 1/8 ", "mean_is 1/2 "}},
    {"dice", {"conditional 1/6 'x == 5'", "conditional 1/5 'x == 5'"}},
    {"discrete", {"share 0.5 3", "share 0.4 3"}},
    {"disk", {"half_radius 1/2 naive", "half_radius 1/4 naive"}},
    {"halton_100", {"value>0.050235", "value>0.051"}},
    {"latitude_longitude", {"mean_is 1/2 naive-lat-long", "mean_is 1/3 naive-lat-long"}},
    {"mixture", {"--exact 0.3 ", "--exact 0.31 "}},
    {"point_sets", {"relative_radius>0.7", "relative_radius>0.8"}},
    {"quadrature", {"'x^2' 0.0373 0.03317 0.04137", "'x^2' 0.025 0.02 0.03"}},
    {"radical_inverses", {"radical_inverse 7 0.875", "radical_inverse 7 0.75"}},
    {"rejection", {"-ge 52208", "-ge 52359"}},  // without its hole, the whole ball has pi/6
    {"square_directions", {"mean_is '3 - pi' ", "mean_is 0 "}},
    {"triangle_density", {"mean_is -1/36 ", "mean_is 0 "}},
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

    /// The picture that the command file drew; empty if there is none.
    [[nodiscard]] std::string picture() const {
        const std::string name = GetParam() + ".svg";
        return box_.exists(name) ? box_.read(name) : "";
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
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out, "") << "it shows no number";
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);)
        EXPECT_NE(line.find(" (slide: "), std::string::npos) << "not a sentence: " << line;
    EXPECT_NE(picture().find("<svg"), std::string::npos);
    EXPECT_LE(picture().size(), 60'000U);
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

TEST(Lectures, AreAllOnThePage) {
    const std::string page = text_of(folder / "README.md");
    EXPECT_EQ(lectures().size(), changes.size());
    for (const std::string& name : lectures()) {
        EXPECT_NE(page.find("$ sh data/lectures/" + name + ".sh\n"), std::string::npos) << name;
        EXPECT_NE(page.find("](pictures/" + name + ".svg)"), std::string::npos) << name;
    }
}

}  // namespace stipple::testing::lectures_test
