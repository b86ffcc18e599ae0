// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/io_support.hpp"

namespace stipple::testing::bin_test {

using namespace std::string_literals;

TEST(Bin, WritesLittleEndianNumbersAndNothingElse) {
    EXPECT_EQ(written("bin", {points_of({{1, -2}})}, {.meta = true}),
              "\0\0\0\0\0\0\xf0?\0\0\0\0\0\0\0\xc0"s);
    EXPECT_EQ(written("bin", {points_of({{1, -2}}), points_of({{0.5, 0}})}, {.single = true}),
              "\0\0\x80?\0\0\0\xc0\0\0\0?\0\0\0\0"s);
}

TEST(Bin, ReadsBackWhenToldTheDimension) {
    const PointSet points = random_points(1000, 3);
    EXPECT_EQ(read_as("bin", written("bin", {points}), {.dimension = 3}).at(0), points);
    const PointSet whole = points_of({{1, 2}, {3, 4}});
    EXPECT_EQ(
        read_as("bin", written("bin", {whole}, {.single = true}), {.dimension = 2, .single = true})
            .at(0),
        whole);
    EXPECT_EQ(read_as("bin", written("bin", {whole}), {.dimension = 2, .columns = {"2"}}).at(0),
              points_of({{2}, {4}}));
}

TEST(Bin, SingleNeverHoldsOne) {
    const PointSet points = points_of({{1 - 0x1p-53, 1 - 0x1p-25}});
    const auto back = read_as("bin", written("bin", {points}, {.single = true}),
                              {.dimension = 2, .single = true});
    for (const double x : back.at(0).flat()) EXPECT_EQ(x, 1 - 0x1p-24);
}

TEST(Bin, RefusesWithoutDimensionAndOtherSizes) {
    const std::string file = written("bin", {random_points(5, 2)});
    EXPECT_EQ(refusal("bin", file), "usage: p: raw numbers have no dimension; give it with -d");
    EXPECT_EQ(refusal("bin", file, {.dimension = 3}),
              "input: p: byte 80: the last point is cut off; expected whole points, 3 "
              "float64 each");
    EXPECT_EQ(refusal("bin", "", {.dimension = 3}),
              "input: p: the file is empty; expected raw points");
    EXPECT_NE(refusal("bin", file, {.dimension = std::size_t{1} << 61}), "");
    EXPECT_NE(refusal("bin", file, {.dimension = 0}), "");
}

TEST(Bin, RefusesNumbersThatAreNotFinite) {
    PointSet points = random_points(5, 2);
    points[3][1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refusal("bin", written("bin", {points}), {.dimension = 2}),
              "input: p: byte 56: nan in point 3; expected finite numbers");
}

}  // namespace stipple::testing::bin_test
