// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/sensitivity/models.hpp"

namespace stipple::testing::pick_freeze_test {

using namespace sensitivity;

namespace {

constexpr const char* unit = "sensitivity";

/// Oracle: indices by the formulas, with A, B and their mixtures generated and evaluated again.
struct ByDefinition {
    ByDefinition(const PointSet& base, const Model& model) : base_(base), model_(model) {
        const std::size_t k = base.dimension() / 2;
        std::vector<double> all;
        for (std::size_t r = 0; r < base.count(); ++r) {
            all.push_back(at(r, {}, false));
            all.push_back(at(r, {}, true));
            for (std::size_t i = 0; i < k; ++i) {
                all.push_back(at(r, {i}, false));
                all.push_back(at(r, {i}, true));
            }
        }
        for (const double y : all) mean_ += y / static_cast<double>(all.size());
        double square = 0;
        double sum = 0;
        for (std::size_t r = 0; r < base.count(); ++r)
            for (const bool b : {false, true}) {
                sum += at(r, {}, b) / static_cast<double>(2 * base.count());
                square += std::pow(at(r, {}, b), 2) / static_cast<double>(2 * base.count());
            }
        variance = square - sum * sum;
    }

    /// Centred output of A, or of B, for base row r with these coordinates swapped with the other.
    double at(std::size_t r, const std::vector<std::size_t>& swapped, bool b) const {
        const std::size_t k = base_.dimension() / 2;
        std::vector<double> x;
        for (std::size_t j = 0; j < k; ++j) {
            const bool other = std::ranges::find(swapped, j) != swapped.end();
            x.push_back(base_[r][other != b ? k + j : j]);
        }
        return model_(x) - mean_;
    }

    double first(std::size_t i) const {
        double sum = 0;
        for (std::size_t r = 0; r < base_.count(); ++r)
            sum += at(r, {}, true) * (at(r, {i}, false) - at(r, {}, false));
        return sum / static_cast<double>(base_.count()) / variance;
    }
    double total(std::size_t i) const {
        double sum = 0;
        for (std::size_t r = 0; r < base_.count(); ++r)
            sum += std::pow(at(r, {}, false) - at(r, {i}, false), 2);
        return sum / 2 / static_cast<double>(base_.count()) / variance;
    }
    double second(std::size_t i, std::size_t j) const {
        double sum = 0;
        for (std::size_t r = 0; r < base_.count(); ++r)
            sum += at(r, {i}, true) * at(r, {j}, false) - at(r, {}, false) * at(r, {}, true);
        return sum / static_cast<double>(base_.count()) / variance - first(i) - first(j);
    }

    double variance = 0;

  private:
    const PointSet& base_;
    Model model_;
    double mean_ = 0;
};

}  // namespace

TEST(PickFreeze, IsWhatTheFormulasSay) {
    const PointSet base = make("random", points(20, 6));
    const ByDefinition expected(base, ishigami);
    const Report report =
        analyze(unit, with_outputs(pick_freeze_rows(base, true), ishigami), {{"bootstrap", "0"}});
    EXPECT_NEAR(report.number("x4.variance"), expected.variance, 1e-12);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string key = "x4.x" + std::to_string(i + 1);
        EXPECT_NEAR(report.number(key + ".first"), expected.first(i), 1e-12);
        EXPECT_NEAR(report.number(key + ".total"), expected.total(i), 1e-12);
        for (std::size_t j = i + 1; j < 3; ++j)
            EXPECT_NEAR(report.number(key + ":x" + std::to_string(j + 1) + ".second"),
                        expected.second(i, j), 1e-12);
    }
    EXPECT_EQ(report.find("x4.x1.first_low"), nullptr);
    EXPECT_EQ(report.number("x4.samples"), 20);
}

TEST(PickFreeze, FindsIshigamisIndices) {
    for (const bool pairs : {false, true}) {
        const auto rows = pick_freeze_rows(make("sobol", points(1 << 14, 6)), pairs);
        const Report report = analyze(unit, with_outputs(rows, ishigami), {{"bootstrap", "20"}});
        for (std::size_t i = 0; i < 3; ++i) {
            const std::string key = "x4.x" + std::to_string(i + 1);
            EXPECT_NEAR(report.number(key + ".first"), ishigami_first[i], 0.005);
            EXPECT_NEAR(report.number(key + ".total"), ishigami_total[i], 0.005);
        }
        if (!pairs) continue;
        EXPECT_NEAR(report.number("x4.x1:x3.second"), ishigami_total[2], 0.01);
        EXPECT_NEAR(report.number("x4.x1:x2.second"), 0, 0.01);
        EXPECT_NEAR(report.number("x4.x2:x3.second"), 0, 0.01);
    }
}

TEST(PickFreeze, FindsTheIndicesOfTheGFunction) {
    const auto rows = pick_freeze_rows(make("sobol", points(1 << 13, 8)), false);
    const Report report = analyze(unit, with_outputs(rows, g_function), {{"bootstrap", "20"}});
    for (std::size_t i = 0; i < 4; ++i) {
        const std::string key = "x5.x" + std::to_string(i + 1);
        EXPECT_NEAR(report.number(key + ".first"), g_first(i), 0.005);
        EXPECT_NEAR(report.number(key + ".total"), g_total(i), 0.005);
    }
}

// If intervals hold with probability 0.95, fewer than 88 of 100 has a probability of 0.2 %. Their
// width is that of the normal interval, 3.9 standard errors of 0.08 and 0.06, plus a quarter.
TEST(PickFreeze, IntervalsHoldTheIndexAsOftenAsTheySay) {
    int first = 0;
    int total = 0;
    double width = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const auto rows =
            pick_freeze_rows(make("random", points(200, 6), {}, {.seed = seed}), false);
        const Report report = analyze(unit, with_outputs(rows, linear), {{"bootstrap", "200"}});
        const auto holds = [&](const std::string& key) {
            width += (report.number(key + "_high") - report.number(key + "_low")) / 200;
            return report.number(key + "_low") <= 9. / 14 &&
                   9. / 14 <= report.number(key + "_high");
        };
        first += holds("x4.x1.first");
        total += holds("x4.x1.total");
    }
    for (const int count : {first, total}) EXPECT_GE(count, 88);
    EXPECT_LT(width, 0.4);
}

// The event u_1 < 0.3, u_2 < 0.5, u_3 < 0.9 has the probability p = 0.135, and the third input the
// total index 0.0135 / (p (1 - p)). Of 16 base rows, most show no effect of it: 40 of 100 intervals
// held the index. An input without effect on other outputs keeps [0, 0].
TEST(PickFreeze, IntervalsAllowForEventsThatNoRowHasShown) {
    const auto event = [](auto u) { return u[0] < 0.3 && u[1] < 0.5 && u[2] < 0.9 ? 1. : 0.; };
    const double total = 0.15 * 0.09 / (0.135 * 0.865);
    int held = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const auto rows =
            pick_freeze_rows(make("random", points(16, 6), {}, {.seed = seed}), false);
        const PointSet table = with_outputs(rows, event);
        const Report report = analyze(unit, table, {{"bootstrap", "100"}});
        if (report.find("x4.x3.total_low") == nullptr) continue;
        held +=
            report.number("x4.x3.total_low") <= total && total <= report.number("x4.x3.total_high");
    }
    EXPECT_GE(held, 88);
    const auto rows = pick_freeze_rows(make("random", points(16, 6)), false);
    const Report smooth = analyze(unit, with_outputs(rows, [](auto u) { return u[0] + u[1]; }));
    EXPECT_EQ(smooth.number("x4.x3.total_high"), 0);
}

TEST(PickFreeze, FewBaseRowsHaveNoIntervals) {
    const auto report_of = [](std::size_t rows) {
        return analyze(
            unit, with_outputs(pick_freeze_rows(make("random", points(rows, 6)), false), linear));
    };
    EXPECT_EQ(report_of(9).text("x4.no_intervals"), "9 base rows; intervals need 10");
    EXPECT_EQ(report_of(9).find("x4.x1.total_low"), nullptr);
    EXPECT_EQ(report_of(10).find("x4.no_intervals"), nullptr);
    EXPECT_NE(report_of(10).find("x4.x1.total_low"), nullptr);
}

TEST(PickFreeze, IntervalsFollowLevelAndSeed) {
    const PointSet table =
        with_outputs(pick_freeze_rows(make("random", points(64, 6)), true), ishigami);
    const auto width = [&](const Settings& settings) {
        const Report report = analyze(unit, table, settings);
        EXPECT_LT(report.number("x4.x1:x3.second_low"), report.number("x4.x1:x3.second"));
        EXPECT_GT(report.number("x4.x1:x3.second_high"), report.number("x4.x1:x3.second"));
        return report.number("x4.x1.total_high") - report.number("x4.x1.total_low");
    };
    EXPECT_LT(width({{"level", "0.5"}}), 0.5 * width({}));
    EXPECT_NE(width({}), width({{"bootstrap-seed", "2"}}));
    EXPECT_EQ(width({}), width({{"bootstrap-seed", "1"}, {"bootstrap", "1000"}}));
}

// Base rows with a failed run are ignored.
TEST(PickFreeze, LeavesOutBaseRowsWithFailedRuns) {
    const PointSet base = make("random", points(40, 6));
    PointSet some = with_outputs(pick_freeze_rows(base, false), ishigami);
    some[5 * 3 + 4][3] = std::nan("");
    some[5 * 3 + 1][3] = std::nan("");
    some[5 * 17][3] = std::nan("");
    Rows kept = points_in(base);
    kept.erase(kept.begin() + 17);
    kept.erase(kept.begin() + 3);
    const Report all =
        analyze(unit, with_outputs(pick_freeze_rows(points_of(kept), false), ishigami));
    const Report report = analyze(unit, some);
    EXPECT_EQ(report.number("x4.failed"), 3);
    EXPECT_EQ(report.number("x4.used"), 190);
    for (const char* key : {"x1.first", "x2.total", "x3.total_low", "x1.first_high", "variance"})
        EXPECT_EQ(report.number(std::string("x4.") + key), all.number(std::string("x4.") + key));
}

TEST(PickFreeze, GivesTheSameForAnyNumberOfThreads) {
    const PointSet table =
        with_outputs(pick_freeze_rows(make("sobol", points(256, 6)), true), ishigami);
    EXPECT_EQ(analyze(unit, table, {}, RunContext{.threads = 1}),
              analyze(unit, table, {}, RunContext{.threads = 5}));
}

// Large outputs, or large means, only add their own rounding errors.
TEST(PickFreeze, UnitsDoNotMatter) {
    const auto rows = pick_freeze_rows(make("sobol", points(256, 6)), false);
    const double plain = measure(unit, "x4.x1.first", with_outputs(rows, ishigami));
    for (const double factor : {1e-200, 1e200}) {
        const auto scaled = [&](auto u) { return factor * ishigami(u); };
        EXPECT_NEAR(measure(unit, "x4.x1.first", with_outputs(rows, scaled)), plain, 1e-12);
    }
    const auto moved = [](auto u) { return 1e6 + ishigami(u); };
    EXPECT_NEAR(measure(unit, "x4.x1.first", with_outputs(rows, moved)), plain, 1e-8);
}

// By hand: A and B have the outputs 0, 1, 0, 1 with variance 1/4, and one mixed row has 1e8.
TEST(PickFreeze, HasNoIndicesOfRowsThatAreNoSampleOfTheSame) {
    PointSet table =
        with_outputs(pick_freeze_rows(make("random", points(4, 4)), false), g_function);
    for (std::size_t i = 0; i < table.count(); ++i) table[i][2] = i % 4 == 3;
    table[1][2] = 1e8;
    const Report report = analyze(unit, table, {{"method", "saltelli"}});
    EXPECT_EQ(report.find("z.x.first"), nullptr);
    EXPECT_NE(report.find("z.x.missing"), nullptr);
    // If A and B do not vary at all, there is no index.
    for (std::size_t i = 0; i < table.count(); ++i) table[i][2] = i % 4 == 1;
    const Report none = analyze(unit, table, {{"method", "saltelli"}});
    for (const char* key : {"z.x.first", "z.y.total", "z.variance"})
        EXPECT_EQ(none.find(key), nullptr) << key;
}

// 2 / (1 - level) resamples have one or more beyond each end; one resample alone gave an "interval"
// that did not contain the index.
TEST(PickFreeze, FewResamplesGiveNoIntervals) {
    const PointSet table =
        with_outputs(pick_freeze_rows(make("random", points(16, 6)), false), linear);
    const auto report_of = [&](const char* resamples, const char* level) {
        return analyze(unit, table, {{"bootstrap", resamples}, {"level", level}});
    };
    EXPECT_EQ(report_of("38", "0.95").text("x4.no_intervals"),
              "38 resamples; intervals of the level 0.95 need 39");
    EXPECT_EQ(report_of("38", "0.95").find("x4.x1.first_low"), nullptr);
    EXPECT_NE(report_of("39", "0.95").find("x4.x1.first_low"), nullptr);
    EXPECT_EQ(report_of("1000", "0.9999").text("x4.no_intervals"),
              "1000 resamples; intervals of the level 0.9999 need 19999");
}

// Resamples of a single huge output gave the total index 1.0079 an interval of width 0.04.
TEST(PickFreeze, OneRowWithTheVarianceGivesNoIntervals) {
    PointSet table = with_outputs(pick_freeze_rows(make("random", points(64, 6)), false), linear);
    table[35][3] = 1e9;
    const Report report = analyze(unit, table);
    EXPECT_EQ(report.text("x4.no_intervals"),
              "99.9 % of the variance is in the points 35 to 39; resamples do not show how much "
              "such points vary");
    EXPECT_NE(report.find("x4.x1.total"), nullptr);
    EXPECT_EQ(report.find("x4.x1.total_low"), nullptr);
}

// Rows of complete groups that differ by rounding alone had indices of that rounding, if a group
// with a failed run differed more.
TEST(PickFreeze, RoundingIsNoVariance) {
    PointSet table = with_outputs(pick_freeze_rows(make("random", points(16, 6)), false),
                                  [](auto u) { return u[0] < 0.5 ? 0.3 : 0.3 + 0x1p-54; });
    table[7][3] = 5;
    table[8][3] = std::nan("");
    EXPECT_EQ(error_of([&] { analyze(unit, table); }),
              "input: the output x4 is constant in the 15 base rows without failed runs");
}

// The variance of outputs near 1e-200 is not 0, but beyond float64.
TEST(PickFreeze, VariancesBeyondFloat64AreLeftOut) {
    const auto rows = pick_freeze_rows(make("random", points(16, 6)), false);
    const auto of_size = [&](double size) {
        return analyze(unit, with_outputs(rows, [size](auto u) { return size * linear(u); }));
    };
    EXPECT_GT(of_size(1e-150).number("x4.variance"), 1e-301);
    for (const double size : {1e-200, 1e200}) {
        EXPECT_EQ(of_size(size).find("x4.variance"), nullptr);
        EXPECT_NEAR(of_size(size).number("x4.x1.total"), of_size(1).number("x4.x1.total"), 1e-12);
    }
}

}  // namespace stipple::testing::pick_freeze_test
