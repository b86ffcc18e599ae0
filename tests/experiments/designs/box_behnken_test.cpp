// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <map>

#include "support/designs.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::box_behnken_test {

// Box and Behnken 1960, table 4, three factors: the four combinations of each pair.
TEST(BoxBehnken, ThreeFactorsAsPublished) {
    EXPECT_EQ(signs_of(coded_design("box-behnken", {}, {{"center", "3"}})),
              (std::vector<std::string>{"--0", "+-0", "-+0", "++0", "-0-", "+0-", "-0+", "+0+",
                                        "0--", "0+-", "0-+", "0++", "000", "000", "000"}));
}

// Numbers of runs without the centre, from the article's table.
TEST(BoxBehnken, RunsAreThoseOfThePublishedDesigns) {
    const std::map<std::size_t, std::size_t> runs = {{3, 12},   {4, 24},  {5, 40},   {6, 48},
                                                     {7, 56},   {9, 120}, {10, 160}, {11, 176},
                                                     {12, 192}, {16, 384}};
    for (const auto& [k, n] : runs)
        EXPECT_EQ(make("box-behnken", {.dimension = k}, {{"center", "0"}}).count(), n) << k;
}

// Factors are uncorrelated and occur equally often, and runs are distinct except in blocks (9).
TEST(BoxBehnken, IsOrthogonalToFirstOrder) {
    for (const std::size_t k : {3, 4, 5, 6, 7, 9, 10, 11, 12, 16}) {
        const PointSet set = coded_design("box-behnken", {.dimension = k}, {{"center", "0"}});
        auto rows = signs_of(set);
        std::ranges::sort(rows);
        const auto twice =
            static_cast<std::size_t>(rows.end() - std::unique(rows.begin(), rows.end()));
        EXPECT_EQ(twice, k == 9 ? 24U : 0U) << k;
        for (std::size_t a = 0; a < k; ++a) {
            EXPECT_EQ(column_product(set, a, a), column_product(set, 0, 0)) << k << " " << a;
            double sum = 0;
            for (std::size_t i = 0; i < set.count(); ++i) sum += set[i][a];
            EXPECT_EQ(sum, 0) << k;
            for (std::size_t b = 0; b < a; ++b)
                EXPECT_EQ(column_product(set, a, b), 0) << k << " " << a << " " << b;
        }
    }
}

TEST(BoxBehnken, LevelsAreThreeCellsOrReachTheFaces) {
    const PointSet middles = make("box-behnken", {});
    EXPECT_EQ(middles[0][0], 1.0 / 6);
    EXPECT_EQ(middles[1][0], 5.0 / 6);
    EXPECT_EQ(middles[12][0], 0.5);
    const PointSet ends = make("box-behnken", {}, {{"ends", "true"}});
    EXPECT_EQ(ends[0][0], 0);
    EXPECT_EQ(ends[1][0], 1 - 0x1p-53);
    EXPECT_EQ(ends[12][0], 0.5);
    EXPECT_TRUE(stretches_agree("box-behnken", points(177, 11)));
}

TEST(BoxBehnken, RefusesWhatIsNotPublished) {
    const auto error = [](const Request& request) {
        return error_of([&] { make("box-behnken", request); });
    };
    EXPECT_EQ(
        error({.dimension = 8}),
        "usage: --dimension: no Box-Behnken design of 8 factors is published; 7 and 9 are the "
        "nearest");
    EXPECT_EQ(error(points(15, 3)),
              "usage: --count: 15 contradicts the Box-Behnken design of 3 factors, which has 12 "
              "runs and 1 at the centre | --center 3 gives that count");
    EXPECT_EQ(
        error(points(10, 3)),
        "usage: --count: 10 contradicts the Box-Behnken design of 3 factors, which has 12 runs "
        "and 1 at the centre");
}

}  // namespace stipple::testing::box_behnken_test
