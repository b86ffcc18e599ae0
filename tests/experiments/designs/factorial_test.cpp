// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "stipple/warp.hpp"
#include "support/designs.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::factorial_test {

TEST(Factorial, IsInStandardOrderFirstFactorFastest) {
    EXPECT_EQ(signs_of(coded_design("factorial", {.dimension = 3})),
              (std::vector<std::string>{"---", "+--", "-+-", "++-", "--+", "+-+", "-++", "+++"}));
    EXPECT_EQ(signs_of(coded_design("factorial", {}, {{"levels", "3,2"}})),
              (std::vector<std::string>{"--", "0-", "+-", "-+", "0+", "++"}));
}

// Midpoints of m equal cells, which inversion maps to the numbers of m equally probable outcomes.
TEST(Factorial, LevelsAreWhatDiscreteWarpsTake) {
    const PointSet set = make("factorial", {}, {{"levels", "5"}});
    ASSERT_EQ(set.count(), 25U);
    const PointSet image = warp("discrete:probabilities=[0.2,0.2,0.2,0.2,0.2]", set);
    for (std::size_t i = 0; i < 25; ++i) {
        EXPECT_EQ(set[i][0], (2. * static_cast<double>(i % 5) + 1) / 10);
        EXPECT_EQ(image[i][0], static_cast<double>(i % 5));
        EXPECT_EQ(image[i][1], static_cast<double>(i / 5));
    }
}

TEST(Factorial, EndsReachFromFaceToFaceOfTheHalfOpenCube) {
    const PointSet set = make("factorial", {.dimension = 1}, {{"levels", "5"}, {"ends", "true"}});
    EXPECT_EQ(set, points_of({{0}, {0.25}, {0.5}, {0.75}, {1 - 0x1p-53}}));
}

TEST(Factorial, CountIsAPowerWithoutLevels) {
    EXPECT_EQ(make("factorial", points(27, 3)),
              make("factorial", {.dimension = 3}, {{"levels", "3"}}));
    EXPECT_EQ(make("factorial", {.dimension = 4}).count(), 16U);
    EXPECT_TRUE(stretches_agree("factorial", points(120, 3), {{"levels", "4,5,6"}}));
}

TEST(Factorial, RefusesWhatContradictsItsLevels) {
    const auto error = [](const Request& request, const char* levels) {
        return error_of([&] {
            make("factorial", request, levels ? Settings{{"levels", levels}} : Settings());
        });
    };
    EXPECT_EQ(
        error({.count = 23}, "2,3,4"),
        "usage: --count: 23 contradicts --levels 2,3,4, which has 24 runs; leave --count out");
    EXPECT_EQ(error({.dimension = 2}, "2,3,4"),
              "usage: --dimension: 2 contradicts --levels 2,3,4, for 3 factors");
    EXPECT_EQ(error({}, "2,2.5"), "usage: --levels: 2.5 is not a whole number from 1 to 2^53");
    EXPECT_EQ(
        error(points(20, 3), nullptr),
        "usage: --count: 20 is not k^3, as factorial without --levels needs; 8 and 27 are the "
        "nearest");
}

}  // namespace stipple::testing::factorial_test
