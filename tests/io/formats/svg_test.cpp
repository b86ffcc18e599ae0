// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "io/io_support.hpp"

namespace stipple::testing::svg_test {

// The unit square is 1000 units wide in a margin of 20, and y points up.
TEST(Svg, PointsStandWhereTheyAre) {
    const std::string text = written("svg", {points_of({{0, 0}, {1, 0.25}})});
    EXPECT_NE(text.find("viewBox=\"0 0 1040 1040\""), std::string::npos) << text;
    EXPECT_NE(text.find("<title>2 points</title>"), std::string::npos);
    EXPECT_NE(text.find("<circle cx=\"20.0\" cy=\"1020.0\" r=\"10.00\"/>\n"
                        "<circle cx=\"1020.0\" cy=\"770.0\" r=\"10.00\"/>\n</g>\n</svg>\n"),
              std::string::npos)
        << text;
}

TEST(Svg, ViewFollowsTheExtentAndElseTheBounds) {
    Layout layout;
    layout.provenance.bounds = "0..4,0..2";
    EXPECT_NE(written("svg", {points_of({{4, 2}})}, layout).find("viewBox=\"0 0 1040 540\""),
              std::string::npos);
    layout.extent = Box{{-1, -1}, {1, 1}};
    EXPECT_NE(written("svg", {points_of({{0, 0}})}, layout).find("cx=\"520.0\" cy=\"520.0\""),
              std::string::npos);
}

// 0.15 sqrt(10^6 / 10^4) = 1.5
TEST(Svg, DisksShrinkWithTheirNumber) {
    const std::string text = written("svg", {random_points(10'000, 2)});
    EXPECT_NE(text.find(" r=\"1.50\"/>"), std::string::npos);
    EXPECT_EQ(text.find(" r=\"10.00\"/>"), std::string::npos);
}

TEST(Svg, ExtrasAreLeftOutAndTitlesAreSafe) {
    Layout layout{.extras = {"pdf"}};
    layout.provenance.generator = "a<b&c";
    const std::string text = written("svg", {points_of({{0.5, 0.5, 9}})}, layout);
    EXPECT_NE(text.find("<title>abc, 1 points</title>"), std::string::npos) << text;
    EXPECT_NE(text.find("cx=\"520.0\" cy=\"520.0\""), std::string::npos);
}

// Three panels of 490 units, 20 between them: x and y on top, x and z and then y and z below.
TEST(Svg, EachPairOfCoordinatesHasItsPanel) {
    Layout layout;
    layout.extent = Box{{0, 0, -1}, {1, 10, 1}};
    const std::string text = written("svg", {points_of({{0.5, 10, 0}})}, layout);
    EXPECT_NE(text.find("viewBox=\"0 0 1040 1040\""), std::string::npos) << text;
    EXPECT_NE(text.find("<circle cx=\"265.0\" cy=\"20.0\" r=\"10.00\"/>\n"
                        "<circle cx=\"265.0\" cy=\"775.0\" r=\"10.00\"/>\n"
                        "<circle cx=\"1020.0\" cy=\"775.0\" r=\"10.00\"/>\n</g>\n"),
              std::string::npos)
        << text;
    for (const char* words : {">x right 0 to 1, y up 0 to 10<", ">x right 0 to 1, z up -1 to 1<",
                              ">y right 0 to 10, z up -1 to 1<"})
        EXPECT_NE(text.find(words), std::string::npos) << words;
    EXPECT_NE(written("svg", {random_points(3, 8)}).find(">x7 right 0 to 1, x8 up 0 to 1<"),
              std::string::npos);
}

// A box that is one domain keeps its aspect ratio: 10 are 490 units, so x is 49 wide and z 98 high.
TEST(Svg, PanelsOfOneDomainShowLengthsAlike) {
    Layout layout;
    layout.extent = Box{{0, 0, -1}, {1, 10, 1}};
    layout.provenance.domain = "box:bounds=[0..1,0..10,-1..1]";
    const std::string text = written("svg", {points_of({{1, 10, -1}})}, layout);
    EXPECT_NE(text.find("<rect x=\"20\" y=\"20\" width=\"49\" height=\"490\""), std::string::npos)
        << text;
    EXPECT_NE(text.find("<circle cx=\"69.0\" cy=\"628.0\""), std::string::npos) << text;
}

TEST(Svg, IsWriteOnlyAndOfFewCoordinates) {
    const Format& format = io::format_named("svg");
    EXPECT_FALSE(format.read);
    EXPECT_EQ(format.traits.min_dimension, 2U);
    EXPECT_EQ(format.traits.max_dimension, 8U);
}

}  // namespace stipple::testing::svg_test
