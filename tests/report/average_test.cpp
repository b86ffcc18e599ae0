// SPDX-License-Identifier: MIT
#include "report/average.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/spec.hpp"
#include "support/units.hpp"

namespace stipple::testing::average_test {
namespace {

Report sample(double x, std::int64_t n, const char* word) {
    Report inner;
    inner.add("curve", Report::Curve{x, 2 * x});
    Report report;
    report.add("value", x).add("count", n).add("word", word).add("exact", true).add("inner", inner);
    report.add("grid", Grid{1, 2, {x, -x}});
    return report;
}

/// Numbers under a key: a list, or a single one.
Report::Curve numbers_at(const Report& report, const std::string& key) {
    const Report::Item& item = *report.find(key);
    if (const auto* curve = std::get_if<Report::Curve>(&item)) return *curve;
    return {report.number(key)};
}

/// Variances, summed over the numbers of a key.
struct Scatter {
    double found = 0;   ///< variance of means between groups of sets
    double stated = 0;  ///< mean of the squared standard errors within groups
};

/// Scatter of each key that has a standard error, over groups of random sets.
std::map<std::string, Scatter> scatter_of(const char* words, const char* generator) {
    constexpr std::size_t groups = 60;
    constexpr std::size_t sets = 8;
    const Spec spec = parse_spec(words);
    const Analyzer& unit = find_analyzer(spec.name);
    const Values options = spec.values(unit.options);
    std::map<std::string, std::vector<Report::Curve>> values;
    std::map<std::string, Scatter> found;
    for (std::size_t group = 0; group < groups; ++group) {
        ReportAverage average;
        for (std::size_t set = 0; set < sets; ++set)
            average.add(analyze(unit,
                                make(generator, points(64, 2), {}, {.seed = group * sets + set}),
                                options, {}));
        Report mean = average.mean();
        unit.refine(mean, sets, options);
        const Report errors = average.standard_error(mean);
        for (const std::string& key : errors.keys()) {
            values[key].push_back(numbers_at(mean, key));
            for (const double error : numbers_at(errors, key))
                found[key].stated += error * error / groups;
        }
    }
    for (const auto& [key, all] : values)
        for (std::size_t i = 0; i < all[0].size(); ++i) {
            ReportAverage average;
            for (const auto& curve : all) average.add(Report().add("value", curve[i]));
            const double error = average.standard_error(average.mean()).number("value");
            found[key].found += error * error * groups;
        }
    return found;
}

}  // namespace

TEST(ReportAverage, MeanAndStandardErrorByHand) {
    ReportAverage average;
    for (const double x : {1.0, 2.0, 6.0})
        average.add(sample(x, static_cast<std::int64_t>(x), "same"));
    const Report& mean = average.mean();
    EXPECT_EQ(mean.number("value"), 3);
    EXPECT_EQ(mean.number("count"), 3);
    EXPECT_EQ(mean.text("word"), "same");
    EXPECT_EQ(mean.curve("inner.curve"), (Report::Curve{3, 6}));
    EXPECT_EQ(std::get<Grid>(*mean.find("grid")).values, (std::vector<double>{3, -3}));
    // Deviations -2, -1, 3: sum of squares 14, divided by 3 * 2.
    const Report error = average.standard_error(average.mean());
    EXPECT_NEAR(error.number("value"), std::sqrt(14.0 / 6), 1e-15);
    EXPECT_NEAR(error.curve("inner.curve")[1], 2 * std::sqrt(14.0 / 6), 1e-15);
    EXPECT_EQ(error.find("word"), nullptr);
    EXPECT_EQ(error.find("grid"), nullptr);
}

// Squares of the numbers are beyond float64.
TEST(ReportAverage, StandardErrorsOfTinyAndHugeNumbers) {
    for (const double size : {0x1p-1020, 0x1p-600, 1.0, 0x1p600, 0x1p1000}) {
        ReportAverage average;
        for (const double x : {1.0, 2.0, 6.0})
            average.add(Report().add("curve", Report::Curve{x * size, x, (x - 1) / size}));
        const Report error = average.standard_error(average.mean());
        EXPECT_DOUBLE_EQ(error.curve("curve")[0], size * std::sqrt(14.0 / 6));
        EXPECT_DOUBLE_EQ(error.curve("curve")[1], std::sqrt(14.0 / 6));
        EXPECT_DOUBLE_EQ(error.curve("curve")[2], std::sqrt(14.0 / 6) / size);
    }
}

TEST(ReportAverage, LeavesOutWhatReportsDisagreeOn) {
    ReportAverage average;
    average.add(sample(1, 1, "one"));
    Report other = sample(2, 2, "two");
    other.add("inner", Report().add("curve", Report::Curve{1, 2, 3}));
    average.add(other);
    EXPECT_EQ(average.mean().find("word"), nullptr);
    EXPECT_EQ(average.mean().find("inner.curve"), nullptr);
    EXPECT_NE(average.mean().find("exact"), nullptr);
}

TEST(ReportAverage, OneReportIsItsOwnMeanWithoutError) {
    ReportAverage average;
    average.add(sample(2, 5, "w"));
    EXPECT_EQ(average.mean().number("value"), 2);
    EXPECT_TRUE(average.standard_error(average.mean()).entries().empty());
}

TEST(ReportAverage, StandardErrorsOfWhatIsNotInTheMeanAreLeftOut) {
    ReportAverage average;
    for (const double x : {1.0, 2.0}) average.add(sample(x, 1, "same"));
    Report mean;
    mean.add("count", 1.0).add("inner", Report());
    const Report errors = average.standard_error(mean);
    EXPECT_EQ(errors.find("value"), nullptr);
    EXPECT_EQ(errors.find("inner.curve"), nullptr);
    EXPECT_EQ(errors.number("count"), 0);
    EXPECT_EQ(average.standard_error(average.mean()).curve("inner.curve"), (Report::Curve{0.5, 1}));
}

TEST(ReportAverage, WhatIsNoMeanHasNoStandardError) {
    ReportAverage average;
    for (const double x : {1.0, 2.0}) {
        Report report;
        report.add("estimate", x).add("p_value", x).add("combined_p_value", x);
        report.add("exponent_standard_error", x);
        report.add("exact", Report().add("mean", 1.0));
        report.add("one", Report().add("exact", 1.0).add("standard_error", x).add("error", x));
        average.add(report);
    }
    EXPECT_EQ(average.standard_error(average.mean()).keys(),
              (std::vector<std::string>{"estimate", "one.error"}));
}

// A standard deviation estimated from 60 values has an error of 9 %.
TEST(ReportAverage, StandardErrorsAreThoseOfTheValuesBesideThem) {
    for (const char* analyzer : {"periodogram:max-frequency=16", "differential:pixels=63"})
        for (const char* generator : {"best-candidate", "n-rooks"})
            for (const auto& [key, scatter] : scatter_of(analyzer, generator)) {
                constexpr double rounding = 1e-20;
                const double ratio =
                    std::sqrt((scatter.found + rounding) / (scatter.stated + rounding));
                EXPECT_GT(ratio, 0.7) << analyzer << ' ' << generator << ' ' << key;
                EXPECT_LT(ratio, 1.4) << analyzer << ' ' << generator << ' ' << key;
            }
}

}  // namespace stipple::testing::average_test
