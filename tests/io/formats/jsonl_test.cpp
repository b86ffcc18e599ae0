// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "io/io_support.hpp"

namespace stipple::testing::jsonl_test {
namespace {
const PointSet two = points_of({{0, 0.5}, {0.25, -1e-7}});
}

TEST(Jsonl, AMetaObjectThenAPointALine) {
    const std::string text = written("jsonl", {two}, {.provenance = some_provenance()});
    std::istringstream lines(text);
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    const auto object = nlohmann::json::parse(line);
    EXPECT_EQ(object["format"], "stipple.points");
    EXPECT_EQ(object["dimension"], 2);
    EXPECT_EQ(object["count"], 2);
    EXPECT_EQ(object["meta"]["seed"], 18446744073709551615U);
    EXPECT_FALSE(object.contains("set"));
    EXPECT_TRUE(text.ends_with("}\n[0,0.5]\n[0.25,-1e-07]\n")) << text;
    const auto sets = read_as("jsonl", text);
    EXPECT_EQ(sets.at(0), two);
    EXPECT_EQ(sets.at(0).provenance, some_provenance());
}

TEST(Jsonl, EverySetHasItsObject) {
    const std::vector<PointSet> sets{two, points_of({{1, 1}}), random_points(60'000, 2)};
    const std::string text = written("jsonl", sets);
    EXPECT_NE(text.find("\"count\":1,\"set\":1}\n[1,1]\n{"), std::string::npos);
    for (const unsigned threads : {1U, 3U})
        EXPECT_EQ(read_as("jsonl", text, {}, {.threads = threads}), sets);
}

TEST(Jsonl, TakesLinesOfPointsAlone) {
    EXPECT_EQ(read_as("jsonl", " [ 0 , 0.5 ] \r\n\n[0.25,-1e-7]").at(0), two);
    EXPECT_EQ(read_as("jsonl", "{}\n[0,0.5]\n[0.25,-1e-7]\n").at(0), two);
    EXPECT_EQ(read_as("jsonl", "[0.5]").at(0), points_of({{0.5}}));
}

TEST(Jsonl, ExtrasNameTheirColumns) {
    const std::string text = written("jsonl", {points_of({{1, 2, 9}})}, {.extras = {"pdf"}});
    EXPECT_EQ(read_as("jsonl", text).at(0), points_of({{1, 2}}));
    EXPECT_EQ(read_as("jsonl", text, {.columns = {"pdf"}}).at(0), points_of({{9}}));
}

TEST(Jsonl, RefusesWhatIsNoPoint) {
    const auto refused = [](std::string_view bytes) { return refusal("jsonl", bytes); };
    EXPECT_EQ(refused("[0,1]\n[0,1\n"), "input: p:2:5: the row ends too soon; expected ']'");
    EXPECT_EQ(refused("[0,1]\n0,1\n"), "input: p:2:1: expected a point such as [0.1,0.2]");
    EXPECT_EQ(refused("[0,1]\n[0,1],\n"),
              "input: p:2:6: ',' follows a point; expected the end of the line");
    EXPECT_EQ(refused("[0,1]\n[0,1,2]\n"),
              "input: p:2:6: the row has 3 fields; expected 2, as line 1 has");
    EXPECT_EQ(refused("[0,1]\n[0,NaN]\n"),
              "input: p:2:4: 'NaN' is not finite; expected a finite number");
    EXPECT_EQ(refused("[0,1]\n[]\n"), "input: p:2:2: an empty field; expected a number");
    EXPECT_EQ(
        refused("[0,1]\n[0,1e999]\n"),
        "input: p:2:4: '1e999' is beyond the largest double, 1.8e308; expected a finite number");
}

TEST(Jsonl, RefusesObjectsThatSayOtherwise) {
    const auto refused = [](std::string_view bytes) { return refusal("jsonl", bytes); };
    EXPECT_EQ(refused("{\"count\":3}\n[0,1]\n"),
              "input: p:1:1: the count is 3, but 1 points follow");
    EXPECT_EQ(refused("{}\n[0,1]\n{\"count\":2}\n[0,1]\n"),
              "input: p:3:1: the count is 2, but 1 points follow");
    EXPECT_EQ(refused("{\"dimension\":3}\n[0,1]\n"),
              "input: p:1:1: the dimension is 3, but the points have 2 coordinates");
    EXPECT_EQ(refused("{\"format\":\"other\"}\n[0,1]\n"),
              "input: p:1:1: the format is \"other\"; expected \"stipple.points\"");
    EXPECT_EQ(refused("{\"count\":}\n[0,1]\n"),
              "input: p:1:10: not JSON; expected a value such as 1, \"word\" or {}");
    EXPECT_EQ(refused("{}\n"),
              "input: p: the file holds no points; expected lines such as [0.1,0.2]");
    EXPECT_EQ(refused("{}\n[0,1]\n{}\n"),
              "input: p:3:1: a set without points; a line such as this separates two sets");
    EXPECT_EQ(refused(""), "input: p: the file is empty; expected points, one per line");
}

TEST(Jsonl, EverySetHasItsProvenance) {
    const std::vector<PointSet> sets{two, points_of({{1, 1}})};
    Provenance made = some_provenance();
    made.seed = 5;
    const std::string text = written("jsonl", sets, {.provenance = made});
    EXPECT_NE(text.find("\"seed\":6"), std::string::npos);
    EXPECT_EQ(read_as("jsonl", text).at(1).provenance.seed, 6U);
    EXPECT_EQ(read_as("jsonl", text + text).at(2).provenance.seed, 5U);
    EXPECT_EQ(refusal("jsonl",
                      "{\"columns\":[\"x\",\"y\"]}\n[1,2]\n{\"columns\":[\"y\",\"x\"]}\n"
                      "[3,4]\n"),
              "input: p:3:1: the columns are y, x; those of the first set are x, y");
}

}  // namespace stipple::testing::jsonl_test
