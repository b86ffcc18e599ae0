// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "support/units.hpp"

namespace stipple::testing::differential_test {
namespace {

constexpr const char* unit = "differential";

Report report(const PointSet& set, const Settings& settings = {}) {
    return analyze(unit, set, settings);
}

const Grid& grid_of(const Report& report) { return std::get<Grid>(*report.find("grid")); }

PointSet in_box(const char* generator, std::size_t n, const Box& box) {
    PointSet set = make(generator, points(n, 2));
    scale_into(box, set.flat());
    set.domain = box_domain(box);
    return set;
}

/// Probability that the difference of two numbers in [0, 1] is in [a, b], by summation.
double straight_chance(double a, double b) {
    double sum = 0;
    for (int i = 0; i < 1000; ++i)
        sum += (1 - std::abs(a + (b - a) * (i + 0.5) / 1000)) * (b - a) / 1000;
    return sum;
}

}  // namespace

TEST(Differential, ImageIsThatOfAllPairs) {
    const Box box{{-1, 2}, {1, 3.5}};
    PointSet set = in_box("random", 300, box);
    std::ranges::copy(set[3], set[5].begin());
    set[7][0] = -1;
    set[8][1] = 3.5;
    for (const bool torus : {true, false}) {
        const Report found = report(
            set,
            {{"pixels", "21"}, {"max-distance", "4"}, {"metric", torus ? "torus" : "euclidean"}});
        const double unit_length = std::sqrt(3. / 300);
        EXPECT_NEAR(found.number("mean_distance"), unit_length, 1e-15);
        const double pixel = 8 * unit_length / 21;
        std::vector<double> counts(441);
        for (std::size_t i = 0; i < 300; ++i)
            for (std::size_t j = 0; j < 300; ++j) {
                double x = set[j][0] - set[i][0];
                double y = set[j][1] - set[i][1];
                if (torus) {
                    x -= 2 * std::round(x / 2);
                    y -= 1.5 * std::round(y / 1.5);
                }
                const double column = std::floor(x / pixel + 10.5);
                const double row = std::floor(y / pixel + 10.5);
                if (i == j || column < 0 || column > 20 || row < 0 || row > 20) continue;
                ++counts[static_cast<std::size_t>(21 * row + column)];
            }
        const Grid& grid = grid_of(found);
        ASSERT_EQ(grid.values.size(), 441U);
        for (std::size_t k = 0; k < 441; ++k) {
            const auto x = static_cast<double>(k % 21) - 10;
            const auto y = static_cast<double>(k / 21) - 10;
            double chance = pixel * pixel / 3;
            if (!torus)
                chance = straight_chance((x - 0.5) * pixel / 2, (x + 0.5) * pixel / 2) *
                         straight_chance((y - 0.5) * pixel / 1.5, (y + 0.5) * pixel / 1.5);
            const double tolerance = torus || (k % 21 != 10 && k / 21 != 10) ? 1e-9 : 1e-4;
            EXPECT_NEAR(grid.values[k], counts[k] / (300. * 299 * chance),
                        tolerance * (1 + grid.values[k]))
                << torus << k;
            EXPECT_EQ(grid.values[k], grid.values[440 - k]);
        }
    }
}

// 32 x 32 points: one in five pixels along each axis has differences, the same for all points.
TEST(Differential, LatticesAreTheirOwnImages) {
    const Report found =
        report(make("regular", points(1024, 2)), {{"pixels", "45"}, {"max-distance", "4.5"}});
    EXPECT_NEAR(found.number("pixel"), 0.2, 1e-12);
    const Grid& grid = grid_of(found);
    for (std::size_t k = 0; k < grid.values.size(); ++k) {
        const bool peak = k % 45 % 5 == 2 && k / 45 % 5 == 2 && k != 45 * 22 + 22;
        EXPECT_NEAR(grid.values[k], peak ? 25 * 1024. / 1023 : 0, 1e-9) << k;
    }
    EXPECT_NEAR(found.curve("radial.density")[5],
                4 * 25 * 1024. / 1023 /
                    static_cast<double>(std::get<Report::Integers>(*found.find("radial.cells"))[5]),
                1e-9);
}

// The mean over 65024 pixels with 0.4 pairs on average has a standard deviation of 0.01, the
// anisotropy of rings at most 0.3 dB; bounds are 5 of these.
TEST(Differential, IndependentPointsHaveOneEverywhere) {
    for (const char* metric : {"torus", "euclidean"}) {
        const Report found =
            report(make("random", points(20'000, 2)), {{"metric", metric}, {"pixels", "101"}});
        double sum = 0;
        for (const double value : grid_of(found).values) sum += value / 10201;
        EXPECT_NEAR(sum, 1, 0.01) << metric;
        const double expected = -10 * std::log10(found.number("expected_differences"));
        for (std::size_t k = 20; k < 51; ++k) {
            EXPECT_NEAR(found.curve("radial.density")[k], 1, 0.04) << metric << k;
            EXPECT_NEAR(found.curve("radial.anisotropy_db")[k], expected, 2.5) << metric << k;
        }
    }
    const Report even = report(make("poisson-disk", points(2000, 2)));
    EXPECT_EQ(even.curve("radial.density")[10], 0);
    EXPECT_EQ(even.curve("radial.anisotropy_db")[10], -100);
    double worst = 0;
    for (std::size_t k = 20; k < 50; ++k)
        worst = std::max(worst, std::abs(even.curve("radial.density")[k] - 1));
    EXPECT_GT(worst, 0.2);
}

TEST(Differential, AverageHasTheAnisotropyOfTheMeanImage) {
    const Analyzer& analyzer = find_analyzer(unit);
    const PointSet set = make("random", points(500, 2));
    Report mean = report(set);
    for (double& x : std::get_if<Grid>(mean.find("grid"))->values) x = 2 * x + 2;
    analyzer.refine(mean, 2, analyzer.options.defaults());
    EXPECT_NEAR(mean.curve("radial.density")[50], 2 * report(set).curve("radial.density")[50] + 2,
                1e-12);
    EXPECT_LT(mean.curve("radial.anisotropy_db")[50],
              report(set).curve("radial.anisotropy_db")[50]);
}

TEST(Differential, RefusesWhatHasNoImage) {
    const auto refusal = [](const PointSet& set, const Settings& settings = {}) {
        return error_of([&] { report(set, settings); });
    };
    const PointSet set = make("random", points(100, 2));
    EXPECT_EQ(refusal(points_of({{0.5, 0.5}})),
              "input: differential needs at least two points; this is one");
    EXPECT_EQ(refusal(points_of({{0.5, 0.5}, {0.5, 0.5}})),
              "input: differential needs points at two or more places; all 2 are at one");
    EXPECT_EQ(refusal(make("random", points(10, 3))),
              "input: differential requires points of dimension 2; these have 3");
    EXPECT_EQ(
        refusal(set, {{"pixels", "100"}}),
        "usage: --pixels: 100 is even; expected an odd number, so that one pixel is in the middle");
    EXPECT_EQ(refusal(set, {{"max-distance", "6"}}),
              "usage: --max-distance: 6 is more than half the shortest side, 5");
}

}  // namespace stipple::testing::differential_test
