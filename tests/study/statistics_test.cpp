// SPDX-License-Identifier: MIT
#include "study/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/rng.hpp"

namespace stipple::testing::statistics_test {
namespace {

const std::vector<double> a = {1.1, 2.3, 2.9, 4.8, 5.0};
const std::vector<double> b = {2.0, 3.1, 4.7, 6.2, 8.9};

}  // namespace

// Expected values from SciPy: ttest_ind(equal_var=False), ttest_rel, t.interval, sem.
TEST(Statistics, AgreesWithSciPy) {
    const MeanTest welch = welch_test(a, b);
    EXPECT_NEAR(welch.difference, -1.76, 1e-14);
    EXPECT_NEAR(welch.t, -1.2374743202573617, 1e-13);
    EXPECT_NEAR(welch.p_value, 0.25782591328661575, 1e-13);
    EXPECT_NEAR(welch.degrees, 6.648522216017736, 1e-12);
    EXPECT_NEAR(welch.standard_error, 1.422251735804882, 1e-14);
    const std::vector<double> fewer = {2.0, 3.1, 4.7};
    EXPECT_NEAR(welch_test(a, fewer).t, -0.043146216910184734, 1e-13);
    EXPECT_NEAR(welch_test(a, fewer).p_value, 0.9672089918939035, 1e-13);
    const MeanTest paired = paired_test(a, b);
    EXPECT_NEAR(paired.t, -3.118098153589372, 1e-13);
    EXPECT_NEAR(paired.p_value, 0.03559198776866257, 1e-13);
    EXPECT_EQ(paired.degrees, 4);
    const SampleSummary s = summarize(a);
    EXPECT_NEAR(s.standard_error, 0.7452516353554683, 1e-15);
    EXPECT_NEAR(t_interval(s, 0.95).low, 1.1508497448766555, 1e-13);
    EXPECT_NEAR(t_interval(s, 0.95).high, 5.289150255123345, 1e-13);
}

TEST(Statistics, DoesNotDependOnTheScaleHoweverSmallOrLarge) {
    for (const int power : {-900, -540, 540, 900}) {
        std::vector<double> x = a;
        std::vector<double> y = b;
        for (double& v : x) v = std::ldexp(v, power);
        for (double& v : y) v = std::ldexp(v, power);
        EXPECT_EQ(summarize(x).deviation, std::ldexp(summarize(a).deviation, power));
        EXPECT_EQ(root_mean_square(x), std::ldexp(root_mean_square(a), power));
        EXPECT_EQ(welch_test(x, y).p_value, welch_test(a, b).p_value);
        EXPECT_EQ(welch_test(x, y).degrees, welch_test(a, b).degrees);
        EXPECT_EQ(paired_test(x, y).p_value, paired_test(a, b).p_value);
    }
    std::vector<double> huge = a;  // whose sum is beyond float64
    for (double& v : huge) v = std::ldexp(v, 1020);
    EXPECT_EQ(summarize(huge).mean, std::ldexp(summarize(a).mean, 1020));
}

// Expected values from SciPy: chi2.ppf(p, 5), p = 0.025 and 0.975, and the root of the mean square.
TEST(Statistics, IntervalOfARootMeanSquare) {
    const double rms = root_mean_square(a);
    EXPECT_NEAR(rms_interval(a, 0.95).low, rms * std::sqrt(5 / 12.832501994030029), 1e-13);
    EXPECT_NEAR(rms_interval(a, 0.95).high, rms * std::sqrt(5 / 0.8312116134866626), 1e-13);
}

TEST(Statistics, MedianIsTheMiddleOrBetweenTheTwo) {
    EXPECT_EQ(summarize(a).median, 2.9);
    EXPECT_EQ(summarize(std::vector<double>{4, 1, 3, 2}).median, 2.5);
    EXPECT_EQ(summarize(std::vector<double>{7}).median, 7);
}

// By hand: 0.01 x 4, 0.02 x 3, 0.03 x 2 and 0.04 x 1, the last two raised to the one before.
TEST(Statistics, HolmStepsDown) {
    EXPECT_EQ(holm(std::vector<double>{0.04, 0.01, 0.03, 0.02}),
              (std::vector<double>{0.06, 0.04, 0.06, 0.06}));
    EXPECT_EQ(holm(std::vector<double>{0.9, 0.6}), (std::vector<double>{1, 1}));
    const auto some = holm(std::vector<double>{0.01, std::nan(""), 0.02});
    EXPECT_EQ(some[0], 0.02);
    EXPECT_TRUE(std::isnan(some[1]));
    EXPECT_EQ(some[2], 0.02);
    EXPECT_TRUE(holm({}).empty());
}

TEST(Statistics, SaysNothingWhereNothingCanBeSaid) {
    const std::vector<double> one = {3};
    EXPECT_TRUE(std::isnan(summarize(one).standard_error));
    EXPECT_TRUE(std::isnan(t_interval(summarize(one), 0.95).low));
    EXPECT_TRUE(std::isnan(bootstrap_interval(one, 0.95, 100, 1).low));
    EXPECT_TRUE(std::isnan(welch_test(one, a).p_value));
    EXPECT_TRUE(std::isnan(paired_test(one, one).p_value));
    EXPECT_TRUE(std::isnan(summarize({}).mean));
    const SampleSummary unknown = summarize(std::vector<double>{5, NAN, 5});
    EXPECT_TRUE(std::isnan(unknown.mean));
    EXPECT_TRUE(std::isnan(unknown.median));
    const std::vector<double> infinite = {1, HUGE_VAL, 2};
    EXPECT_TRUE(std::isnan(welch_test(infinite, a).p_value));
    EXPECT_TRUE(std::isnan(t_interval(summarize(infinite), 0.9).high));
}

TEST(Statistics, EqualNumbersHaveNoErrorHoweverTheyRound) {
    const std::vector<double> same(7, 0.1);
    EXPECT_EQ(summarize(same).mean, 0.1);
    EXPECT_EQ(summarize(same).standard_error, 0);
    EXPECT_EQ(welch_test(same, same).p_value, 1);
    EXPECT_EQ(welch_test(same, std::vector<double>(7, 0.2)).p_value, 0);
    EXPECT_EQ(bootstrap_interval(same, 0.95, 100, 1).low, 0.1);
    // Against a constant sample it is the test of one sample.
    EXPECT_NEAR(welch_test(a, std::vector<double>(5, 2.0)).t, 1.6370309599093835, 1e-13);
    EXPECT_NEAR(welch_test(a, std::vector<double>(5, 2.0)).p_value, 0.17696542379676464, 1e-13);
}

// Sums of numbers near the largest overflow, their means do not; a median needs no differences.
TEST(Statistics, MeansAndMediansOfHugeNumbers) {
    const std::vector<double> huge = {1e308, 1.5e308, 1.7e308};
    EXPECT_DOUBLE_EQ(summarize(huge).mean, 1.4e308);
    EXPECT_DOUBLE_EQ(summarize(huge).deviation, std::sqrt(0.13) * 1e308);
    EXPECT_TRUE(std::isfinite(bootstrap_interval(huge, 0.95, 100, 1).high));
    EXPECT_EQ(summarize(std::vector{-1e308, 1e308}).median, 0);
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(summarize(std::vector{1.0, infinite, 3.0}).median, 3);
    EXPECT_EQ(summarize(std::vector{infinite, infinite}).median, infinite);
}

TEST(Statistics, FewResamplesGiveNoInterval) {
    EXPECT_TRUE(std::isnan(bootstrap_interval(a, 0.95, 38, 1).low));
    EXPECT_FALSE(std::isnan(bootstrap_interval(a, 0.95, 39, 1).low));
}

TEST(Statistics, DifferencesByRoundingAreNone) {
    const std::vector<double> exact(8, 0.05767509007903701);
    std::vector<double> rounded = exact;
    for (std::size_t i = 0; i < 5; ++i) rounded[i] = std::nextafter(rounded[i], 1.0);
    rounded[6] -= 5e-16;
    EXPECT_EQ(summarize(rounded).standard_error, 0);
    for (const MeanTest& test : {welch_test(exact, rounded), paired_test(exact, rounded)}) {
        EXPECT_EQ(test.difference, 0);
        EXPECT_EQ(test.p_value, 1);
    }
    const auto interval = bootstrap_interval(rounded, 0.95, 100, 1);
    EXPECT_EQ(interval.low, interval.high);
    // Errors as small as that are numbers as others.
    const std::vector<double> small = {1e-17, 2e-17, -1e-17, 3e-17};
    EXPECT_GT(summarize(small).standard_error, 1e-18);
    // A difference beyond rounding is seen, also between constants.
    const std::vector<double> other(8, 0.05767509007903701 * (1 + 1e-12));
    EXPECT_EQ(welch_test(exact, other).p_value, 0);
}

// 400 samples of 20 uniform numbers: an exact 90 % interval contains 1/2 in 360 +- 6 of them; the
// bootstrap's is slightly too short. Five standard deviations: false alarm below 1e-5. A 70 %
// interval would be detected.
TEST(Statistics, BootstrapIntervalsHoldTheMeanAsOftenAsTheySay) {
    const auto held = [](double confidence) {
        int count = 0;
        for (std::uint64_t k = 0; k < 400; ++k) {
            std::vector<double> sample(20);
            Rng(5, k).fill(0, sample);
            const Interval i = bootstrap_interval(sample, confidence, 100, 9, k);
            count += i.low <= 0.5 && 0.5 <= i.high;
        }
        return count;
    };
    EXPECT_GT(held(0.9), 320);
    EXPECT_LT(held(0.9), 390);
    EXPECT_LT(held(0.7), 320);
}

TEST(Statistics, BootstrapDependsOnSeedAndStreamAlone) {
    std::vector<double> sample(40);
    Rng(3).fill(0, sample);
    const Interval i = bootstrap_interval(sample, 0.95, 200, 1, 2);
    const Interval again = bootstrap_interval(sample, 0.95, 200, 1, 2);
    EXPECT_EQ(i.low, again.low);
    EXPECT_EQ(i.high, again.high);
    EXPECT_NE(i.low, bootstrap_interval(sample, 0.95, 200, 2, 2).low);
    EXPECT_NE(i.low, bootstrap_interval(sample, 0.95, 200, 1, 3).low);
}

TEST(Statistics, BootstrapStopsWhenAsked) {
    std::stop_source stop;
    stop.request_stop();
    const std::vector<double> sample = {1, 2, 3};
    EXPECT_THROW((void)bootstrap_interval(sample, 0.95, 200, 1, 2, {.stop = stop.get_token()}),
                 Error);
}

}  // namespace stipple::testing::statistics_test
