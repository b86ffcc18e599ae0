// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "io/io_support.hpp"

namespace stipple::testing::psa_test {
namespace {
const PointSet two = points_of({{0, 0.5}, {0.25, 1e-7}});
}

TEST(Psa, NumberOfPointsComesFirst) {
    EXPECT_EQ(written("psa", {two}, {.meta = true}), "2\n0 0.5\n0.25 1e-07\n");
    EXPECT_EQ(read_as("psa", "2\r\n0 0.5\r\n0.25 1e-07").at(0), two);
    const PointSet many = random_points(70'000, 2);
    EXPECT_EQ(read_as("psa", written("psa", {many})).at(0), many);
}

TEST(Psa, RefusesAnotherNumber) {
    EXPECT_EQ(refusal("psa", "3\n0 0.5\n1 1\n"),
              "input: p:1:1: the first line is 3, but the number of points is 2; expected as many, "
              "at least one");
    EXPECT_EQ(refusal("psa", "1\n0 0.5\n1 1\n"),
              "input: p:1:1: the first line is 1, but the number of points is 2; expected as many, "
              "at least one");
    EXPECT_EQ(refusal("psa", "0\n"),
              "input: p:1:1: the first line is 0, but the number of points is 0; expected as many, "
              "at least one");
    EXPECT_EQ(refusal("psa", "0.5 0.5\n1 1\n"),
              "input: p:1:1: '0.5 0.5' is not a number of points; psa begins with one");
    EXPECT_EQ(refusal("psa", "1\n0 0.5 1\n"), "input: p:2:7: the row has 3 fields; expected 2");
    EXPECT_EQ(refusal("psa", "2\n0 0\n#\n1 1\n"),
              "input: p:3:1: '#' begins another set; psa holds one");
    EXPECT_EQ(refusal("psa", ""), "input: p: the file is empty; expected points, one per line");
}

TEST(Psa, HoldsOneSetOfTwoDimensions) {
    const auto& traits = io::format_named("psa").traits;
    EXPECT_FALSE(traits.many_sets);
    EXPECT_EQ(traits.min_dimension, 2U);
    EXPECT_EQ(traits.max_dimension, 2U);
}

}  // namespace stipple::testing::psa_test
