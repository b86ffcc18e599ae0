// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/temporary_file.hpp"
#include "support/warping.hpp"

namespace stipple::testing::empirical_test {
namespace {

std::string refusal(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

}  // namespace

TEST(EmpiricalWarp, NumbersByHand) {
    EXPECT_EQ(image_of("empirical", {0.3, 0.4}), (std::vector{0.0, 1.0}));
    EXPECT_EQ(image_of("empirical:values=[7,7,3,1]", {0.25, 0.5}), (std::vector{3.0, 7.0}));
    EXPECT_EQ(image_of("empirical:values=[8,1,4,2],interpolation=linear", {0.25, 0.75}),
              (std::vector{1.75, 5.0}));
}

TEST(EmpiricalWarp, ColumnsOfAFile) {
    const TemporaryFile file("a,b,c\n1,10,100\n2,20,200\n2,40,300\n");
    const std::string of = "empirical:file=" + file.path();
    EXPECT_EQ(image_of(of + ",file-columns=a", {0, 0.5}), (std::vector{1.0, 2.0}));
    EXPECT_EQ(image_of(of + ",file-columns=[a,c]", {0, 0.5}), (std::vector{1.0, 200.0}));
    EXPECT_EQ(image_of(of + ",file-columns=2,interpolation=linear", {0.5, 0.75}),
              (std::vector{20.0, 30.0}));
    EXPECT_EQ(mapping(of)->domain()->dimension(), 3U);
    EXPECT_EQ(refusal(of + ",file-columns=a,interpolation=linear"),
              "input: " + file.path() +
                  ": 2 occurs twice; linear interpolation needs distinct numbers | step "
                  "interpolation accepts repeated numbers");
}

TEST(EmpiricalWarp, StrataGiveEachNumberAsOftenAsItStandsThere) {
    const auto map = mapping("empirical:values=[5,5,5,1]");
    int fives = 0;
    for (int i = 0; i < 40; ++i) fives += image_of(*map, {(i + 0.5) / 40, 0})[0] == 5;
    EXPECT_EQ(fives, 30);
}

TEST(EmpiricalWarp, BothWaysAndItsMoments) {
    expect_round_trip(*mapping("empirical:values=[3,1,4,1,5,9,2,6]"), 0);
    const auto line = mapping("empirical:values=[3,1,4,5,9,2,6],interpolation=linear");
    expect_round_trip(*line, 1e-14);
    EXPECT_EQ(line->domain()->measure(), 64);
    const auto m = *mapping("empirical:values=[0,0,0,4]")->domain()->moments();
    EXPECT_EQ(m.mean[0], 1);
    EXPECT_EQ(m.covariance[0], 3);
    EXPECT_EQ(m.skewness[0], 6 / std::pow(3, 1.5));
}

TEST(EmpiricalWarp, RefusesWhatIsNoColumn) {
    EXPECT_EQ(refusal("empirical:file-columns=a"),
              "usage: --file-columns: selects columns of --file, which is not given");
    EXPECT_EQ(refusal("empirical:values=1,interpolation=linear"),
              "usage: --values: only 1 number; linear interpolation needs at least 2");
    EXPECT_EQ(refusal("empirical:values=[1,2],file=none.csv"),
              "usage: --values: cannot be combined with --file; give one of them");
    EXPECT_EQ(refusal("empirical:values=[1,1e200]"),
              "usage: --values: 1e+200 is outside [-1e150, 1e150]");
}

}  // namespace stipple::testing::empirical_test
