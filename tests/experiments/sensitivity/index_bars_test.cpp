// SPDX-License-Identifier: MIT
//
// Charts of sensitivity indices.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "plot/chart.hpp"
#include "plot/report_charts.hpp"

namespace stipple::testing::index_bars_test {

using namespace plot;

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

namespace {

/// Indices of two inputs and their pair, for the outputs y and z.
Measurement indices() {
    Report results;
    for (const char* output : {"y", "z"}) {
        Report group;
        group.add("method", "saltelli").add("used", 64);
        const auto index = [](double first, double total) {
            Report own;
            own.add("first", first).add("first_low", first - 0.1).add("first_high", first + 0.2);
            own.add("total", total);
            return own;
        };
        group.add("length", index(0.5, 0.75)).add("width", index(0.25, 0.5));
        Report pair;
        pair.add("second", 0.25).add("second_low", 0.125).add("second_high", 0.375);
        group.add("length:width", pair);
        results.add(output, group);
    }
    return {.analyzer = "sensitivity",
            .source = "runs/y.csv",
            .count = 64,
            .dimension = 2,
            .domain = "unit-cube",
            .results = std::move(results)};
}

}  // namespace

TEST(IndexBars, HaveIntervals) {
    const Chart chart = chart_of(std::vector{indices()});
    EXPECT_EQ(chart.title, "Sensitivity of y.csv");
    ASSERT_EQ(chart.panels.size(), 4U);
    const ChartPanel& inputs = chart.panels[0];
    EXPECT_THAT(inputs.categories, ElementsAre("length", "width"));
    ASSERT_EQ(inputs.series.size(), 2U);
    EXPECT_EQ(inputs.series[0].name, "first");
    EXPECT_THAT(inputs.series[0].x, ElementsAre(1, 2));
    EXPECT_THAT(inputs.series[0].y, ElementsAre(0.5, 0.25));
    EXPECT_THAT(inputs.series[0].high, ElementsAre(DoubleEq(0.7), DoubleEq(0.45)));
    EXPECT_THAT(inputs.series[1].y, ElementsAre(0.75, 0.5));
    EXPECT_TRUE(std::isnan(inputs.series[1].low[0]));
    EXPECT_EQ(chart.panels[1].y_name, "y, second");
    EXPECT_THAT(chart.panels[1].categories, ElementsAre("length:width"));
    EXPECT_EQ(chart.panels[2].y_name, "z");
}

TEST(IndexBars, KeysPickOutputsAndIndices) {
    const auto panels = [](const char* key) {
        std::vector<std::string> names;
        for (const ChartPanel& panel : chart_of(std::vector{indices()}, key).panels)
            names.push_back(panel.y_name);
        return names;
    };
    EXPECT_THAT(panels("z"), ElementsAre("z", "z, second"));
    EXPECT_THAT(panels("total"), ElementsAre("y, total", "z, total"));
    EXPECT_THAT(panels("z.first"), ElementsAre("z, first"));
    EXPECT_THAT([] { (void)chart_of(std::vector{indices()}, "mu"); },
                ThrowsMessage<Error>(
                    HasSubstr("--key: the report of sensitivity has no output or index 'mu'")));
}

// Four bars in two groups, each with an interval of three lines; heights match the axis.
TEST(IndexBars, StandWhereTheAxesSay) {
    std::vector<Area> frames;
    const Chart chart = chart_of(std::vector{indices()}, "y.first");
    const Drawing drawing = draw_chart(chart, {}, &frames);
    const auto [x, y] = chart_axes(chart, 0, {});
    std::vector<Patch> bars;
    for (const auto& shape : drawing.shapes)
        if (const auto* patch = std::get_if<Patch>(&shape);
            patch != nullptr && patch->colour == light_theme.series_colour(0))
            bars.push_back(*patch);
    ASSERT_EQ(bars.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        double low = 1e9, high = -1e9, left = 1e9, right = -1e9;
        for (const Position& at : bars[i].vertices) {
            low = std::min(low, at.y);
            high = std::max(high, at.y);
            left = std::min(left, at.x);
            right = std::max(right, at.x);
        }
        const Area& f = frames[0];
        EXPECT_NEAR(low, f.bottom() - y.share(i == 0 ? 0.5 : 0.25) * f.height, 1e-9);
        EXPECT_NEAR(high, f.bottom() - y.share(0) * f.height, 1e-9);
        EXPECT_NEAR((left + right) / 2, f.left + x.share(static_cast<double>(i + 1)) * f.width,
                    1e-9);
    }
    EXPECT_LT(y.low, y.high);
    EXPECT_GT(y.high, 0.7);  // the ends of intervals are inside
}

}  // namespace stipple::testing::index_bars_test
