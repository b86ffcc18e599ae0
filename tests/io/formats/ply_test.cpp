// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "io/io_support.hpp"

namespace stipple::testing::ply_test {

using namespace std::string_literals;

TEST(Ply, BinaryVerticesWithZeroForMissingAxes) {
    const std::string head =
        "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty double x\nproperty "
        "double y\nproperty double z\nend_header\n";
    const PointSet two = points_of({{1, 2}, {3, 4}});
    EXPECT_EQ(written("ply", {two}), head + written("bin", {points_of({{1, 2, 0}, {3, 4, 0}})}));
    const PointSet line = points_of({{1}, {2}});
    EXPECT_EQ(written("ply", {line}), head + written("bin", {points_of({{1, 0, 0}, {2, 0, 0}})}));
}

TEST(Ply, TextWhereDigitsAreAskedFor) {
    EXPECT_EQ(written("ply", {points_of({{0.999, 0.5, 7}})},
                      {.extras = {"pdf"}, .single = true, .precision = 2}),
              "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
              "y\nproperty float z\nproperty float pdf\nend_header\n0.99 0.50 0.00 7.00\n");
}

TEST(Ply, VerticesKnowTheirSet) {
    const std::vector<PointSet> sets{points_of({{1, 2, 3}}), points_of({{4, 5, 6}})};
    const std::string text = written("ply", sets, {.precision = 0});
    EXPECT_TRUE(text.ends_with("property int set\nend_header\n1 2 3 0\n4 5 6 1\n")) << text;
    const std::string binary = written("ply", sets);
    EXPECT_TRUE(binary.ends_with(written("bin", {sets[1]}) + "\1\0\0\0"s));
}

TEST(Ply, MetaIsAComment) {
    const std::string text =
        written("ply", {points_of({{1, 2}})}, {.meta = true, .provenance = some_provenance()});
    EXPECT_NE(text.find("1.0\ncomment tool: \"stipple\"\ncomment version: "), std::string::npos);
}

TEST(Ply, IsNotRead) { EXPECT_FALSE(io::format_named("ply").read); }

}  // namespace stipple::testing::ply_test
