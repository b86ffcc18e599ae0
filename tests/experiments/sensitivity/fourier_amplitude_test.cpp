// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "experiments/sensitivity/models.hpp"

namespace stipple::testing::fourier_amplitude_test {

using namespace sensitivity;

namespace {

constexpr const char* unit = "sensitivity";

/// Oracle: |1/n sum y exp(-2 pi i f s / n)|^2.
double power(const std::vector<double>& y, std::size_t f) {
    std::complex<double> sum;
    const auto n = static_cast<double>(y.size());
    for (std::size_t s = 0; s < y.size(); ++s)
        sum += y[s] * std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(f * s) / n);
    return std::norm(sum / n);
}

}  // namespace

TEST(FourierAmplitude, IsWhatTheFormulasSay) {
    for (const std::size_t n : {97, 128}) {
        const Rows rows = fast_rows(n, 3, 7);
        const Report report = analyze(unit, with_outputs(rows, ishigami));
        ASSERT_EQ(report.text("x4.method"), "fast");
        const std::size_t w = (n - 1) / 8;
        for (std::size_t i = 0; i < 3; ++i) {
            std::vector<double> y;
            for (std::size_t s = 0; s < n; ++s) y.push_back(ishigami(rows[i * n + s]));
            double all = 0;
            double own = 0;
            double others = 0;
            for (std::size_t f = 1; f <= (n - 1) / 2; ++f) all += power(y, f);
            for (std::size_t p = 1; p <= 4; ++p) own += power(y, p * w);
            for (std::size_t f = 1; f <= w / 2; ++f) others += power(y, f);
            const std::string key = "x4.x" + std::to_string(i + 1);
            EXPECT_NEAR(report.number(key + ".first"), own / all, 1e-12) << n;
            EXPECT_NEAR(report.number(key + ".total"), 1 - others / all, 1e-12) << n;
        }
    }
}

// Totals have larger errors: harmonics of other inputs above w / 2 count as the curve's own.
TEST(FourierAmplitude, FindsIshigamisIndices) {
    const Report report = analyze(unit, with_outputs(fast_rows(4096, 3, 1), ishigami));
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string key = "x4.x" + std::to_string(i + 1);
        EXPECT_NEAR(report.number(key + ".first"), ishigami_first[i], 0.01);
        EXPECT_NEAR(report.number(key + ".total"), ishigami_total[i], 0.025);
    }
    EXPECT_EQ(report.number("x4.samples"), 4096);
    EXPECT_EQ(report.find("x4.x1.first_low"), nullptr);
}

TEST(FourierAmplitude, FindsTheIndicesOfTheGFunctionAndOfALinearModel) {
    const Report g = analyze(unit, with_outputs(fast_rows(4097, 4, 2), g_function));
    for (std::size_t i = 0; i < 4; ++i) {
        const std::string key = "x5.x" + std::to_string(i + 1);
        EXPECT_NEAR(g.number(key + ".first"), g_first(i), 0.02);
        EXPECT_NEAR(g.number(key + ".total"), g_total(i), 0.03);
    }
    // Four harmonics have 0.998 of the variance of a triangle wave, which is a linear input along
    // the curve.
    const Report sum = analyze(unit, with_outputs(fast_rows(1025, 3, 3), linear));
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string key = "x4.x" + std::to_string(i + 1);
        EXPECT_NEAR(sum.number(key + ".first"), std::pow(3. - static_cast<double>(i), 2) / 14,
                    0.005);
        EXPECT_NEAR(sum.number(key + ".total"), std::pow(3. - static_cast<double>(i), 2) / 14,
                    0.02);
    }
}

// The curves' frequency determines M, for any distribution of the inputs: with four harmonics
// instead of two, those above w / 2 would count.
TEST(FourierAmplitude, TakesTheDesignsOwnHarmonics) {
    for (const char* m : {"1", "2", "3", "5"}) {
        PointSet design = make("fast", points(771, 3), {{"harmonics", m}});
        Rows rows = points_in(design);
        const PointSet plain = with_outputs(rows, linear);
        for (auto& row : rows) row = {std::exp(9 * row[0]), -1 / (0.01 + row[1]), row[2]};
        PointSet warped = with_outputs(rows, linear);
        for (std::size_t i = 0; i < rows.size(); ++i) warped[i][3] = plain[i][3];
        const Report report = analyze(unit, warped);
        ASSERT_EQ(report.text("x4.method"), "fast") << m;
        EXPECT_EQ(report.number("x4.x1.first"),
                  measure(unit, "x4.x1.first", plain, {{"method", "fast"}, {"harmonics", m}}));
        EXPECT_NEAR(report.number("x4.x1.first"), 9. / 14, 0.2) << m;
    }
}

TEST(FourierAmplitude, RefusesFailedRunsAndOtherHarmonics) {
    PointSet table = with_outputs(fast_rows(257, 3, 1), ishigami);
    EXPECT_NE(error_of([&] {
                  analyze(unit, table, {{"method", "fast"}, {"harmonics", "6"}});
              }).find("on curve 1, coordinate 1 oscillates as for 4 harmonics, not 6"),
              std::string::npos);
    table[17][3] = std::nan("");
    EXPECT_EQ(error_of([&] { analyze(unit, table); }),
              "input: the output x4 has 1 failed runs; a curve with gaps has no spectrum: repeat "
              "these runs, or use --method rank or chaos");
    EXPECT_EQ(error_of([&] { analyze(unit, table, {{"method", "rank"}}); }), "");
}

// The total of an input was 1 if its curve had the same output everywhere, not 0, in float64.
TEST(FourierAmplitude, ConstantCurvesHaveNoIndices) {
    const Rows rows = fast_rows(97, 2, 7);
    PointSet table = with_outputs(rows, [](auto) { return 0.1; });
    for (std::size_t s = 97; s < 194; ++s) table[s][2] = rows[s][1];
    const Report report = analyze(unit, table);
    EXPECT_EQ(report.text("z.x.missing"), "the output is constant on the input's curve");
    EXPECT_EQ(report.find("z.x.total"), nullptr);
    EXPECT_NEAR(report.number("z.y.first"), 1, 0.01);
}

}  // namespace stipple::testing::fourier_amplitude_test
