// SPDX-License-Identifier: MIT
#include "core/json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace stipple::testing::json_text_test {
namespace {

std::string brackets(std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
}

std::string refused(const std::string& text) {
    EXPECT_TRUE(try_parse_json(text).is_discarded()) << text.substr(0, 80);
    try {
        parse_json(text);
    } catch (const JsonError& error) {
        return std::to_string(error.at) + ": " + error.what();
    }
    return "none";
}

}  // namespace

TEST(JsonText, ExtentEndsWithTheValueAtTheFront) {
    EXPECT_EQ(json_extent(R"({"a":[1,"]}\"]"]} [2])").size, 17U);
    EXPECT_EQ(json_extent("12,13").size, 2U);
    EXPECT_EQ(json_extent("\"a,b\"}").size, 5U);
    for (const char* open : {"", "12", "[1,2", "{\"a\":\"}", "[\"\\"})
        EXPECT_EQ(json_extent(open).size, std::string_view::npos) << open;
    EXPECT_EQ(json_extent(brackets(21)).too_deep, 20U);
    EXPECT_EQ(json_extent("[" + brackets(19) + "," + brackets(19) + "]").size, 79U);
}

TEST(JsonText, WhatIsNoJsonIsRefusedWithItsPlace) {
    EXPECT_EQ(parse_json("{\"a\":[1,null]}").size(), 1U);
    EXPECT_EQ(try_parse_json(brackets(20)), parse_json(brackets(20)));
    EXPECT_EQ(refused("[1,x]"), "3: not JSON");
    EXPECT_EQ(refused("[1,1e999]"), "3: the number '1e999' is out of the range of a double");
}

// The parser copies a value recursively if another key follows it.
TEST(JsonText, WhatIsTooDeepIsRefusedBeforeItIsParsed) {
    EXPECT_EQ(refused(brackets(21)), "20: lists are nested too deeply");
    EXPECT_EQ(refused("{\"a\":{\"b\":" + brackets(200'000) + ",\"c\":2}}"),
              "28: lists are nested too deeply");
}

}  // namespace stipple::testing::json_text_test
