// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "support/warping.hpp"

namespace stipple::testing::serial_test {
namespace {

Report serial(const std::vector<double>& flat, const char* lags = "1") {
    return analyze("serial", PointSet(flat, 1), {{"lags", lags}});
}

}  // namespace

TEST(Serial, ByHand) {
    // Up, up, down, down, up: 3 runs with mean 11/3 and variance 67/90; about 1/2: - - + - - +.
    const Report report = serial({0.1, 0.3, 0.9, 0.4, 0.2, 0.7}, "2");
    const auto runs = std::get<Report::Integers>(*report.find("runs_up_down"));
    EXPECT_EQ(runs, Report::Integers{3});
    EXPECT_DOUBLE_EQ(report.curve("runs_up_down_z")[0], (3 - 11.0 / 3) / std::sqrt(67.0 / 90));
    EXPECT_EQ(std::get<Report::Integers>(*report.find("runs_about_half")), Report::Integers{4});
    EXPECT_DOUBLE_EQ(report.curve("runs_about_half_z")[0], 0.5 / std::sqrt(1.25));
    // Deviations from 1/2: -.4 -.2 .4 -.1 -.3 .2; lag 1: .08 - .08 - .04 + .03 - .06; lag 2: -.16 +
    // .02 - .12 - .02.
    EXPECT_NEAR(report.curve("correlation")[0], 12 * -0.07 / 5, 1e-15);
    EXPECT_NEAR(report.curve("correlation")[1], 12 * -0.28 / 4, 1e-15);
    EXPECT_NEAR(report.curve("correlation_z")[1], 12 * -0.28 / 2, 1e-15);
}

// Mean and variance of both kinds of runs, over all orders of few numbers and all sequences of
// sides.
TEST(Serial, RunsHaveTheMeanAndVarianceThatAreSaid) {
    std::vector<double> values = {0.1, 0.2, 0.3, 0.4, 0.6, 0.7};
    double count = 0, sum = 0, squares = 0;
    do {
        const double z = serial(values).curve("runs_up_down_z")[0];
        count += 1, sum += z, squares += z * z;
    } while (std::ranges::next_permutation(values).found);
    EXPECT_EQ(count, 720);
    EXPECT_NEAR(sum / count, 0, 1e-12);
    EXPECT_NEAR(squares / count, 1, 1e-12);
    sum = squares = 0;
    for (unsigned sides = 0; sides < 64; ++sides) {
        for (unsigned i = 0; i < 6; ++i) values[i] = sides >> i & 1 ? 0.75 : 0.25;
        const double z = serial(values).curve("runs_about_half_z")[0];
        sum += z, squares += z * z;
    }
    EXPECT_NEAR(sum / 64, 0, 1e-12);
    EXPECT_NEAR(squares / 64, 1, 1e-12);
}

// 200 sets at level 0.01: above 12 false alarms with probability below 1e-5, if p is right; by
// Sidak it is at most slightly too small.
TEST(Serial, FalseAlarmsAreNotMoreThanTheLevelSays) {
    int alarms = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed)
        alarms +=
            analyze("serial", make("random", {1000, 2}, {}, {.seed = seed}), {{"level", "0.01"}})
                .text("verdict") == "dependent";
    EXPECT_LE(alarms, 12);
}

TEST(Serial, FindsWhatDependsOnThePointsBefore) {
    PointSet mixed = make("random", {20'000, 1});
    for (std::size_t i = mixed.count() - 1; i >= 7; --i)  // 5 % of points repeat the 7th one before
        if (i % 20 == 0) mixed[i][0] = mixed[i - 7][0];
    EXPECT_EQ(analyze("serial", mixed).text("verdict"), "independent") << "5 lags are too few";
    EXPECT_EQ(analyze("serial", mixed, {{"lags", "7"}}).text("verdict"), "dependent");
    EXPECT_EQ(analyze("serial", make("van-der-corput", {1000, 1})).text("verdict"), "dependent");
    EXPECT_EQ(
        analyze("serial", make("random", {1000, 2}), {{"expect", "dependent"}}).unmet().size(), 1U);
}

TEST(Serial, NeedsMorePointsThanLags) {
    EXPECT_EQ(error_of([] {
                  serial({0.1, 0.2, 0.3}, "2");
              }),
              "input: serial needs at least 4 points for 2 lags; these are 3");
    EXPECT_EQ(error_of([] { serial({0.1, 0.2, 0.3}); }), "");
}

}  // namespace stipple::testing::serial_test
