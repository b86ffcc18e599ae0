// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/io_support.hpp"

namespace stipple::testing::json_test {
namespace {

const PointSet two = points_of({{0, 0.5}, {0.25, -1e-7}});

std::string refused(std::string_view bytes, const ReadOptions& options = {}) {
    return refusal("json", bytes, options);
}

std::string with(const std::string& keys) {
    return "{" + keys + "\"points\":[[0,0.5],[0.25,-1e-7]]}";
}

}  // namespace

TEST(Json, HasTheKeysOfTheContractInOrder) {
    const std::string text = written("json", {two}, {.provenance = some_provenance()});
    const auto object = nlohmann::ordered_json::parse(text);
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    EXPECT_EQ(keys, (std::vector<std::string>{"format", "version", "meta", "dimension", "count",
                                              "points"}));
    EXPECT_EQ(object["format"], "stipple.points");
    EXPECT_EQ(object["version"], 1);
    EXPECT_EQ(object["dimension"], 2);
    EXPECT_EQ(object["count"], 2);
    EXPECT_EQ(object["points"], nlohmann::ordered_json::parse("[[0,0.5],[0.25,-1e-7]]"));
    EXPECT_EQ(object["meta"]["generator"], "halton");
    EXPECT_TRUE(text.ends_with("\"points\":[\n[0,0.5],\n[0.25,-1e-07]\n]}\n")) << text;
}

TEST(Json, SeveralSetsStandInPlaceOfThePoints) {
    const std::string equal = written("json", {two, two});
    auto object = nlohmann::json::parse(equal);
    EXPECT_FALSE(object.contains("points"));
    EXPECT_EQ(object["count"], 2);
    EXPECT_EQ(object["sets"].size(), 2U);
    EXPECT_EQ(object["sets"][1][0], nlohmann::json::parse("[0,0.5]"));

    const std::vector<PointSet> sets{two, points_of({{1, 1}}), random_points(30, 2)};
    object = nlohmann::json::parse(written("json", sets));
    EXPECT_EQ(object["count"], nlohmann::json::parse("[2,1,30]"));
    EXPECT_EQ(read_as("json", written("json", sets)), sets);
}

TEST(Json, ReadsBackPointsAndProvenance) {
    const PointSet points = random_points(20'000, 3);
    const auto sets = read_as("json", written("json", {points}, {.provenance = some_provenance()}));
    ASSERT_EQ(sets.size(), 1U);
    EXPECT_EQ(sets[0], points);
    EXPECT_EQ(sets[0].provenance, some_provenance());
    const auto zero = read_as("json", written("json", {points_of({{-0.0}})})).at(0);
    EXPECT_TRUE(std::signbit(zero[0][0]));
}

TEST(Json, ExtrasNameTheirColumns) {
    const std::string text = written("json", {points_of({{1, 2, 9}})}, {.extras = {"pdf"}});
    const auto object = nlohmann::json::parse(text);
    EXPECT_EQ(object["columns"], nlohmann::json::parse(R"(["x","y","pdf"])"));
    EXPECT_EQ(object["dimension"], 2);
    EXPECT_EQ(read_as("json", text).at(0), points_of({{1, 2}}));
    EXPECT_EQ(read_as("json", text, {.columns = {"pdf"}}).at(0), points_of({{9}}));
}

TEST(Json, TakesKeysInAnyOrderAndIgnoresTheUnknown) {
    EXPECT_EQ(read_as("json",
                      " { \"points\" : [ [ 0 , 0.5 ] ,\r\n\t[0.25,-1E-7]] , \"count\":2,"
                      "\"note\":{\"a]\\\"}\":[1,[2]]},\"dimension\":2} \n")
                  .at(0),
              two);
    EXPECT_EQ(read_as("json", "\xEF\xBB\xBF" + with("")).at(0), two);
}

TEST(Json, TakesBareArrays) {
    EXPECT_EQ(read_as("json", "[[0,0.5],[0.25,-1e-7]]").at(0), two);
    EXPECT_EQ(read_as("json", "[[[0,0.5],[0.25,-1e-7]],[[1,1]]]").size(), 2U);
    EXPECT_EQ(read_as("json", "[[1,2,3]]", {.columns = {"3", "x"}}).at(0), points_of({{3, 1}}));
}

TEST(Json, RefusesWhatIsNoPoint) {
    EXPECT_EQ(refused("[[0,0.5],[0.25,NaN]]"),
              "input: p:1:16: found 'NaN'; expected a finite number");
    EXPECT_EQ(
        refused("[[0,0.5],\n[0.25,1e999]]"),
        "input: p:2:7: '1e999' is beyond the largest double, 1.8e308; expected a finite number");
    EXPECT_EQ(refused("[[0,0.5],\n[0.25,\"1\"]]"),
              "input: p:2:7: found '\"1\"'; expected a finite number");
    EXPECT_EQ(refused("[[0,0.5],\n[0.25,null]]"),
              "input: p:2:7: found 'null'; expected a finite number");
    EXPECT_EQ(refused("[[0,.5]]"), "input: p:1:5: found '.5'; expected a finite number");
    EXPECT_EQ(refused("[[0,]]"), "input: p:1:5: found ']'; expected a finite number");
    EXPECT_EQ(refused("[[]]"), "input: p:1:3: found ']'; expected a finite number");
    EXPECT_EQ(refused("[[0 1]]"), "input: p:1:5: found '1'; expected ',' or ']'");
    EXPECT_EQ(refused("[[0,1],2]"), "input: p:1:8: found '2'; expected a point such as [0.1,0.2]");
    EXPECT_EQ(refused("[[0,0.5],\n[0.25,1,2]]"),
              "input: p:2:1: the point has 3 coordinates; expected 2, as the first has");
    EXPECT_EQ(refused("[[0,0.5],\n[0.25]]"),
              "input: p:2:1: the point has 1 coordinate; expected 2, as the first has");
}

TEST(Json, RefusesWhatIsNoFileOfPoints) {
    EXPECT_EQ(refused(""), "input: p: the file is empty; expected points, one per line");
    EXPECT_EQ(refused("{}"),
              "input: p: the object has neither \"points\" nor \"sets\"; expected "
              "\"points\":[[0.1,0.2],...]");
    EXPECT_EQ(refused("{\"points\":[]}"),
              "input: p:1:12: a set without points; expected [0.1,0.2],...");
    EXPECT_EQ(refused("{\"sets\":[]}"),
              "input: p:1:10: found ']'; expected a list of points such as [[0.1,0.2],...]");
    EXPECT_EQ(refused("{\"sets\":[[[1]],[]]}"),
              "input: p:1:17: a set without points; expected [0.1,0.2],...");
    EXPECT_EQ(refused(with("\"format\":\"stipple.report\",")),
              "input: p:1:11: the format is \"stipple.report\"; expected \"stipple.points\"");
    const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
    EXPECT_EQ(
        refused(with("\"format\":" + deep + ",")),
        "input: p:1:31: lists are nested too deeply; expected a value such as 1, \"word\" or {}");
    EXPECT_EQ(
        refused(with("\"version\":" + deep + ",")),
        "input: p:1:32: lists are nested too deeply; expected a value such as 1, \"word\" or {}");
    EXPECT_EQ(refused(with("\"version\":2,")),
              "input: p:1:12: version 2 of stipple.points; expected 1");
    EXPECT_EQ(refused(with("\"count\":3,")), "input: p:1:10: the count is 3, but 2 points follow");
    EXPECT_EQ(refused(with("\"count\":1,")), "input: p:1:10: the count is 1, but 2 points follow");
    EXPECT_EQ(refused(with("\"count\":[2,2],")),
              "input: p:1:10: the count is given for 2 sets, but 1 follow");
    EXPECT_EQ(refused(with("\"count\":-1,")),
              "input: p:1:10: the count is not a number of points such as 1024");
    EXPECT_EQ(refused(with("\"dimension\":3,")),
              "input: p:1:14: the dimension is 3, but the points have 2 coordinates");
    EXPECT_EQ(refused(with("\"dimension\":0,")),
              "input: p:1:14: the dimension is not a number such as 2");
    EXPECT_EQ(refused(with("\"columns\":[\"x\"],")),
              "input: p: 1 columns are named; the points have 2 numbers");
    EXPECT_EQ(refused(with("\"meta\":{\"seed\":01},")),
              "input: p:1:18: not JSON; expected a value such as 1, \"word\" or {}");
    EXPECT_EQ(refused("{\"points\":[[1]],\"points\":[[1]]}"),
              "input: p:1:26: points occur twice; expected them once");
    EXPECT_EQ(refused(with("") + " x"),
              "input: p:1:35: 'x' follows the points; expected the end of the file");
    EXPECT_EQ(refused("[[1,2,3]]", {.dimension = 2}),
              "input: p: points have 3 coordinates; --dimension is 2 | --column picks columns by "
              "name or number");
    EXPECT_EQ(refused("[1,2]"), "input: p:1:2: found '1'; expected a point such as [0.1,0.2]");
    EXPECT_EQ(refused("hello"),
              "input: p:1:1: found 'hello'; expected {\"format\":\"stipple.points\",...} or "
              "[[0.1,0.2],...]");
}

TEST(Json, RefusesEveryTruncation) {
    const std::string text = written("json", {two, two}, {.provenance = some_provenance()});
    for (std::size_t size = 1; size + 1 < text.size(); ++size)
        EXPECT_NE(refused(text.substr(0, size)), "") << text.substr(0, size);
    EXPECT_EQ(refused(text.substr(0, text.size() - 4)),
              "input: p:7:1: the file ends too soon; expected ',' or ']'");
}

TEST(Json, SurvivesDeepNesting) {
    const std::string deep(100'000, '[');
    EXPECT_NE(refused(deep), "");
    EXPECT_NE(refused("{\"meta\":" + deep), "");
    // The parser copies a value recursively if another key follows it.
    EXPECT_EQ(
        refused(with("\"meta\":{\"options\":{\"a\":" + deep + std::string(100'000, ']') +
                     ",\"b\":1},\"seed\":1},")),
        "input: p:1:43: lists are nested too deeply; expected a value such as 1, \"word\" or {}");
}

TEST(Json, TakesRecords) {
    const auto read = [](const std::string& text, const ReadOptions& options = {}) {
        return read_as("json", text, options).at(0);
    };
    const std::string records =
        R"([{"a":1,"name":"q","b":2}, {"b":-3e1,"a":0.5,"name":null}, {"a":0,"b":3,"name":[1]}])";
    EXPECT_EQ(read(R"([{"a":1,"b":2},{"b":-3e1,"a":0.5}])"), points_of({{1, 2}, {0.5, -30}}));
    const PointSet picked = read(records, {.columns = {"b", "a"}});
    EXPECT_EQ(picked, points_of({{2, 1}, {-30, 0.5}, {3, 0}}));
    EXPECT_EQ(picked.provenance.columns, (std::vector<std::string>{"b", "a"}));
    EXPECT_EQ(read(R"([{"x":1}])"), points_of({{1}}));
    EXPECT_EQ(io::format_of_bytes(R"([{"x":1}])").name, "json");
    EXPECT_EQ(refused(records),
              "input: p:1:16: found '\"q\"'; expected a finite number, or --column with the names "
              "of other columns");
    EXPECT_EQ(refused(R"([{"a":1},{"b":1}])"),
              "input: p:1:12: 'b' is not a name of the first record");
    EXPECT_EQ(refused(R"([{"a":1,"b":2},{"b":1}])"),
              "input: p:1:16: the record has 1 of the 2 names of the first record");
    EXPECT_EQ(refused(R"([{"a":1,"a":2}])"), "input: p:1:10: the name occurs twice");
    EXPECT_EQ(refused(R"([{"a":1},{"a":1,"a":2}])"), "input: p:1:18: the name occurs twice");
    EXPECT_EQ(
        refused(R"([{"a":1e999}])"),
        "input: p:1:7: '1e999' is beyond the largest double, 1.8e308; expected a finite number");
    for (std::size_t size = 1; size < records.size(); ++size)
        EXPECT_NE(refused(records.substr(0, size), {.columns = {"a"}}), "");
}

TEST(Json, KeepsTheNamesOfColumns) {
    Layout layout{.dimension = 2};
    layout.provenance.columns = {"age", "income"};
    const std::string text = written("json", {two}, layout);
    EXPECT_THAT(text, ::testing::HasSubstr(R"("columns":["age","income"])"));
    EXPECT_EQ(read_as("json", text).at(0).provenance.columns, layout.provenance.columns);
    EXPECT_EQ(read_as("json", text, {.columns = {"income"}}).at(0), points_of({{0.5}, {-1e-7}}));
    // Names that are not valid in headers are replaced, singly.
    layout.provenance.columns = {"set", "\x1b[31m"};
    EXPECT_EQ(read_as("json", written("json", {two}, layout)).at(0).provenance.columns.size(), 0U);
    layout.provenance.columns = {"age", "nan"};
    EXPECT_EQ(read_as("json", written("json", {two}, layout)).at(0).provenance.columns,
              (std::vector<std::string>{"age", "y"}));
}

TEST(Json, AColumnNumbersTheSets) {
    const std::vector<PointSet> sets{points_of({{0.1, 0.2}, {0.3, 0.4}}), points_of({{0.5, 0.6}})};
    for (const char* text :
         {R"([{"set":1,"x":0.1,"y":0.2},{"set":0,"x":0.5,"y":0.6},{"set":1,"x":0.3,"y":0.4}])",
          R"({"columns":["set","x","y"],"points":[[1,0.1,0.2],[0,0.5,0.6],[1,0.3,0.4]]})"})
        EXPECT_EQ(read_as("json", text), sets) << text;
    EXPECT_EQ(read_as("jsonl",
                      "{\"columns\":[\"set\",\"x\",\"y\"]}\n[1,0.1,0.2]\n[0,0.5,0.6]\n"
                      "[1,0.3,0.4]\n"),
              sets);
    EXPECT_EQ(refusal("json", R"([{"set":0.5,"x":0.1}])"),
              "input: p: point 0: 0.5 is not the number of a set; expected 0, 1, 2...");
}

}  // namespace stipple::testing::json_test
