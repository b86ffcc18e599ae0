// SPDX-License-Identifier: MIT
//
// Charts of reports: choice and correctness of the drawn shapes.
#include "plot/chart.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "core/error.hpp"
#include "plot/drawing/letters.hpp"
#include "plot/figure.hpp"
#include "plot/local_discrepancy.hpp"
#include "plot/pair_table.hpp"
#include "plot/points_picture.hpp"
#include "plot/report_charts.hpp"
#include "plot/spectral_table.hpp"
#include "report/document.hpp"
#include "support/units.hpp"

namespace stipple::testing::chart_test {

using namespace plot;

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace {

Measurement measurement(const std::string& analyzer, Report results, const std::string& source,
                        std::uint64_t count = 64) {
    return {.analyzer = analyzer,
            .source = source,
            .count = count,
            .dimension = 2,
            .domain = "unit-cube",
            .results = std::move(results)};
}

Measurement spectrum(const std::string& source, std::vector<double> power) {
    Report radial;
    radial.add("frequency", Report::Curve{1, 2, 3});
    radial.add("power", std::move(power));
    radial.add("anisotropy_db", Report::Curve{0, -1, 2});
    radial.add("cells", Report::Curve{8, 12, 16});
    Report results;
    results.add("radial", std::move(radial));
    results.add("effective_nyquist", 0.5);
    return measurement("periodogram", std::move(results), source);
}

Measurement number(double value, std::uint64_t count, const std::string& source = "a.csv") {
    Report results;
    results.add("value", value);
    results.add("method", "sweep");
    return measurement("star-discrepancy", std::move(results), source, count);
}

std::string refusal(const std::vector<Measurement>& ms, const std::string& key = {}) {
    try {
        chart_of(ms, key);
    } catch (const Error& e) {
        return std::string(e.what()) + "; " + e.hint();
    }
    return "none";
}

std::string bad_json(const std::string& text) {
    try {
        read_reports(text, "f.json");
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::input);
        return e.what();
    }
    return "none";
}

template <class S>
std::vector<const S*> shapes_of(const Drawing& drawing) {
    std::vector<const S*> found;
    for (const Shape& shape : drawing.shapes)
        if (const auto* s = std::get_if<S>(&shape)) found.push_back(s);
    return found;
}

bool has_text(const Drawing& drawing, const std::string& text) {
    return std::ranges::any_of(shapes_of<Label>(drawing),
                               [&](const Label* label) { return label->text == text; });
}

}  // namespace

// ---------------------------------------------------------------- reading reports

TEST(ReadDocument, IsTheWayBack) {
    std::vector<Measurement> ms = {spectrum("a.csv", {0.5, std::nan(""), 1}),
                                   number(0.25, 10, "b.csv")};
    ms[0].sets = 3;
    ms[0].options = {{"method", "nufft"}, {"tolerance", "1e-09"}};
    ms[0].standard_error = Report().add("value", 0.5);
    ms[1].set = 4;
    const std::string json = to_json(ms);
    EXPECT_TRUE(looks_like_reports(json));
    const auto back = read_reports(json, "f.json");
    ASSERT_EQ(back.size(), 2U);
    EXPECT_EQ(to_json(back), json);
    EXPECT_TRUE(std::isnan(back[0].results.curve("radial.power")[1]));
    EXPECT_EQ(back[1].set, 4U);
}

TEST(ReadDocument, TakesTextsOneAfterTheOther) {
    const std::vector<Measurement> one = {number(0.25, 10, "has { and \" in it")};
    const std::string text = to_json(one);
    EXPECT_EQ(read_reports(text + text + "\n" + text, "f").size(), 3U);
}

TEST(ReadDocument, RefusesWhatIsNoReport) {
    EXPECT_EQ(bad_json("[]"), "f.json: contains no report; expected the JSON of 'stipple analyze'");
    EXPECT_THAT(bad_json("[{\"format\":\"stipple.points\"}]"),
                HasSubstr("an entry is not a report"));
    EXPECT_THAT(bad_json("{\"format\":\"stipple.report\",\"version\":2}"), HasSubstr("version 2"));
    EXPECT_THAT(bad_json("{\"format\":\"stipple.report\",\"vers"),
                HasSubstr("incomplete or invalid JSON"));
    EXPECT_THAT(
        bad_json("{\"format\":\"stipple.report\",\"version\":1e999}"),
        HasSubstr("byte 38 of a report: the number '1e999' is out of the range of a double"));
    const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
    EXPECT_THAT(bad_json("{\"format\":\"stipple.report\",\"options\":" + deep + "}"),
                HasSubstr("lists are nested too deeply; expected the JSON"));
    // The parser copies a value recursively if another key follows it.
    EXPECT_THAT(
        bad_json("{\"format\":\"stipple.report\",\"input\":{\"source\":" + deep + ",\"count\":2}}"),
        HasSubstr("byte 64 of a report: lists are nested too deeply"));
    EXPECT_FALSE(looks_like_reports("x,y\n0.1,0.2\n"));
    EXPECT_FALSE(looks_like_reports("[[0.1,0.2]]"));
    EXPECT_FALSE(looks_like_reports("{\"format\":\"stipple.points\",\"version\":1}"));
}

// ---------------------------------------------------------------- shapes

TEST(ReportCharts, SpectrumHasPowerAndAnisotropyAsReported) {
    std::vector<Measurement> ms = {spectrum("dir/a.csv", {0.5, 1.5, 1})};
    ms[0].sets = 4;
    ms[0].standard_error =
        Report().add("radial", Report().add("power", Report::Curve{0.1, 0.2, 0.3}));
    const Chart chart = chart_of(ms);
    ASSERT_EQ(chart.panels.size(), 2U);
    EXPECT_EQ(chart.title, "Power spectrum of 4 sets: a.csv");
    EXPECT_THAT(chart.subtitle, HasSubstr("effective Nyquist frequency 0.5"));
    const Series& power = chart.panels[0].series.at(0);
    EXPECT_THAT(power.x, ElementsAre(1, 2, 3));
    EXPECT_THAT(power.y, ElementsAre(0.5, 1.5, 1));
    EXPECT_THAT(power.high, ElementsAre(0.6, 1.7, 1.3));
    EXPECT_THAT(power.low, ElementsAre(0.4, 1.3, 0.7));
    EXPECT_FALSE(chart.panels[0].log_y);
    const auto [low, high] = white_noise_band(12, 4);
    EXPECT_EQ(chart.panels[0].bands.at(0).high[1], high);
    EXPECT_EQ(chart.panels[0].bands.at(0).low[1], low);
    EXPECT_EQ(chart.panels[1].guides.at(0).name, "white noise: −6.02 dB");
    EXPECT_NEAR(chart.panels[1].guides.at(0).y[0], -10 * std::log10(4.0), 1e-12);
}

// Chi-square with 20 degrees of freedom, divided by 20: 2.5 % points 9.591 and 34.170 from tables.
TEST(ReportCharts, WhiteNoiseBandIsThatOfChiSquare) {
    const auto [low, high] = white_noise_band(20, 1);
    EXPECT_NEAR(low, 9.591 / 20, 2e-3);
    EXPECT_NEAR(high, 34.170 / 20, 2e-3);
}

TEST(ReportCharts, PeaksGetALogarithmicAxis) {
    const std::vector<Measurement> ms = {spectrum("a.csv", {0.5, 50, 1})};
    EXPECT_TRUE(chart_of(ms).panels[0].log_y);
}

TEST(ReportCharts, SeveralReportsAreSeveralCurvesOfOneLegend) {
    const std::vector<Measurement> ms = {spectrum("a.csv", {1, 2, 3}),
                                         spectrum("b.csv", {3, 2, 1})};
    const Drawing drawing = draw_chart(chart_of(ms), {});
    EXPECT_TRUE(has_text(drawing, "a.csv"));
    EXPECT_TRUE(has_text(drawing, "b.csv"));
    EXPECT_TRUE(has_text(drawing, "frequency"));
    EXPECT_TRUE(has_text(drawing, "radial power"));
    EXPECT_TRUE(has_text(drawing, "anisotropy (dB)"));
    EXPECT_EQ(drawing.title, "Power spectrum");
}

// The ends of a curve are at the positions of the axes: x from 1 to 3, y from 0 to 1.4 and 6 %.
TEST(ReportCharts, CurvesAreWhereTheAxesSay) {
    const std::vector<Measurement> ms = {spectrum("a.csv", {0, 0.7, 1.4})};
    const Drawing drawing = draw_chart(chart_of(ms), {});
    const Line* curve = nullptr;
    for (const Line* line : shapes_of<Line>(drawing))
        if (line->vertices.size() == 3 && curve == nullptr) curve = line;
    ASSERT_NE(curve, nullptr);
    EXPECT_NEAR(curve->vertices[1].x, (curve->vertices[0].x + curve->vertices[2].x) / 2, 1e-9);
    EXPECT_NEAR(curve->vertices[1].y, (curve->vertices[0].y + curve->vertices[2].y) / 2, 1e-9);
    EXPECT_GT(curve->vertices[0].y, curve->vertices[2].y);
    const auto [x, y] = chart_axes(chart_of(ms), 0, {});
    EXPECT_EQ(x.low, 1);
    EXPECT_EQ(x.high, 3);
    EXPECT_EQ(y.low, 0);
    EXPECT_NEAR(y.high, 1.4 * 1.06, 1e-12);
}

TEST(ReportCharts, PrefixesAreLogarithmicWithBoundsAsABand) {
    Report prefixes;
    prefixes.add("count", Report::Integers{16, 32, 64});
    prefixes.add("value", Report::Curve{0.4, 0.2, 0.1});
    prefixes.add("lower", Report::Curve{0.4, 0.2, 0.1});
    prefixes.add("upper", Report::Curve{0.5, 0.3, 0.2});
    Report results;
    results.add("prefixes", std::move(prefixes));
    const std::vector<Measurement> ms = {measurement("star-discrepancy", results, "a.csv")};
    const Chart chart = chart_of(ms);
    ASSERT_EQ(chart.panels.size(), 1U);
    const ChartPanel& panel = chart.panels[0];
    EXPECT_TRUE(panel.log_x && panel.log_y);
    EXPECT_THAT(panel.series.at(0).high, ElementsAre(0.5, 0.3, 0.2));
    EXPECT_EQ(panel.y_name, "star discrepancy");
    // Guides fall as n^(-1/2) and n^(-1), starting at 1.5 times the first value.
    EXPECT_THAT(panel.guides.at(0).y, ElementsAre(DoubleEq(0.6), DoubleEq(0.3)));
    EXPECT_THAT(panel.guides.at(1).y, ElementsAre(DoubleEq(0.6), DoubleEq(0.15)));
}

TEST(ReportCharts, PairCorrelationHasWhatUniformPointsHave) {
    Report results;
    results.add("distance", Report::Curve{0.1, 0.2});
    results.add("density", Report::Curve{0, 1.1});
    results.add("deviation", Report::Curve{0.6, 0.1});
    std::vector<Measurement> ms = {measurement("pair-correlation", results, "-")};
    ms[0].sets = 4;
    const ChartPanel panel = chart_of(ms).panels.at(0);
    EXPECT_THAT(panel.series.at(0).y, ElementsAre(0, 1.1));
    EXPECT_THAT(panel.bands.at(0).low, ElementsAre(0.4, 0.9));
    EXPECT_THAT(panel.bands.at(0).high, ElementsAre(1.6, 1.1));
}

// Curves of an analyzer's record are drawn; other lists over the same abscissas if they are named.
TEST(ReportCharts, CurvesOfTheRecordAreDrawn) {
    Report results;
    results.add("exponent", 1.5);
    results.add("radius", Report::Curve{1, 2, 4});
    results.add("mean", Report::Curve{3, 12, 50});
    results.add("variance", Report::Curve{2, 5, 11});
    results.add("dispersion", Report::Curve{0.7, 0.5, 0.3});
    std::vector<Measurement> ms = {measurement("hyperuniformity", results, "a.csv")};
    Chart chart = chart_of(ms);
    ASSERT_EQ(chart.panels.size(), 2U);
    EXPECT_THAT(chart.panels[0].series.at(0).y, ElementsAre(2, 5, 11));
    EXPECT_THAT(chart.panels[0].guides.at(0).y, ElementsAre(3, 12, 50));
    chart = chart_of(ms, "dispersion");
    ASSERT_EQ(chart.panels.size(), 1U);
    EXPECT_THAT(chart.panels[0].series.at(0).y, ElementsAre(0.7, 0.5, 0.3));
    EXPECT_THAT(chart_of(ms, "mean").panels.at(0).series.at(0).y, ElementsAre(3, 12, 50));
    EXPECT_THAT(refusal(ms, "nothing"), HasSubstr("variance, dispersion"));

    Report valence;
    valence.add("neighbors", Report::Integers{3, 4, 5, 6, 7});
    valence.add("share", Report::Curve{0, 0.1, 0.3, 0.6, 0});
    ms = {measurement("voronoi", Report().add("valence", valence), "a.csv")};
    chart = chart_of(ms);
    EXPECT_THAT(chart.panels.at(0).bars.at(0).edges, ElementsAre(3.5, 4.5, 5.5, 6.5));
    EXPECT_THAT(chart.panels.at(0).bars.at(0).heights, ElementsAre(0.1, 0.3, 0.6));
}

TEST(ReportCharts, NumbersOfSeveralSizesAreACurveOverTheSize) {
    const std::vector<Measurement> ms = {number(0.1, 256), number(0.4, 16), number(0.2, 64)};
    const ChartPanel panel = chart_of(ms).panels.at(0);
    EXPECT_THAT(panel.series.at(0).x, ElementsAre(16, 64, 256));
    EXPECT_THAT(panel.series.at(0).y, ElementsAre(0.4, 0.2, 0.1));
    EXPECT_TRUE(panel.log_x && panel.log_y);
}

// Files whose names differ only in digits are one curve; several sets of one size give a mean with
// its standard error: for 0.1, 0.2 and 0.3 it is sqrt(0.02 / 6).
TEST(ReportCharts, FilesOfOneNameAreOneCurveOfMeans) {
    const std::vector<Measurement> ms = {
        number(0.5, 16, "d/halton_16.csv"), number(0.1, 64, "d/halton_64.csv"),
        number(0.2, 64, "d/halton_64.csv"), number(0.3, 64, "d/halton_64.csv"),
        number(0.7, 16, "d/random16.csv"),  number(0.6, 64, "d/random64.csv")};
    const ChartPanel panel = chart_of(ms).panels.at(0);
    ASSERT_EQ(panel.series.size(), 2U);
    EXPECT_EQ(panel.series[0].name, "halton (slope −0.66)");
    EXPECT_EQ(panel.series[1].name, "random (slope −0.11)");
    EXPECT_NEAR(panel.series[0].y.at(1), 0.2, 1e-15);
    EXPECT_NEAR(panel.series[0].high.at(1) - 0.2, std::sqrt(0.02 / 6), 1e-15);
    EXPECT_THAT(panel.series[1].y, ElementsAre(0.7, 0.6));
    EXPECT_TRUE(panel.series[1].low.empty());
}

TEST(ReportCharts, DigitsThatAreNoCountsStayInNames) {
    const auto names = [](const std::vector<Measurement>& ms) {
        std::vector<std::string> all;
        const Chart chart = chart_of(ms);
        for (const auto& series : chart.panels.at(0).series)
            all.push_back(series.name.substr(0, series.name.find(" (slope ")));
        return all;
    };
    EXPECT_THAT(names({number(0.5, 16, "pmj02_16.npy"), number(0.4, 64, "pmj02_64.npy"),
                       number(0.5, 16, "pmj_16.npy"), number(0.4, 64, "pmj_64.npy")}),
                ElementsAre("pmj02", "pmj"));
    EXPECT_THAT(names({number(0.5, 16, "rank1-lattice-n16-seed3.csv"),
                       number(0.4, 64, "rank1-lattice-n64-seed14.csv")}),
                ElementsAre("rank1-lattice"));
    EXPECT_THAT(names({number(0.5, 16, "16.csv"), number(0.4, 64, "64.csv")}), ElementsAre(""));
}

// The root mean square of 3 and -4 is sqrt(12.5).
TEST(ReportCharts, ErrorsAreDrawnByTheirRootMeanSquare) {
    std::vector<Measurement> ms;
    for (const auto& [error, n] : {std::pair{3.0, 10U}, {-4.0, 10U}, {-1.0, 20U}})
        ms.push_back(measurement("integration", Report().add("f", Report().add("error", error)),
                                 "a.csv", n));
    const ChartPanel panel = chart_of(ms, "f.error").panels.at(0);
    EXPECT_THAT(panel.series.at(0).y, ElementsAre(std::sqrt(12.5), 1));
    ms = {measurement("integration", Report().add("error", 3e-200), "a.csv", 10),
          measurement("integration", Report().add("error", 4e200), "a.csv", 20)};
    EXPECT_THAT(chart_of(ms, "error").panels.at(0).series.at(0).y, ElementsAre(3e-200, 4e200));
}

TEST(ReportCharts, NoPowerIsAGapInTheAnisotropy) {
    Report radial;
    radial.add("distance", Report::Curve{1, 2, 3});
    radial.add("density", Report::Curve{0, 2, 1});
    radial.add("anisotropy_db", Report::Curve{-100, -3, 0});
    radial.add("cells", Report::Curve{8, 12, 16});
    const std::vector<Measurement> ms = {
        measurement("differential", Report().add("radial", radial), "a.csv")};
    const Chart chart = chart_of(ms);
    ASSERT_EQ(chart.panels.size(), 2U);
    EXPECT_TRUE(std::isnan(chart.panels[1].series.at(0).y[0]));
    EXPECT_EQ(chart.panels[1].series.at(0).y[1], -3);
}

// A ring in one dimension has a frequency and its negative, with equal power.
TEST(ReportCharts, NoAnisotropyInOneDimension) {
    std::vector<Measurement> ms = {spectrum("a.csv", {0.5, 1, 1})};
    EXPECT_EQ(chart_of(ms).panels.size(), 2U);
    ms[0].dimension = 1;
    EXPECT_EQ(chart_of(ms).panels.size(), 1U);
}

TEST(ReportCharts, TellsTheOscillationOnlyWhereItIsComplete) {
    std::vector<Measurement> ms = {spectrum("a.csv", {0.5, 1, 1})};
    ms[0].results.add("oscillation", 1.25);
    const auto told = [&] { return chart_of(ms).subtitle.find("oscillation 1.25"); };
    EXPECT_EQ(told(), std::string::npos);
    ms[0].results.add("oscillation_complete", false);
    EXPECT_EQ(told(), std::string::npos);
    ms[0].results.add("oscillation_complete", true);
    EXPECT_NE(told(), std::string::npos);
}

TEST(ReportCharts, FlagsAreNoCurves) {
    Report prefixes;
    prefixes.add("count", Report::Curve{1, 2, 3});
    prefixes.add("value", Report::Curve{0.5, 0.25, 0.125});
    prefixes.add("exact", Report::Curve{1, 1, 0});
    const std::vector<Measurement> ms = {
        measurement("star-discrepancy", Report().add("prefixes", prefixes), "a.csv"),
        measurement("star-discrepancy", Report().add("prefixes", prefixes), "b.csv")};
    const Chart chart = chart_of(ms);
    ASSERT_EQ(chart.panels.size(), 1U);
    EXPECT_EQ(chart.panels[0].y_name, "star discrepancy");
}

TEST(ReportCharts, TellsMeanDistancesOnTheAxis) {
    Report results;
    results.add("radius", Report::Curve{1, 2, 3});
    results.add("variance", Report::Curve{1, 2, 3});
    const auto chart = chart_of(std::vector{measurement("hyperuniformity", results, "a.csv")});
    EXPECT_EQ(chart.panels.at(0).x_name, "radius / mean distance");
}

TEST(ReportCharts, NumbersOfOneSizeAreAHistogramThatCountsThem) {
    std::vector<Measurement> ms;
    for (int i = 0; i < 50; ++i) ms.push_back(number(0.1 + 0.01 * (i % 7), 64));
    const Bars bars = chart_of(ms).panels.at(0).bars.at(0);
    double sum = 0;
    for (const double height : bars.heights) sum += height;
    EXPECT_EQ(sum, 50);
    EXPECT_DOUBLE_EQ(bars.edges.front(), 0.1);
    EXPECT_DOUBLE_EQ(bars.edges.back(), 0.16);
    EXPECT_EQ(chart_of(std::vector{number(1, 8), number(1, 8)}).panels.size(), 1U);
    // Whole numbers have a bar each or, if there are many, each bar has equally many.
    for (const int most : {13, 50}) {
        ms.clear();
        for (int i = 0; i < 2 * most; ++i) ms.push_back(number(i % most, 64));
        const Bars whole = chart_of(ms).panels.at(0).bars.at(0);
        EXPECT_EQ(whole.edges.front(), -0.5);
        for (std::size_t i = 0; i + 1 < whole.heights.size(); ++i)
            EXPECT_EQ(whole.heights[i], most == 13 ? 2 : 6);
        EXPECT_EQ(whole.heights.back(), most == 13 ? 2 : 4);
    }
}

TEST(ReportCharts, HistogramsOfNumbersHaveBinsOfLogarithmsOnALogAxis) {
    std::vector<Measurement> ms;
    for (int i = 0; i < 60; ++i) ms.push_back(number(i < 5 ? 0 : std::exp2(-0.5 * i), 64));
    const ChartPanel panel = chart_of(ms, "", true).panels.at(0);
    EXPECT_EQ(panel.values, 60U);
    EXPECT_EQ(panel.off_axis, 5U);
    const Bars& bars = panel.bars.at(0);
    double sum = 0;
    for (std::size_t i = 0; i < bars.heights.size(); ++i) {
        EXPECT_NEAR(bars.edges[i + 1] / bars.edges[i], bars.edges[1] / bars.edges[0], 1e-9);
        EXPECT_NEAR(bars.heights[i], 55.0 / static_cast<double>(bars.heights.size()), 1.5);
        sum += bars.heights[i];
    }
    EXPECT_EQ(sum, 55);
    // Numbers too small for an axis are scaled: three values, not one bar at 0.
    ms = {number(2e-305, 64), number(4e-305, 64), number(6e-305, 64)};
    const ChartPanel tiny = chart_of(ms).panels.at(0);
    EXPECT_THAT(tiny.x_name, HasSubstr("(×10⁻³⁰⁰)"));
    EXPECT_EQ(std::ranges::count_if(tiny.bars.at(0).heights, [](double h) { return h > 0; }), 3);
}

TEST(ReportCharts, WholeNumbersOnALogAxisAreCounted) {
    std::vector<Measurement> ms;
    for (const auto& [value, sets] : {std::pair{1, 3}, {2, 3}, {10, 5}, {20, 6}})
        for (int i = 0; i < sets; ++i) ms.push_back(number(value, 64));
    const Bars bars = chart_of(ms, "", true).panels.at(0).bars.at(0);
    ASSERT_EQ(bars.heights.size(), 20U);
    EXPECT_EQ(bars.heights[0], 3);
    EXPECT_EQ(bars.heights[9], 5);
    EXPECT_EQ(bars.heights[19], 6);
}

TEST(ReportCharts, SaysWhatCanBeDrawnWhereNothingCan) {
    EXPECT_THAT(refusal({number(0.1, 64)}),
                HasSubstr("a single report of star-discrepancy has only numbers, nothing to draw; "
                          "curves can be drawn"));
    EXPECT_THAT(refusal({number(0.1, 64), spectrum("a", {1, 1, 1})}),
                HasSubstr("reports of different analyzers, star-discrepancy and periodogram"));
    EXPECT_THAT(refusal({number(0.1, 64), number(0.2, 64)}, "volume"), HasSubstr("no 'volume'"));
    EXPECT_THAT(refusal({measurement("periodogram", {}, "a")}), HasSubstr("nothing to draw"));
}

TEST(Chart, GapsSplitACurve) {
    const Chart chart{
        .title = "t",
        .panels = {
            {.x_name = "x",
             .y_name = "y",
             .series = {{.name = "a", .x = {1, 2, 3, 4, 5}, .y = {1, 2, std::nan(""), 3, 4}}}}}};
    int curves = 0;
    const Drawing drawing = draw_chart(chart, {});
    for (const Line* line : shapes_of<Line>(drawing))
        curves += !line->crisp && line->width > 1.5 ? 1 : 0;
    EXPECT_EQ(curves, 2);
}

// A curve of a million values is reduced to its visible points, including its extremes.
TEST(Chart, LongCurvesKeepTheirExtremes) {
    Series series{.name = {}, .x = {}, .y = {}};
    for (int i = 0; i < 1'000'000; ++i) {
        series.x.push_back(i);
        series.y.push_back(i == 123456 ? 5 : i % 2);
    }
    const Chart chart{.title = "t",
                      .panels = {{.x_name = "x", .y_name = "y", .series = {std::move(series)}}}};
    const Drawing drawing = draw_chart(chart, {});
    const Line* longest = shapes_of<Line>(drawing)[0];
    for (const Line* line : shapes_of<Line>(drawing))
        if (line->vertices.size() > longest->vertices.size()) longest = line;
    EXPECT_LT(longest->vertices.size(), 8000U);
    std::vector<double> heights;
    for (const Position& position : longest->vertices) heights.push_back(position.y);
    std::ranges::sort(heights);  // y decreases upward
    EXPECT_NEAR(heights.back() - heights[0], 5 * (heights.back() - heights[1]), 1e-6);
}

TEST(Chart, HistogramsIntegrateToOne) {
    const Bars bars = histogram_of(std::vector{0.0, 0.1, 0.25, 0.5, 0.999, 1.0}, 0, 1, 4);
    EXPECT_THAT(bars.edges, ElementsAre(0, 0.25, 0.5, 0.75, 1));
    EXPECT_THAT(bars.heights, ElementsAre(4 * 2 / 6.0, 4 * 1 / 6.0, 4 * 1 / 6.0, 4 * 2 / 6.0));
}

// A grid has equally many points in each bin, though 3 * 0.1 > 0.3.
TEST(Chart, ValuesOnEdgesAreInTheBinAbove) {
    std::vector<double> grid, powers;
    for (int i = 0; i < 100; ++i) grid.push_back(i / 100.0);
    for (const double height : histogram_of(grid, 0, 1, 10).heights) EXPECT_NEAR(height, 1, 1e-12);
    for (int i = -12; i < 12; ++i) powers.push_back(std::pow(10, i / 2.0));
    for (const double height : histogram_of(powers, 1e-6, 1e6, 24, true).heights)
        EXPECT_NEAR(height, 2 / (24 * std::log(10)), 1e-9);
    EXPECT_THAT(whole_histogram(std::vector{1.0, 2.0, 2.0}, 1, 2, 5, true).heights,
                ElementsAre(1 / (3 * std::log(3)), 2 / (3 * std::log(2.5 / 1.5))));
}

// ---------------------------------------------------------------- spectra

TEST(SpectrumPicture, IsGreyByShareWithTheLastRowOnTop) {
    Grid power{.rows = 3, .columns = 3, .values = {0, 1, 3, 1, 9, 1, 3, 1, 0}};
    const Drawing drawing = draw_spectrum(power, "t", "", {});
    const PixelImage& raster = *shapes_of<PixelImage>(drawing).at(0);
    EXPECT_EQ(raster.pixels[0].red, 191);  // 3 / 4 of 255, at the upper left
    EXPECT_EQ(raster.pixels[1].red, 128);
    EXPECT_EQ(raster.pixels[2].red, 0);
    EXPECT_EQ(raster.pixels[4].red, 0);  // frequency zero
    power.values[0] = -1;
    EXPECT_THROW(draw_spectrum(power, "t", "", {}), Error);
    power = {.rows = 2, .columns = 2, .values = {1, 1, 1, 1}};
    EXPECT_THROW(draw_spectrum(power, "t", "", {}), Error);
}
// A mark at an end of the axis is drawn completely, also on a linear axis.
TEST(ReportCharts, MarksAtTheEndsAreWithinTheFrame) {
    const std::vector<Measurement> ms = {number(0.3, 100), number(0.2, 1024), number(0.1, 2000)};
    for (const bool log : {false, true}) {
        PictureStyle style;
        style.log_x = log;
        const Chart chart = chart_of(ms);
        ASSERT_TRUE(chart.panels.at(0).series.at(0).marks);
        const Drawing drawing = draw_chart(chart, style);
        const auto disks = shapes_of<Disks>(drawing);
        const auto windows = shapes_of<ClipWindow>(drawing);
        ASSERT_FALSE(disks.empty());
        const Area& frame = windows.at(0)->area;
        for (const Position& position : disks[0]->centres) {
            EXPECT_GE(position.x - disks[0]->radius, frame.left) << log;
            EXPECT_LE(position.x + disks[0]->radius, frame.right()) << log;
        }
    }
}

namespace {

using Draw = std::function<Drawing(const PictureStyle&)>;

/// Pictures of every kind, with this text as title and as name of everything.
std::map<std::string, Draw> pictures_named(const std::string& name) {
    std::map<std::string, Draw> all;
    const auto points = [&](std::size_t d, std::size_t sets, bool pairs, std::size_t disks) {
        return [=](const PictureStyle& style) {
            PointSet set = make("random", {200, d});
            for (std::size_t k = 0; k < d; ++k) set.provenance.columns.push_back(name);
            return draw_points({.sets = std::vector<const PointSet*>(sets, &set),
                                .names = std::vector<std::string>(sets, name),
                                .title = name,
                                .subtitle = name,
                                .marking = disks > 0 ? Marking::automatic : Marking::density,
                                .pairs = pairs},
                               style, {});
        };
    };
    all["plane"] = points(2, 1, false, 1000);
    all["overlay"] = points(2, 3, false, 1000);
    all["density"] = points(2, 1, false, 0);
    all["space"] = points(3, 1, false, 1000);
    all["pairs"] = points(3, 2, true, 1000);
    all["five"] = points(5, 1, false, 1000);
    all["histogram"] = points(1, 2, false, 1000);
    for (const std::size_t panels : {1, 3})
        for (const bool bars : {false, true}) {
            Chart chart{.title = name, .subtitle = name, .own_x = bars};
            for (std::size_t i = 0; i < panels; ++i)
                chart.panels.push_back(
                    {.x_name = name,
                     .y_name = name,
                     .series = {{.name = name, .x = {1, 2}, .y = {3, 4}},
                                {.name = "b", .x = {1, 2}, .y = {4, 3}}},
                     .guides = {{.name = name, .y = {3}}},
                     .categories = bars ? std::vector{name, name} : std::vector<std::string>{}});
            all[fmt::format("chart {}{}", panels, bars)] = [=](const PictureStyle& style) {
                return draw_chart(chart, style);
            };
        }
    all["spectrum"] = [=](const PictureStyle& style) {
        const Grid power{.rows = 3, .columns = 3, .values = std::vector<double>(9, 1)};
        return draw_spectrum(power, name, name, style, {.x = name, .y = name});
    };
    all["local discrepancy"] = [=](const PictureStyle& style) {
        PointSet set = make("random", {20, 2});
        set.provenance.columns = {name, name};
        return draw_local_discrepancy(set, worst_boxes_of(set, {}),
                                      {.title = name, .subtitle = name, .largest = 0.3}, style, {});
    };
    all["pair table"] = [=](const PictureStyle& style) {
        return draw_pair_table({.title = name,
                                .subtitle = name,
                                .dimension = 9,
                                .values = std::vector<double>(36, 0.01)},
                               0.01, true, style);
    };
    return all;
}

/// Number of times that a text is drawn, joined from consecutive lines.
std::size_t times_drawn(const Drawing& drawing, std::string text) {
    std::string all;
    for (const Label* label : shapes_of<Label>(drawing)) all += label->text;
    std::erase(all, ' ');
    std::erase(text, ' ');
    std::size_t found = 0;
    for (auto at = all.find(text); at != std::string::npos; at = all.find(text, at + 1)) ++found;
    return found;
}

/// Draws the picture in the size that a refusal names: "...; at least 398 and 133 do".
void expect_size_suffices(const std::string& refusal, const Draw& draw) {
    const std::string sizes = refusal.substr(refusal.find("at least ") + 9);
    const double first = std::stod(sizes);
    const auto second = sizes.find(" and ");
    PictureStyle style{.width = first};
    if (second != std::string::npos)
        style.height = std::stod(sizes.substr(second + 5));
    else if (refusal.find("--height") != std::string::npos)
        std::swap(style.width, style.height);
    EXPECT_EQ(error_of([&] { fitted(style, draw); }), "") << refusal;
}

}  // namespace

// Pictures of all kinds with names of 5 to 60 letters, in all sizes: the requested size, or a
// refusal that names one that is drawn; each text whole, inside the picture, and not over another.
TEST(Chart, CutsNoTextOff) {
    for (const std::string& name :
         {std::string("width"),
          std::string("a very/long name of a set, as nobody would: 0123456789abcdef")})
        for (const auto& [kind, draw] : pictures_named(name)) {
            const std::size_t times = times_drawn(draw({.width = 2000}), name);
            for (const auto& [width, height] : {std::pair{0, 0},
                                                {1600, 0},
                                                {400, 0},
                                                {250, 0},
                                                {120, 0},
                                                {0, 200},
                                                {0, 800},
                                                {400, 300}}) {
                const auto where = fmt::format("{} {} x {}, {}", kind, width, height, name);
                PictureStyle style{.width = double(width), .height = double(height)};
                Drawing drawing;
                const std::string refusal =
                    error_of([&, &picture = draw] { drawing = fitted(style, picture); });
                if (!refusal.empty()) {
                    EXPECT_TRUE(width == 120 || height > 0) << where;
                    ASSERT_THAT(refusal, HasSubstr("no room for the picture; at least ")) << where;
                    expect_size_suffices(refusal, draw);
                    continue;
                }
                // Of two words below a narrow axis, both may end with an ellipsis.
                const std::size_t words = kind == "chart 1true" ? 2 : kind == "chart 3true" ? 6 : 0;
                EXPECT_LE(times_drawn(drawing, name), times) << where;
                EXPECT_GE(times_drawn(drawing, name) + (width == 120 || width == 250 ? words : 0),
                          times)
                    << where;
                EXPECT_GE(style.scale, 0.5) << where;
                const double wide = drawing.width * style.scale;
                const double high = drawing.height * style.scale;
                EXPECT_TRUE(width == 0 || std::abs(wide - width) < 0.01) << where << ": " << wide;
                EXPECT_TRUE(height == 0 || high <= height + 0.01) << where << ": " << high;
                for (const Label* label : shapes_of<Label>(drawing)) {
                    const Area room = room_of(*label);
                    EXPECT_TRUE(room.left >= 0 && room.right() <= drawing.width && room.top >= 0 &&
                                room.bottom() <= drawing.height)
                        << where << ": " << label->text;
                }
            }
        }
}

// DejaVu Sans is up to 18 % wider than Helvetica, and its bold letters up to 30 %.
TEST(Chart, TextsHaveRoomForWiderFonts) {
    Label label{.text = "halton", .at = {100, 50}, .size = 10, .anchor = Anchor::end};
    const double width = text_width("halton", 10);
    EXPECT_NEAR(room_of(label).left, 100 - 1.16 * width, 1e-9);
    EXPECT_NEAR(room_of(label).right(), 100, 1e-9);
    label.bold = label.upward = true;
    EXPECT_NEAR(room_of(label).top, 50, 1e-9);
    EXPECT_NEAR(room_of(label).height, 1.3 * width, 1e-9);
}

TEST(Chart, PanelsHaveLetters) {
    Chart chart{.title = "T"};
    const auto texts = [&](std::optional<std::size_t> letter) {
        std::string all;
        const Drawing drawing = draw_chart(chart, {.letter = letter});
        for (const Label* label : shapes_of<Label>(drawing))
            if (label->bold) all += label->text + "|";
        return all;
    };
    const ChartPanel panel{
        .x_name = "x", .y_name = "y", .series = {{.name = "s", .x = {1, 2}, .y = {1, 2}}}};
    chart.panels = {panel};
    EXPECT_EQ(texts(std::nullopt), "T|");
    EXPECT_EQ(texts(1), "(b) T|");
    chart.panels = {panel, panel};
    EXPECT_EQ(texts(std::nullopt), "T|");
    EXPECT_EQ(texts(2), "T|(c)|(d)|");
}

// The squares are at (i, j) with the numbers of the report, which has the pairs (1,2), (1,3), (2,3).
TEST(PairTable, HasASquareForEachPair) {
    Report projections;
    projections.add("value", Report::Curve{0.1, 0.4, 0.2});
    Report results;
    results.add("projections", std::move(projections));
    Measurement m = measurement("star-discrepancy", std::move(results), "a.csv");
    EXPECT_FALSE(pair_table(m));  // two coordinates have one pair
    m.dimension = 3;
    const auto table = pair_table(m);
    ASSERT_TRUE(table);
    EXPECT_EQ(table->subtitle, "n = 64, d = 3 · largest 0.4, of 1 and 3");
    EXPECT_EQ(table->largest(), 0.4);
    const Drawing drawing = draw_pair_table(*table, 0.4, true, {});
    const auto images = shapes_of<PixelImage>(drawing);
    ASSERT_EQ(images.size(), 2U);  // the other one is the bar
    const Colour white = light_theme.background;
    const std::vector<Colour> expected = {light_theme.ink, shade_of(light_theme, 0.5),
                                          shade_of(light_theme, 0.25), white};
    EXPECT_EQ(images[0]->pixels, expected);  // (1,3) (2,3); (1,2) and none
    const Area& area = images[0]->area;
    std::map<std::string, Position> numbers;
    for (const Label* label : shapes_of<Label>(drawing))
        if (label->size == 11) numbers[label->text] = label->at;
    ASSERT_EQ(numbers.size(), 3U);
    EXPECT_NEAR(numbers.at("0.2").x, area.left + 0.75 * area.width, 1);
    EXPECT_NEAR(numbers.at("0.2").y, area.top + 0.25 * area.height, 6);
    EXPECT_LT(numbers.at("0.1").x, area.left + 0.5 * area.width);
    EXPECT_GT(numbers.at("0.1").y, area.top + 0.5 * area.height);
}

// Thirty coordinates: 435 numbers that are legible and do not touch each other.
TEST(PairTable, IsLegibleForThirtyCoordinates) {
    PairTable table{.title = "T", .dimension = 30};
    for (int k = 0; k < 435; ++k) table.values.push_back(0.05 + 0.0005 * k);
    PictureStyle style;
    const Drawing drawing = fitted(
        style, [&](const PictureStyle& s) { return draw_pair_table(table, 0.2675, true, s); });
    std::size_t numbers = 0;
    for (const Label* label : shapes_of<Label>(drawing)) {
        EXPECT_GE(label->size, 7);
        numbers += label->size < 11 ? 1 : 0;
    }
    EXPECT_EQ(numbers, 435U);
    EXPECT_THAT(svg_bytes(drawing, 1), HasSubstr("numbers ×10⁻²"));
}

}  // namespace stipple::testing::chart_test
