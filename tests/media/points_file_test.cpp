// SPDX-License-Identifier: MIT
#include "media/points_file.hpp"

#include <gtest/gtest.h>

#include "support/units.hpp"

namespace stipple::testing::points_file_test {
namespace {

PointSet read(const std::string& text) {
    TokenFile file(text, "f");
    return read_points(file, {});
}

}  // namespace

TEST(PointsFile, TakesCommasBlanksHeadersAndComments) {
    const PointSet truth = points_of({{1, 2}, {-0.5, 3e-3}});
    for (const char* text :
         {"1,2\n-0.5,3e-3\n", "x,y\n1,2\n-0.5,3e-3",
          "# made by\nx y # names\n1 2\r\n-0.5\t0.003\r\n",
          "\xEF\xBB\xBF 1 , 2 \n\n# between\n-0.5 ,3e-3 # behind\n", "1, 2\n-0.5 , .003\n"})
        EXPECT_EQ(read(text), truth) << text;
    EXPECT_EQ(read("5").count(), 1);
    EXPECT_EQ(read("x\n5\n6").dimension(), 1);
}

TEST(PointsFile, BlankLinesAndCommentsBeginGroups) {
    const auto groups = [](const std::string& text) {
        TokenFile file(text, "f");
        return read_point_groups(file, {});
    };
    const std::vector<PointSet> two = {points_of({{1, 2}, {3, 4}}), points_of({{5, 6}})};
    for (const char* text :
         {"1,2\n3,4\n\n5,6\n", "x,y\n1 2\n3 4\n#\n5 6",
          "\n# a\n\nx,y\n\n1,2\n3,4 # b\n\n# c\n5,6\n\n", "1,2\r\n3,4\r\n\r\n5,6\r\n"})
        EXPECT_EQ(groups(text), two) << text;
    EXPECT_EQ(groups("1,2\n3,4").size(), 1U);
}

TEST(PointsFile, SaysWhereItIsWrong) {
    for (const auto& [text, message] : std::vector<std::pair<const char*, const char*>>{
             {"", "f: no points; expected a point a line"},
             {"# only\n", "f: no points; expected a point a line"},
             {"x,y\n", "f: no points; expected a point a line"},
             {"1,2\n3,x\n", "f:2:3: 'x' is not a finite number; expected a coordinate"},
             {"1,nan\n", "f:1:3: 'nan' is not a finite number; expected a coordinate"},
             {"1 2\n3 -inf\n", "f:2:3: '-inf' is not a finite number; expected a coordinate"},
             {"1 1e999\n", "f:1:3: '1e999' is not a finite number; expected a coordinate"},
             {"1,2\n3\n", "f:2:1: 1 coordinates in this line; expected 2, as before"},
             {"1,2\n3,4,5\n", "f:2:1: 3 coordinates in this line; expected 2, as before"},
             {"1,,2\n", "f:1:3: a comma without a coordinate before it"},
             {"1 2\n1, ,2\n", "f:2:4: a comma without a coordinate before it"},
             {"1 2\n,2\n", "f:2:1: a comma without a coordinate before it"},
             {"1,2,\n", "f:1:4: no coordinate follows this comma"},
             {"x\ny\n1\n", "f:2:1: 'y' is not a finite number; expected a coordinate"},
             {"set,x\n1,2\n", "f:1:1: several sets of points; expected one"},
             {"{\"a\":1}\n", "f:1:1: neither names nor numbers; expected text, a point a line"}})
        EXPECT_EQ(error_of([&] { read(text); }), std::string("input: ") + message) << text;
    EXPECT_EQ(error_of([] { read_points("/no/such/file", {}); }),
              "io: /no/such/file: no such file");
}

}  // namespace stipple::testing::points_file_test
