// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/rng.hpp"
#include "support/designs.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::fast_test {

using std::numbers::pi;

// By the definition, with frequencies computed by hand: N = 65 and M = 4 give w = 8, others up to
// 1; N = 1025 gives w = 128 and 16: four others are 1, 6, 11, 16.
TEST(Fast, CurvesAreThoseOfTheDefinition) {
    const auto check = [](std::size_t n, std::size_t k, double own,
                          const std::vector<double>& others) {
        const PointSet set = make("fast", points(n * k, k), {}, {.seed = 3});
        const Rng phases(3, 0);
        for (std::size_t curve = 0; curve < k; ++curve)
            for (std::size_t j = 0; j < n; ++j)
                for (std::size_t i = 0; i < k; ++i) {
                    const double w = i == curve ? own : others[i < curve ? i : i - 1];
                    const double angle = 2 * pi *
                                         (w * static_cast<double>(j) / static_cast<double>(n) +
                                          phases.uniform(curve * k + i));
                    ASSERT_NEAR(set[curve * n + j][i], 0.5 + std::asin(std::sin(angle)) / pi, 2e-7)
                        << curve << " " << j << " " << i;
                }
    };
    check(65, 3, 8, {1, 1});
    check(1025, 5, 128, {1, 6, 11, 16});
    check(129, 4, 16, {1, 2, 1});
    check(200, 1, 24, {});
}

TEST(Fast, TellsItsFrequencies) {
    const PointSet set = make("fast", {.dimension = 5});
    EXPECT_EQ(set.count(), 5125U);
    EXPECT_EQ(found_in(set, "frequency"), "128");
    EXPECT_EQ(found_in(set, "highest_other_frequency"), "16");
    const PointSet six = make("fast", {.dimension = 2}, {{"harmonics", "6"}});
    EXPECT_EQ(found_in(six, "frequency"), "85");
    EXPECT_EQ(found_in(six, "highest_other_frequency"), "1");
}

// Every coordinate of a curve is uniformly distributed: a line reflected at the faces.
TEST(Fast, CoordinatesAreEvenOnEachCurve) {
    const PointSet set = make("fast", {.dimension = 3});
    for (std::size_t i = 0; i < 3; ++i) {
        double mean = 0;
        for (std::size_t j = 0; j < 1025; ++j) mean += set[j][i] / 1025;
        EXPECT_NEAR(mean, 0.5, 0.01) << i;
    }
}

TEST(Fast, AnyStretchIsThatOfTheWhole) { EXPECT_TRUE(stretches_agree("fast", points(1000, 4))); }

TEST(Fast, RefusesShortAndUnequalCurves) {
    const auto error = [](const Request& request, const Settings& settings) {
        return error_of([&] { make("fast", request, settings); });
    };
    EXPECT_EQ(error(points(1000, 3), {}),
              "usage: --count: 1000 is not a multiple of 3 (at least 3 curves of 65 runs), as fast "
              "needs; 999 and 1002 are the nearest");
    EXPECT_EQ(error(points(99, 3), {}),
              "usage: --count: 99 is not a multiple of 3 (at least 3 curves of 65 runs), as fast "
              "needs; 195 is the least");
    EXPECT_EQ(error(points(300, 3), {{"harmonics", "6"}}),
              "usage: --count: 300 is not a multiple of 3 (at least 3 curves of 145 runs), as fast "
              "needs; 435 is the least");
}

}  // namespace stipple::testing::fast_test
