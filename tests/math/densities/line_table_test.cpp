// SPDX-License-Identifier: MIT
#include "math/densities/line_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"
#include "support/units.hpp"

namespace stipple::testing::line_table_test {
namespace {

template <class F>
std::vector<LinePiece> tabulated(const F& f, const LineRange& range = {}, double tolerance = 1e-6) {
    return tabulate_line("f",
                         [&](std::span<const double> at, std::span<double> values) {
                             for (std::size_t i = 0; i < at.size(); ++i) values[i] = f(at[i]);
                         },
                         range, tolerance, {});
}

double table_at(const std::vector<LinePiece>& pieces, double x) {
    for (const LinePiece& p : pieces)
        if (x >= p.x_low && x < p.x_high)
            return p.f_low + (p.f_high - p.f_low) * (x - p.x_low) / (p.x_high - p.x_low);
    return 0;
}

}  // namespace

// Density 2 x on [0, 1]: u = x^2. Density 2 - 2 x: u = 1 - (1 - x)^2. Then two pieces by hand.
TEST(LineTable, InvertsLinearPieces) {
    const LineTable rising({{0, 1, 0, 5, {}}});
    const LineTable falling({{0, 1, 2, 0, {}}});
    for (const double u : {0.0, 1e-300, 1e-20, 0.25, 0.5, 0.81, one_minus_ulp}) {
        EXPECT_DOUBLE_EQ(rising.quantile(u), std::sqrt(u)) << u;
        EXPECT_NEAR(falling.quantile(u), 1 - std::sqrt(1 - u), 2e-16) << u;
        EXPECT_NEAR(rising.fraction(rising.quantile(u)), u, 3e-16);
    }
    const LineTable steps({{0, 1, 1, 1, {}}, {1, 2, 0, 0, {}}, {2, 3, 3, 3, {}}});
    EXPECT_EQ(steps.quantile(0.125), 0.5);
    EXPECT_EQ(steps.quantile(0.25), 2);
    EXPECT_EQ(steps.quantile(0.625), 2.5);
    EXPECT_LT(steps.quantile(1), 3);
    EXPECT_EQ(steps.fraction(1.5), 0.25);
    EXPECT_EQ(steps.fraction(3), 1);
    EXPECT_EQ(LineTable({{0, 1, 1e-300, 1e-300, {}}}).quantile(0.25), 0.25);
}

// The tolerance bounds the area between the curves, also across a jump and next to a root.
TEST(TabulateLine, StaysWithinItsTolerance) {
    const std::vector<std::function<double(double)>> functions = {
        [](double x) { return std::exp(-20 * (x - 0.3) * (x - 0.3)); },
        [](double x) { return std::sqrt(x); }, [](double x) { return x < 0.3 ? 1 : 2.5; },
        [](double x) { return std::abs(x - 0.7); }};
    for (const double tolerance : {1e-3, 1e-6})
        for (std::size_t k = 0; k < functions.size(); ++k) {
            const auto pieces = tabulated(functions[k], {}, tolerance);
            double area = 0;
            double mass = 0;
            for (const LinePiece& p : pieces)
                for (int i = 0; i < 16; ++i) {
                    const double width = (p.x_high - p.x_low) / 16;
                    const double x = p.x_low + (i + 0.5) * width;
                    area += width * std::abs(functions[k](x) -
                                             (p.f_low + (p.f_high - p.f_low) * (i + 0.5) / 16));
                    mass += width * functions[k](x);
                }
            EXPECT_LT(area, tolerance * mass) << k;
            EXPECT_LT(pieces.size(), 100 + 3 / std::sqrt(tolerance)) << k;
        }
}

// Bumps of 6/100 000 of the range, between the samples of the first pieces: their fraction of the
// mass is 2 h / (2 h + 0.001 (1 - 2 h)).
TEST(TabulateLine, SeesWhatIsNarrow) {
    Rng rng(3);
    for (std::uint64_t i = 0; i < 40; ++i) {
        constexpr double half = 3e-5;
        const double center = 0.01 + 0.98 * rng.uniform(i);
        const LineTable table(
            tabulated([&](double x) { return std::abs(x - center) < half ? 1 : 0.001; }));
        const double mass = table.fraction(center + half) - table.fraction(center - half);
        EXPECT_NEAR(mass, 2 * half / (2 * half + 0.001 * (1 - 2 * half)), 2e-6) << center;
    }
}

TEST(TabulateLine, TakesAJumpAtABreakExactly) {
    const auto pieces = tabulated([](double x) { return x < 0.3 ? 1 : 3; }, {0, 1, {0.3}}, 1e-12);
    EXPECT_EQ(pieces.size(), 2 * 97U);
    EXPECT_EQ(table_at(pieces, std::nextafter(0.3, 0)), 1);
    EXPECT_EQ(table_at(pieces, 0.3), 3);
}

TEST(TabulateLine, PutsNoMassBeyondAJumpToZero) {
    for (const double edge : {0.3, 1 / 3.0, 0.987654321}) {
        const LineTable table(tabulated([&](double x) { return x < edge ? 1 : 0; }, {}, 1e-6));
        for (std::uint64_t i = 0; i < 1000; ++i) EXPECT_LT(table.quantile(Rng(1).uniform(i)), edge);
        EXPECT_LT(table.quantile(one_minus_ulp), edge);
        EXPECT_GT(table.quantile(one_minus_ulp), edge - 1e-5);
    }
}

// A piece that is 0 at its end and just beyond, but linear at its samples, shows no bend.
TEST(TabulateLine, CountsAGapNextToAnEndAsAnError) {
    for (const double edge : {50 / 97.0 + 1e-7, 96 / 97.0 + 1e-6}) {
        const LineTable table(
            tabulated([&](double x) { return std::max(0.0, x - edge); }, {}, 1e-5));
        for (const double u : {0.01, 0.1, 0.5, 0.9}) {
            const double share = (table.quantile(u) - edge) / (1 - edge);
            EXPECT_NEAR(share * share, u, 2e-5) << edge;
        }
    }
}

TEST(TabulateLine, KeepsPiecesThatTouchZero) {
    const auto pieces = tabulated([](double x) { return x; });
    EXPECT_EQ(pieces.front().f_low, 0);
    EXPECT_GT(pieces.front().f_high, 0);
}

TEST(TabulateLine, RefusesWhatIsNoDensityAndSaysWhere) {
    const auto refused = [](const std::function<double(double)>& f) {
        return error_of([&] { tabulated(f); });
    };
    EXPECT_EQ(refused([](double x) { return 1 / x; }),
              "usage: f is inf at x = 0; a density must be finite and not below 0");
    EXPECT_EQ(refused([](double x) { return std::sqrt(x - 1) + 1; }).substr(0, 20),
              "usage: f is nan at x");
    EXPECT_EQ(refused([](double x) { return x - 1; }),
              "usage: f is -1 at x = 0; a density must be finite and not below 0");
    EXPECT_EQ(refused([](double) { return 0; }), "usage: f is 0 at all points tried from 0 to 1");
    EXPECT_NE(refused([](double x) { return 1 / std::abs(x - 1 / 3.0); }).find("0.333333333"),
              std::string::npos);
}

}  // namespace stipple::testing::line_table_test
