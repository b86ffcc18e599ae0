// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "analyzers/sensitivity/models.hpp"

namespace stipple::testing::polynomial_chaos_test {

using namespace sensitivity;

namespace {

const Settings by_chaos = {{"method", "chaos"}};

Report chaos(const PointSet& table, Settings settings = {}) {
    settings.emplace_back("method", "chaos");
    return analyze("sensitivity", table, settings);
}

}  // namespace

// 1 + 3 P_1(x) + 2 P_2(y) + P_1(x) P_1(z): shares 9, 4 and 1 of 14, from any sample.
TEST(PolynomialChaos, OfAPolynomialIsExact) {
    const Model model = [](auto u) {
        const auto p1 = [](double v) { return std::sqrt(3) * (2 * v - 1); };
        const auto p2 = [](double v) { return std::sqrt(5) * (6 * v * v - 6 * v + 1); };
        return 1 + 3 * p1(u[0]) + 2 * p2(u[1]) + p1(u[0]) * p1(u[2]);
    };
    const Report report = chaos(with_outputs(points_in(make("random", points(60, 3))), model));
    EXPECT_NEAR(report.number("x4.x1.first"), 9. / 14, 1e-12);
    EXPECT_NEAR(report.number("x4.x2.first"), 4. / 14, 1e-12);
    EXPECT_NEAR(report.number("x4.x3.first"), 0, 1e-12);
    EXPECT_NEAR(report.number("x4.x1.total"), 10. / 14, 1e-12);
    EXPECT_NEAR(report.number("x4.x3.total"), 1. / 14, 1e-12);
    EXPECT_NEAR(report.number("x4.x1:x3.second"), 1. / 14, 1e-12);
    EXPECT_EQ(report.find("x4.x1:x2"), nullptr);
    EXPECT_NEAR(report.number("x4.q2"), 1, 1e-12);
    EXPECT_EQ(report.number("x4.terms"), 3);
    EXPECT_EQ(report.number("x4.degree"), 2);
}

TEST(PolynomialChaos, FindsKnownIndicesOfModerateSamples) {
    const Report ish = chaos(with_outputs(points_in(make("sobol", points(512, 3))), ishigami));
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string key = "x4.x" + std::to_string(i + 1);
        EXPECT_NEAR(ish.number(key + ".first"), ishigami_first[i], 0.002);
        EXPECT_NEAR(ish.number(key + ".total"), ishigami_total[i], 0.002);
    }
    EXPECT_NEAR(ish.number("x4.x1:x3.second"), ishigami_total[2], 0.002);
    EXPECT_GT(ish.number("x4.q2"), 0.999);
    // Its kinks are no polynomials.
    const Report g = chaos(with_outputs(points_in(make("sobol", points(1024, 4))), g_function));
    for (std::size_t i = 0; i < 4; ++i) {
        const std::string key = "x5.x" + std::to_string(i + 1);
        EXPECT_NEAR(g.number(key + ".first"), g_first(i), 0.02);
        EXPECT_NEAR(g.number(key + ".total"), g_total(i), 0.02);
    }
    EXPECT_GT(g.number("x5.q2"), 0.95);
}

namespace {

/// A least squares line through rows (x, y) but row `without`.
std::pair<double, double> line_without(const Rows& rows, std::size_t without) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i == without) continue;
        n += 1;
        x += rows[i][0];
        y += rows[i][1];
        xx += rows[i][0] * rows[i][0];
        xy += rows[i][0] * rows[i][1];
    }
    const double slope = (n * xy - x * y) / (n * xx - x * x);
    return {(y - slope * x) / n, slope};
}

}  // namespace

// Oracle: the line fitted anew without each run. The correction is n / (n - 2) (1 + trace G^-1), where
// the Gram matrix G of 1 and P_1 is written out.
TEST(PolynomialChaos, Q2IsTheCorrectedLeaveOneOutError) {
    const Rng rng(11);
    Rows rows;
    for (std::size_t i = 0; i < 25; ++i) {
        const double x = rng.uniform(2 * i);
        rows.push_back({x, x + 0.7 * rng.uniform(2 * i + 1)});
    }
    double errors = 0;
    double mean = 0;
    double sum = 0;
    double squares = 0;
    for (std::size_t i = 0; i < 25; ++i) {
        const auto [intercept, slope] = line_without(rows, i);
        errors += std::pow(rows[i][1] - intercept - slope * rows[i][0], 2);
        mean += rows[i][1] / 25;
        const double p = std::sqrt(3) * (2 * rows[i][0] - 1);
        sum += p;
        squares += p * p;
    }
    double variance = 0;
    for (const auto& row : rows) variance += std::pow(row[1] - mean, 2);
    const double trace = (25 + squares) / (25 * squares - sum * sum);
    const Report report = chaos(points_of(rows), {{"degree", "1"}});
    EXPECT_NEAR(report.number("y.q2"), 1 - errors / variance * 25 / 23 * (1 + trace), 1e-12);
}

// Oracle: the two coefficients fitted anew without each run, by normal equations.
TEST(PolynomialChaos, IntervalsAreTheJackknifes) {
    const Rng rng(12);
    const std::size_t n = 30;
    Rows rows;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = rng.uniform(3 * i);
        const double y = rng.uniform(3 * i + 1);
        rows.push_back({x, y, 2 * x + y + 0.3 * rng.uniform(3 * i + 2)});
    }
    const auto share_without = [&](std::size_t without) {
        double m[3][4] = {};
        for (std::size_t i = 0; i < n; ++i) {
            if (i == without) continue;
            const double v[4] = {1, rows[i][0], rows[i][1], rows[i][2]};
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 4; ++b) m[a][b] += v[a] * v[b];
        }
        for (int a = 0; a < 3; ++a)
            for (int r = 0; r < 3; ++r) {
                if (r == a) continue;
                const double factor = m[r][a] / m[a][a];
                for (int b = 0; b < 4; ++b) m[r][b] -= factor * m[a][b];
            }
        const double cx = m[1][3] / m[1][1];
        const double cy = m[2][3] / m[2][2];
        return cx * cx / (cx * cx + cy * cy);
    };
    double mean = 0;
    for (std::size_t i = 0; i < n; ++i) mean += share_without(i) / n;
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += std::pow(share_without(i) - mean, 2);
    const double error = std::sqrt(sum * (n - 1) / n);
    const Report report = chaos(points_of(rows), {{"degree", "1"}, {"level", "0.9"}});
    EXPECT_NEAR(report.number("z.x.first"), share_without(n), 1e-12);
    EXPECT_NEAR(report.number("z.x.first_high"), share_without(n) + 1.6448536269514722 * error,
                1e-10);
    EXPECT_NEAR(report.number("z.x.first_low"), share_without(n) - 1.6448536269514722 * error,
                1e-10);
}

// Inputs of any distribution are ranked; those of the box that a file tells are scaled.
TEST(PolynomialChaos, RanksInputsOfUnknownDistributions) {
    Rows rows = points_in(make("sobol", points(512, 3)));
    PointSet plain = with_outputs(rows, ishigami);
    const Report uniform = chaos(plain);
    EXPECT_EQ(uniform.text("x4.scale"), "cube");
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < 3; ++j) plain[i][j] = std::exp(5 * rows[i][j]);
    const Report ranked = chaos(plain);
    EXPECT_EQ(ranked.text("x4.scale"), "ranks");
    for (const char* key : {"x4.x1.first", "x4.x2.total", "x4.x3.total"})
        EXPECT_NEAR(ranked.number(key), uniform.number(key), 0.01) << key;
    // Numbers in [0, 1] need not be uniform there.
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < 3; ++j) plain[i][j] = 0.3 + 0.5 * rows[i][j];
    EXPECT_EQ(chaos(plain).text("x4.scale"), "ranks");
    EXPECT_EQ(chaos(plain).number("x4.x1.first"), ranked.number("x4.x1.first"));
}

TEST(PolynomialChaos, LeavesOutFailedRunsAndIsTheSameForAnyNumberOfThreads) {
    const auto rows = points_in(make("random", points(200, 3)));
    PointSet some = with_outputs(rows, ishigami);
    some[7][3] = std::nan("");
    Rows kept = rows;
    kept.erase(kept.begin() + 7);
    const Report report = chaos(some);
    EXPECT_EQ(report.number("x4.x1.first"),
              chaos(with_outputs(kept, ishigami)).number("x4.x1.first"));
    EXPECT_EQ(report, analyze("sensitivity", some, by_chaos, RunContext{.threads = 3}));
}

TEST(PolynomialChaos, SaysWhereNoPolynomialHelps) {
    Rows rows;
    for (std::size_t i = 0; i < 40; ++i)
        rows.push_back({static_cast<double>(i) / 40, i % 2 == 0 ? -1. : 1.});
    EXPECT_EQ(error_of([&] { chaos(points_of(rows)); }),
              "input: no polynomial predicts the output y better than its mean | --method rank "
              "needs no polynomial");
}

}  // namespace stipple::testing::polynomial_chaos_test
