// SPDX-License-Identifier: MIT
#include "io/provenance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/io_support.hpp"

namespace stipple::testing::provenance_test {

TEST(ProvenanceJson, HasTheKeysOfTheContract) {
    const auto meta = io::to_json(some_provenance());
    std::vector<std::string> keys;
    for (const auto& [key, value] : meta.items()) keys.push_back(key);
    EXPECT_EQ(keys, (std::vector<std::string>{"tool", "version", "generator", "options", "seed",
                                              "count", "dimension", "start", "warps", "domain",
                                              "bounds", "shard", "command"}));
    EXPECT_EQ(meta["tool"], "stipple");
    const auto bare = io::to_json({});
    EXPECT_FALSE(bare.contains("bounds"));
    EXPECT_FALSE(bare.contains("shard"));
    EXPECT_EQ(bare["options"], nlohmann::ordered_json::object());
}

// Points of unknown origin have no seed, no start and no domain, except what is recorded of them.
TEST(ProvenanceJson, DoesNotInventWhatIsNotKnown) {
    const auto bare = io::to_json({});
    for (const char* key : {"seed", "start", "domain"}) EXPECT_TRUE(bare[key].is_null()) << key;
    EXPECT_EQ(io::provenance_from(bare), Provenance{});
    Provenance some;
    some.seed = 7;
    some.warps = {"owen:seed=3"};
    EXPECT_EQ(io::to_json(some)["seed"], 7);
    EXPECT_EQ(io::to_json(some)["domain"], "unit-cube");
    some.generator = "halton";
    EXPECT_EQ(io::to_json(some)["start"], 0);
    auto lost = io::to_json(some);
    lost["seed"] = nullptr;
    EXPECT_EQ(io::provenance_from(lost).flaw, "its seed cannot be 'null'");
}

TEST(ProvenanceJson, OptionsHaveTheTypeThatTheyLookLike) {
    const auto options = io::to_json(some_provenance())["options"];
    EXPECT_TRUE(options["base"].is_number_integer());
    EXPECT_TRUE(options["radius"].is_number_float());
    EXPECT_TRUE(options["toroidal"].is_boolean());
    EXPECT_EQ(options["method"], "polar");
    EXPECT_EQ(options["like-a-number"], "007");
    EXPECT_EQ(options["vertices"], "0,0 1,0 0,1");
}

TEST(ProvenanceJson, ReadsBack) {
    for (const char* text :
         {"1", "-5", "0.1", "1e-05", "1e+20", "1.0", "1e3", "9223372036854775807",
          "18446744073709551615", "nan", "true", "True", "", "0,5", "\xC3\xA4"}) {
        Provenance provenance = some_provenance();
        provenance.options = {{"a", text}};
        const std::string dumped = io::to_json(provenance).dump();
        EXPECT_EQ(io::provenance_from(nlohmann::ordered_json::parse(dumped)), provenance) << text;
    }
}

// Optional keys are written only if they have a value.
TEST(ProvenanceJson, ReadsBackWhatWasCutAndReadAndByWhichRules) {
    Provenance provenance = some_provenance();
    provenance.precision = 0;
    provenance.single = true;
    provenance.inputs = {{"dots.png", "0123456789abcdef"}, {"a: b", "00"}};
    provenance.stream_versions = {{"halton", 3}, {"owen", 2}};
    EXPECT_EQ(io::provenance_from(io::to_json(provenance)), provenance);
    Provenance lines;
    std::string text = io::to_comment_lines(provenance);
    for (std::size_t at = 0; at < text.size();) {
        const auto end = text.find('\n', at);
        EXPECT_TRUE(io::take_comment_line(text.substr(at + 2, end - at - 2), lines));
        at = end + 1;
    }
    EXPECT_EQ(lines, provenance);
    const auto plain = io::to_json(some_provenance());
    for (const char* key : {"precision", "dtype", "inputs", "stream_versions"})
        EXPECT_FALSE(plain.contains(key)) << key;
}

TEST(ProvenanceJson, IgnoresWhatItDoesNotUnderstand) {
    using Json = nlohmann::ordered_json;
    EXPECT_EQ(io::provenance_from(Json::parse("[1]")), Provenance{});
    auto wrong = io::provenance_from(
        Json::parse(R"({"seed":-1,"count":"many","generator":7,"warps":{},"options":[],"new":1})"));
    EXPECT_EQ(wrong.flaw, "its seed cannot be '-1'");
    wrong.flaw.clear();
    EXPECT_EQ(wrong, Provenance{});
    Provenance huge;
    EXPECT_TRUE(io::take_comment_line("seed: 1e999", huge));
    EXPECT_EQ(huge.flaw, "its seed cannot be '\"1e999\"'");
    const auto one =
        io::provenance_from(Json::parse(R"({"seed":3,"options":{"a":[1]},"warps":[1]})"));
    EXPECT_EQ(one.seed, 3U);
    EXPECT_TRUE(one.options.empty());
}

TEST(ProvenanceLines, ReadBack) {
    const std::string lines = io::to_comment_lines(some_provenance());
    Provenance back;
    for (std::size_t at = 0; at < lines.size();) {
        const auto end = lines.find('\n', at);
        const std::string line = lines.substr(at, end - at);
        ASSERT_TRUE(line.starts_with("# ")) << line;
        EXPECT_TRUE(io::take_comment_line(std::string_view(line).substr(2), back)) << line;
        at = end + 1;
    }
    EXPECT_EQ(back, some_provenance());
}

TEST(ProvenanceLines, OtherLinesAreLeftAlone) {
    Provenance provenance;
    for (const char* line : {"", "seed", "seed: ", "seed: x y", "colour: 3", "seed:3", ": 1"})
        EXPECT_FALSE(io::take_comment_line(line, provenance)) << line;
    EXPECT_EQ(provenance, Provenance{});
}

TEST(ProvenanceLines, BytesThatAreNoTextDoNoHarm) {
    Provenance provenance;
    provenance.command = "stipple -o \xFF.csv\n# seed: 1";
    const std::string lines = io::to_comment_lines(provenance);
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 11);
    EXPECT_NE(lines.find("\\n# seed: 1"), std::string::npos) << lines;
}

}  // namespace stipple::testing::provenance_test
