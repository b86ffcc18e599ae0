// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "io/io_support.hpp"

namespace stipple::testing::txt_test {
namespace {
const PointSet two = points_of({{0, 0.5}, {0.25, -1e-7}});
}

TEST(Txt, APointALineWithoutHeader) {
    EXPECT_EQ(written("txt", {two}), "0 0.5\n0.25 -1e-07\n");
    EXPECT_EQ(written("txt", {points_of({{1, 2, 9}})}, {.extras = {"pdf"}}), "1 2 9\n");
    EXPECT_EQ(written("txt", {two}, {.precision = 1}), "0.0 0.5\n0.2 0.0\n");
}

TEST(Txt, SetsAreSeparatedByALine) {
    const std::string text = written("txt", {two, points_of({{1, 1}})});
    EXPECT_EQ(text, "0 0.5\n0.25 -1e-07\n#\n1 1\n");
    const auto sets = read_as("txt", text);
    ASSERT_EQ(sets.size(), 2U);
    EXPECT_EQ(sets[0], two);
    EXPECT_EQ(sets[1], points_of({{1, 1}}));
}

TEST(Txt, MetaIsNotTakenForASeparator) {
    const std::string text =
        written("txt", {two, two}, {.meta = true, .provenance = some_provenance()});
    const auto sets = read_as("txt", text);
    ASSERT_EQ(sets.size(), 2U);
    EXPECT_EQ(sets[1], two);
    Provenance second = some_provenance();
    ++second.seed;
    EXPECT_EQ(sets[1].provenance, second);
}

// Index, x, y, with comments and a blank line between two blocks, as in gnuplot's tables.
TEST(Txt, ReadsTablesOfGnuplot) {
    EXPECT_EQ(
        read_as("txt", "# Curve 0 of 1, 2 points\n# x y type\n 0  0.5  i\n 0.25  -1e-07  i\n\n",
                {.columns = {"1", "2"}})
            .at(0),
        two);
}

TEST(Txt, RefusesWordsInTheMiddle) {
    EXPECT_EQ(refusal("txt", "0 1\nend of file\n"),
              "input: p:2:1: 'end' is not a number; expected one such as 0.5 or 1e-3");
}

}  // namespace stipple::testing::txt_test
