// SPDX-License-Identifier: MIT
#include "study/study_config.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "places.hpp"
#include "support/units.hpp"

namespace stipple::testing::study_config_test {

using stipple::testing::error_of;

namespace {

std::string error_in(const std::string& json) {
    return error_of([&] { parse_study_config(json, "s.json"); });
}

/// Error of a valid configuration with one more key.
std::string error_with(const std::string& key) {
    return error_in(R"({"generators": ["random"], "analyze": ["moments"], )" + key + "}");
}

}  // namespace

TEST(StudyConfig, SaysWhatTheOptionsWouldSay) {
    const auto settings = parse_study_config(R"({
        "comment": "two samplers",
        "generators": ["random", {"name": "sobol", "options": {"scramble": "owen"}}],
        "analyze": "star-discrepancy",
        "warp": [{"name": "triangle", "options": {"vertices": [[0, 0], [2, 0], [0, 1]]}}],
        "count": [16, "2^5..2^6"], "dimension": 2, "seeds": 1e3, "seed": 18446744073709551615,
        "keys": ["value", "exact"], "curves": false, "seconds": false, "summary": true,
        "time-limit": 2.5
    })",
                                             "s.json");
    const StudySettings expected = {{"generators", "random"},
                                    {"generators", "sobol:scramble=[owen]"},
                                    {"analyze", "star-discrepancy"},
                                    {"warp", "triangle:vertices=[0,0 2,0 0,1]"},
                                    {"count", "16,2^5..2^6"},
                                    {"dimension", "2"},
                                    {"seeds", "1000"},
                                    {"seed", "18446744073709551615"},
                                    {"keys", "value,exact"},
                                    {"no-seconds", "true"},
                                    {"summary", "true"},
                                    {"time-limit", "2.5"}};
    EXPECT_EQ(settings, expected);
}

TEST(StudyConfig, ErrorsNameThePlaceAndWhatIsNearest) {
    EXPECT_EQ(error_with(R"("seads": 3)"),
              "input: s.json: $.seads: there is no such key | did you mean 'seeds'?");
    EXPECT_EQ(error_in(R"({"generators": ["random", "sobl"], "analyze": "moments"})"),
              "input: s.json: $.generators[1]: unknown generator 'sobl' | did you mean 'sobol'?");
    EXPECT_EQ(error_in(R"({"generators": [{"name": "sobol", "options": {"scrmble": "owen"}}],
                           "analyze": "moments"})")
                  .substr(0, 57),
              "input: s.json: $.generators[0].options.scrmble: unknown o");
    EXPECT_EQ(error_in(R"({"generators": [{"nam": "sobol"}], "analyze": "moments"})"),
              "input: s.json: $.generators[0].nam: there is no such key | did you mean 'name'?");
    EXPECT_EQ(error_with(R"("count": [{"from": 1}])"),
              "input: s.json: $.count: expected a word, a number, true, false or a list, got "
              "'{\"from\":1}'");
    EXPECT_EQ(error_with(R"("curves": 1)"),
              "input: s.json: $.curves: expected true or false, got '1'");
    EXPECT_EQ(error_with("\"count\": " + std::string(100'000, '[') + std::string(100'000, ']')),
              "input: s.json:1:80: lists are nested too deeply");
    EXPECT_EQ(error_in(R"({"generators": []})"),
              "input: s.json: $.generators: expected a list of specs such as "
              "\"sobol:scramble=owen\"");
    EXPECT_EQ(error_in(R"({"generators": "random"})"),
              "input: s.json: $: the key 'analyze' is missing");
    EXPECT_EQ(error_in("[1]"), "input: s.json: $: expected an object, {\"generators\": ...}");
    EXPECT_EQ(error_in("{\n \"a\": ,"), "input: s.json:2:7: not JSON");
    EXPECT_EQ(error_in(""), "input: s.json:1:1: not JSON");
    EXPECT_EQ(error_in("{\n \"a\": 1e999}"),
              "input: s.json:2:7: the number '1e999' is out of the range of a double");
}

TEST(StudyConfig, KeysThatStandTwiceAreRefused) {
    EXPECT_EQ(error_with(R"("seeds": 3, "seeds": 4)"),
              "input: s.json: $.seeds: the key occurs twice");
    EXPECT_EQ(error_in(R"({"generators": [{"name": "sobol", "options": {"scramble": "owen",
                           "scramble": "none"}}], "analyze": "moments"})"),
              "input: s.json: $.generators.options.scramble: the key occurs twice");
    // The same key in different objects is valid.
    EXPECT_NO_THROW(parse_study_config(
        R"({"generators": [{"name": "sobol"}, {"name": "halton"}], "analyze": "moments"})", ""));
}

TEST(StudyConfig, TheSchemaHasTheSameKeys) {
    std::ifstream in(STIPPLE_SOURCE_DIR "/data/study.schema.json");
    const auto schema = nlohmann::json::parse(in);
    std::set<std::string> written;
    for (const auto& [name, value] : schema["properties"].items()) written.insert(name);
    std::set<std::string> known = {"$schema", "comment"};
    for (const auto& name : study_config_keys()) known.insert(name);
    EXPECT_EQ(written, known);
}

}  // namespace stipple::testing::study_config_test
