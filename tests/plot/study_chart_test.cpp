// SPDX-License-Identifier: MIT
#include "plot/study_chart.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/units.hpp"

namespace stipple::testing::study_chart_test {

using namespace plot;
using ::testing::ElementsAre;

namespace {

/// A mean at n points with the value `first` / n^power, and an interval of ten percent.
MeanRow mean_at(std::uint64_t n, double first, double power, const std::string& generator = "a",
                const std::string& key = "value", std::uint64_t dimension = 2) {
    const double mean = first * std::pow(static_cast<double>(n), -power);
    return {.generator = generator,
            .dimension = dimension,
            .count = n,
            .measure = "star-discrepancy",
            .key = key,
            .sets = 16,
            .mean = mean,
            .rms = 2 * std::abs(mean),
            .rms_low = std::abs(mean),
            .rms_high = 3 * std::abs(mean),
            .confidence = 0.95,
            .t_low = 0.9 * mean,
            .t_high = 1.1 * mean};
}

}  // namespace

TEST(StudyChart, DrawsMeansWithTheirIntervalsAndSlopes) {
    std::vector<MeanRow> means;
    for (const std::uint64_t n : {256, 16, 64}) {  // in the order of the study
        means.push_back(mean_at(n, 3, 1));
        means.push_back(mean_at(n, 2, 0.5, "b"));
    }
    const auto [chart, left_out] = study_chart(means);
    EXPECT_EQ(chart.title, "Star discrepancy");
    EXPECT_EQ(chart.subtitle, "d = 2 · means of 16 sets, with 95 % intervals");
    EXPECT_THAT(left_out, ElementsAre());
    ASSERT_EQ(chart.panels.size(), 1U);
    const ChartPanel& panel = chart.panels[0];
    EXPECT_TRUE(panel.log_x && panel.log_y);
    EXPECT_EQ(panel.y_name, "star discrepancy");
    ASSERT_EQ(panel.series.size(), 2U);
    EXPECT_EQ(panel.series[0].name, "a (slope −1.00 ± 0.00)");
    EXPECT_EQ(panel.series[1].name, "b (slope −0.50 ± 0.00)");
    EXPECT_THAT(panel.series[0].x, ElementsAre(16, 64, 256));
    EXPECT_THAT(panel.series[0].y, ElementsAre(3.0 / 16, 3.0 / 64, 3.0 / 256));
    EXPECT_DOUBLE_EQ(panel.series[1].low[0], 0.45);
    EXPECT_DOUBLE_EQ(panel.series[1].high[0], 0.55);
}

TEST(StudyChart, ASingleCurveHasItsGeneratorInTheTitle) {
    const std::vector<MeanRow> means = {mean_at(16, 3, 1, "sobol:scramble=owen"),
                                        mean_at(64, 3, 1, "sobol:scramble=owen")};
    EXPECT_EQ(study_chart(means).chart.title, "Star discrepancy of sobol:scramble=owen");
}

// 1, 2 and 6 over 2, 4 and 8 points: u = ln n = (1, 2, 3) ln 2, v = ln y = 0, ln 2, ln 6; the slope is
// (v3 - v1) / (2 ln 2) = ln 6 / ln 4. The residuals are r, -2 r and r with r = ln(3/2) / 6, so the
// standard error is sqrt(6 r^2 / 2) / ln 2 = 0.169.
TEST(StudyChart, SlopesAreThoseOfLeastSquares) {
    std::vector<MeanRow> means;
    for (const auto& [n, mean] : {std::pair{2, 1.0}, {4, 2.0}, {8, 6.0}}) {
        means.push_back(mean_at(static_cast<std::uint64_t>(n), 1, 0));
        means.back().mean = mean;
    }
    EXPECT_EQ(study_chart(means).chart.panels[0].series[0].name, "a (slope 1.29 ± 0.17)");
    means[1].mean = 0;
    EXPECT_EQ(study_chart(means).chart.panels[0].series[0].name, "a");
    EXPECT_FALSE(study_chart(means).chart.panels[0].log_y);
    means.resize(2);
    EXPECT_EQ(study_chart(means).chart.panels[0].series[0].name, "a");
    means[1].mean = 2;  // two values leave no residual, and so no error
    EXPECT_EQ(study_chart(means).chart.panels[0].series[0].name, "a (slope 1.00)");
    means.resize(1);
    EXPECT_EQ(study_chart(means).chart.panels[0].series[0].name, "a");
}

TEST(StudyChart, OfErrorsTheRootMeanSquareCounts) {
    const std::vector<MeanRow> means = {mean_at(16, -1, 1, "a", "cube.error"),
                                        mean_at(64, 1, 1, "a", "cube.error")};
    const ChartPanel panel = study_chart(means, "cube.error").chart.panels[0];
    EXPECT_TRUE(panel.y_name.starts_with("RMS of ")) << panel.y_name;
    EXPECT_TRUE(panel.log_y);
    EXPECT_THAT(panel.series[0].y, ElementsAre(2.0 / 16, 2.0 / 64));
    EXPECT_THAT(panel.series[0].low, ElementsAre(1.0 / 16, 1.0 / 64));
    EXPECT_THAT(panel.series[0].high, ElementsAre(3.0 / 16, 3.0 / 64));
}

// Decibels and exponents may be negative; their distance from 0 is no error.
TEST(StudyChart, NegativeMeansAreDrawnAsTheyAre) {
    const std::vector<MeanRow> means = {
        mean_at(16, -1, 1, "a", "anisotropy_db"), mean_at(64, 1, 1, "a", "anisotropy_db"),
        mean_at(16, 2, 1, "b", "anisotropy_db"), mean_at(64, 2, 1, "b", "anisotropy_db")};
    const ChartPanel panel = study_chart(means, "anisotropy_db").chart.panels[0];
    EXPECT_EQ(panel.y_name, "anisotropy db");
    EXPECT_FALSE(panel.log_y);
    EXPECT_THAT(panel.series[0].y, ElementsAre(-1.0 / 16, 1.0 / 64));
    EXPECT_THAT(panel.series[1].low, ElementsAre(1.8 / 16, 1.8 / 64));
}

// Slopes differ between panels, so each has its own legend, with the same colours; a generator that
// is missing in one panel does not change the others.
TEST(StudyChart, EachPanelHasItsOwnSlopes) {
    std::vector<MeanRow> means;
    for (const std::uint64_t n : {10, 20, 40}) {
        means.push_back(mean_at(n, 1, 1, "a", "one"));
        means.push_back(mean_at(n, 1, 0.5, "b", "one"));
        means.push_back(mean_at(n, 1, 2, "b", "two"));
        means.push_back(mean_at(n, 1, 0.25, "c", "two"));
    }
    const Chart chart = study_chart(means).chart;
    ASSERT_EQ(chart.panels.size(), 2U);
    EXPECT_TRUE(needs_legend(chart, 0) && needs_legend(chart, 1));
    EXPECT_EQ(chart.panels[0].series[1].set, chart.panels[1].series[0].set);
    std::vector<std::pair<std::string, Colour>> legend;  // names after their lines
    const Drawing drawing = draw_chart(chart, {});
    for (std::size_t i = 1; i < drawing.shapes.size(); ++i)
        if (const auto* label = std::get_if<Label>(&drawing.shapes[i]))
            if (const auto* line = std::get_if<Line>(&drawing.shapes[i - 1]))
                if (label->text.find("slope") != std::string::npos)
                    legend.emplace_back(label->text, line->colour);
    const auto colour = [](std::size_t i) { return light_theme.series_colour(i); };
    const std::vector<std::pair<std::string, Colour>> expected = {
        {"a (slope −1.00 ± 0.00)", colour(0)},
        {"b (slope −0.50 ± 0.00)", colour(1)},
        {"b (slope −2.00 ± 0.00)", colour(1)},
        {"c (slope −0.25 ± 0.00)", colour(2)}};
    EXPECT_EQ(legend, expected);
}

TEST(StudyChart, ResultsAndDimensionsHavePanels) {
    std::vector<MeanRow> means;
    for (const std::uint64_t d : {2, 3})
        for (const char* key : {"star.value", "star.squared", "centered.value"})
            for (const std::uint64_t n : {10, 20}) means.push_back(mean_at(n, 1, 1, "a", key, d));
    const auto names = [&](const std::string& key) {
        std::vector<std::string> found;
        const auto [chart, left_out] = study_chart(means, key);
        for (const ChartPanel& panel : chart.panels) found.push_back(panel.y_name);
        found.insert(found.end(), left_out.begin(), left_out.end());
        return found;
    };
    EXPECT_THAT(names(""),
                ElementsAre("star, d = 2", "centered, d = 2", "star, d = 3", "centered, d = 3"));
    EXPECT_THAT(names("squared"), ElementsAre("star squared, d = 2", "star squared, d = 3"));
    EXPECT_EQ(names("star").size(), 4U);
    EXPECT_EQ(study_chart(means, "star").left_out.size(), 0U);
    for (MeanRow& row : means) row.key = row.key.substr(0, row.key.find('.')) + row.key;
    EXPECT_EQ(study_chart(means).chart.panels.size() + study_chart(means).left_out.size(), 4U);
    EXPECT_EQ(error_of([&] { study_chart(means, "nonsense"); }),
              "usage: --key: the study has no result 'nonsense' | known: starstar.value, "
              "starstar.squared, centeredcentered.value");
    for (MeanRow& row : means) row.mean = std::nan("");
    EXPECT_EQ(error_of([&] { study_chart(means); }), "input: the study has no numbers to draw");
}

// No measure is dropped silently: those without a result "value" show all that they have.
TEST(StudyChart, EveryMeasureIsDrawnOrLeftOutByName) {
    std::vector<MeanRow> means;
    for (const char* key : {"minimum", "mean", "relative_radius", "pairs"})
        means.push_back(mean_at(16, 1, 1, "a", key));
    for (MeanRow& row : means) row.measure = "nearest-neighbor";
    for (const char* key : {"value", "lower"}) means.push_back(mean_at(16, 1, 1, "a", key));
    const auto [chart, left_out] = study_chart(means);
    std::vector<std::string> names;
    for (const ChartPanel& panel : chart.panels) names.push_back(panel.y_name);
    EXPECT_THAT(names,
                ElementsAre("star discrepancy", "minimum (nearest neighbor)",
                            "mean (nearest neighbor)", "relative radius (nearest neighbor)"));
    EXPECT_THAT(left_out, ElementsAre("pairs"));
}

// A result's name draws this result alone; a part of names, all that have it.
TEST(StudyChart, AKeyIsAResultOrAPartOfSome) {
    std::vector<MeanRow> means;
    for (const char* key : {"value", "centered.value", "centered.squared"})
        for (const std::uint64_t n : {16, 64}) means.push_back(mean_at(n, 3, 1, "a", key));
    const auto names = [&](const std::string& key) {
        std::vector<std::string> found;
        for (const auto& panel : study_chart(means, key).chart.panels)
            found.push_back(panel.y_name);
        return found;
    };
    EXPECT_THAT(names("value"), ElementsAre("star discrepancy"));
    EXPECT_THAT(names("centered"), ElementsAre("centered", "centered squared"));
    EXPECT_EQ(names("").size(), 2U);
}

TEST(StudyChart, CountsThatArePowersOfTwoAreNumberedSo) {
    const auto numbers = [](std::initializer_list<std::uint64_t> counts) {
        std::vector<MeanRow> means;
        for (const std::uint64_t n : counts) means.push_back(mean_at(n, 1, 1));
        std::vector<std::string> texts;
        const Axis axis = chart_axes(study_chart(means).chart, 0, {}).first;
        for (const Tick& tick : axis.ticks(600, false).numbers) texts.push_back(tick.text);
        return texts;
    };
    EXPECT_THAT(numbers({16, 64, 256}), ElementsAre("16", "32", "64", "128", "256"));
    EXPECT_THAT(
        numbers({1ULL << 10, 1ULL << 30}),
        ElementsAre("2¹⁰", "2¹²", "2¹⁴", "2¹⁶", "2¹⁸", "2²⁰", "2²²", "2²⁴", "2²⁶", "2²⁸", "2³⁰"));
    EXPECT_THAT(numbers({10, 100, 1000}), ElementsAre("10", "100", "1000"));
}

}  // namespace stipple::testing::study_chart_test
