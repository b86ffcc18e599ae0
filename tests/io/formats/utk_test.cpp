// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "io/files.hpp"
#include "io/io_support.hpp"

namespace stipple::testing::utk_test {

using namespace std::string_literals;

namespace {

/// Header by UTK for sets of n points in d dimensions.
std::string utk_head(char type, char sets, char n, char d) {
    return "UTK!"s + type + "\0\0\0"s + sets + "\0\0\0"s + n + "\0\0\0"s + d + "\0\0\0"s;
}

std::string refused(std::string_view bytes) { return refusal("utk", bytes); }

}  // namespace

TEST(Utk, WritesTheBytesThatUtkWrites) {
    const PointSet points = points_of({{1, -2}, {0.5, 0}});
    EXPECT_EQ(written("utk", {points}), utk_head(5, 1, 2, 2) + written("bin", {points}));
    EXPECT_EQ(written("utk", {points, points}, {.single = true}),
              utk_head(4, 2, 2, 2) + written("bin", {points, points}, {.single = true}));
}

TEST(Utk, ReadsBack) {
    const std::vector<PointSet> sets{random_points(300, 3, 1), random_points(300, 3, 2)};
    EXPECT_EQ(read_as("utk", written("utk", sets)), sets);
    EXPECT_EQ(read_as("utk", written("utk", sets), {.columns = {"z", "x"}}).at(1).flat()[0],
              sets[1].flat()[2]);
}

TEST(Utk, ReadsEveryType) {
    const std::string minus_one = "\xff\xff\xff\xff"s;
    const PointSet signed_one = points_of({{-1}});
    EXPECT_EQ(read_as("utk", utk_head(0, 1, 1, 1) + minus_one).at(0), signed_one);
    EXPECT_EQ(read_as("utk", utk_head(1, 1, 1, 1) + minus_one + minus_one).at(0), signed_one);
    EXPECT_EQ(read_as("utk", utk_head(2, 1, 1, 1) + minus_one).at(0), points_of({{4294967295}}));
    EXPECT_EQ(read_as("utk", utk_head(3, 1, 1, 1) + "\0\0\0\x80\0\0\0\0"s).at(0),
              points_of({{2147483648}}));
    EXPECT_EQ(read_as("utk", utk_head(4, 1, 1, 1) + "\0\0\0\x3f"s).at(0), points_of({{0.5}}));
}

TEST(Utk, IsKnownByItsBytesWhateverItsName) {
    const std::string file = written("utk", {random_points(5, 2)});
    for (const char* path : {"-", "a", "a.bin", "a.txt", "a.csv"})
        EXPECT_EQ(io::read_sets(file, path, {}, {}).at(0), random_points(5, 2)) << path;
}

TEST(Utk, RefusesWhatIsNoSuchFile) {
    const std::string file = written("utk", {random_points(5, 2)});
    EXPECT_EQ(refused("UTK?"), "input: p: byte 0: not a file of UTK; expected the bytes UTK!");
    EXPECT_EQ(refused(file.substr(0, 19)),
              "input: p: byte 19: the file ends within its first 20 bytes");
    EXPECT_EQ(refused(utk_head(6, 1, 1, 1)),
              "input: p: byte 4: numbers of type 6; expected 0 to 5");
    EXPECT_EQ(refused(utk_head(5, 1, 0, 2)),
              "input: p: byte 8: 1 sets of 0 points with 2 coordinates hold no points");
    EXPECT_EQ(refused(file.substr(0, 40)),
              "input: p: byte 40: the file ends too soon; expected 80 bytes of numbers, found 20");
    EXPECT_EQ(refused(file + "x"),
              "input: p: byte 100: 1 bytes follow the numbers; expected the end of the file");
    EXPECT_EQ(refused(utk_head(5, 1, 1, 1) + "\0\0\0\0\0\0\xf0\x7f"s),
              "input: p: byte 20: inf in point 0; expected finite numbers");
    EXPECT_NE(refused("UTK!\5\0\0\0"s + std::string(12, '\xff')), "");
}

}  // namespace stipple::testing::utk_test
