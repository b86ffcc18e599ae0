// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/sensitivity/models.hpp"
#include "support/temporary_file.hpp"

namespace stipple::testing::polynomial_chaos_test {

using namespace sensitivity;

namespace {

const Settings by_chaos = {{"method", "chaos"}};

Report chaos(const PointSet& table, Settings settings = {}) {
    settings.emplace_back("method", "chaos");
    return analyze("sensitivity", table, settings);
}

}  // namespace

// 3 x + 2 (3/sqrt(2)) (y^2 - 2/3) + x z on {-1, 1} x {-1, 0, 1} x {-1, 1}, five times: orthonormal
// terms, with 9, 4 and 1 fourteenths of the variance.
TEST(PolynomialChaos, OfAPolynomialIsExact) {
    Rows rows;
    for (int time = 0; time < 5; ++time)
        for (const double x : {-1, 1})
            for (const double y : {-1, 0, 1})
                for (const double z : {-1, 1}) rows.push_back({x, y, z});
    const Report report = chaos(with_outputs(rows, [](auto u) {
        return 1 + 3 * u[0] + 2 * (3 * u[1] * u[1] - 2) / std::sqrt(2) + u[0] * u[2];
    }));
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

// In [0, 1], if the sample's mean and variance are those of uniform inputs, so are the indices: 1 +
// 3 P_1(x) + 2 P_2(y) + P_1(x) P_1(z) has 9, 4 and 1 fourteenths of the variance, for any sample.
// Intervals are wide, because the inputs may not be uniform, unless the provenance says so.
TEST(PolynomialChaos, OfUniformInputsIsExactFromAnySample) {
    const Model model = [](auto u) {
        const auto p1 = [](double v) { return std::sqrt(3) * (2 * v - 1); };
        const auto p2 = [](double v) { return std::sqrt(5) * (6 * v * v - 6 * v + 1); };
        return 1 + 3 * p1(u[0]) + 2 * p2(u[1]) + p1(u[0]) * p1(u[2]);
    };
    const PointSet sample = make("random", points(60, 3));
    const Report report = chaos(with_outputs(points_in(sample), model));
    EXPECT_EQ(report.text("x4.scale"), "cube");
    EXPECT_NEAR(report.number("x4.x1.first"), 9. / 14, 1e-12);
    EXPECT_NEAR(report.number("x4.x2.first"), 4. / 14, 1e-12);
    EXPECT_NEAR(report.number("x4.x3.total"), 1. / 14, 1e-12);
    EXPECT_GT(report.number("x4.x1.first_high") - report.number("x4.x1.first_low"), 0.1);
    std::string text = "# tool: \"stipple\"\n# domain: \"box:bounds=[0..1,0..1,0..1]\"\n";
    PointSet outputs(60, 1);
    for (std::size_t i = 0; i < 60; ++i) {
        text += fmt::format("{},{},{}\n", sample[i][0], sample[i][1], sample[i][2]);
        outputs[i][0] = model(sample[i]);
    }
    const TemporaryFile design(text, ".csv");
    const Report told =
        analyze("sensitivity", outputs, {{"design", design.path()}, {"method", "chaos"}});
    EXPECT_NEAR(told.number("y.x.first"), 9. / 14, 1e-12);
    EXPECT_LT(told.number("y.x.first_high") - told.number("y.x.first_low"), 1e-12);
}

// Variances of the terms of a sum, each over the sample's values of its input.
TEST(PolynomialChaos, TakesEachInputsOwnDistribution) {
    const auto variance = [](const std::vector<double>& values) {
        double mean = 0;
        double square = 0;
        for (const double v : values) {
            mean += v / static_cast<double>(values.size());
            square += v * v / static_cast<double>(values.size());
        }
        return square - mean * mean;
    };
    Rows rows = points_in(make("random", points(80, 3)));
    std::vector<std::vector<double>> parts(3);
    for (auto& row : rows) {
        row = {std::floor(2 * row[0]), std::floor(4 * row[1] * row[1]), std::exp(2 * row[2])};
        parts[0].push_back(row[0]);
        parts[1].push_back(row[1] * row[1] / 2);
        parts[2].push_back(row[2] / 5);
    }
    const Report report =
        chaos(with_outputs(rows, [](auto u) { return u[0] + u[1] * u[1] / 2 + u[2] / 5; }));
    EXPECT_EQ(report.text("x4.scale"), "values");
    const double all = variance(parts[0]) + variance(parts[1]) + variance(parts[2]);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(report.number("x4.x" + std::to_string(i + 1) + ".first"),
                    variance(parts[i]) / all, 1e-10);
    // m in {0, 1}, x uniform: each has half of the variance of m + sqrt(3) x.
    Rows two = points_in(make("sobol", points(1024, 2)));
    for (auto& row : two) row[0] = std::floor(2 * row[0]);
    EXPECT_NEAR(chaos(with_outputs(two, [](auto u) { return u[0] + std::sqrt(3) * u[1]; }))
                    .number("z.x.first"),
                0.5, 1e-6);
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
    // Functions with kinks are not polynomials.
    const Report g = chaos(with_outputs(points_in(make("sobol", points(1024, 4))), g_function));
    for (std::size_t i = 0; i < 4; ++i) {
        const std::string key = "x5.x" + std::to_string(i + 1);
        EXPECT_NEAR(g.number(key + ".first"), g_first(i), 0.02);
        EXPECT_NEAR(g.number(key + ".total"), g_total(i), 0.02);
    }
    EXPECT_GT(g.number("x5.q2"), 0.95);
}

// Terms fitted to noise do not predict it. Of 60 sets of noise about three may have a q2 above 0.2;
// ten have a probability of 1e-3.
TEST(PolynomialChaos, Q2IsThatOfRunsWithoutAPartInTheChoice) {
    int high = 0;
    double q2 = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Rng rng(seed);
        std::uint64_t used = 0;
        for (const auto& [n, d] :
             {std::pair<std::size_t, std::size_t>{10, 2}, {50, 6}, {100, 10}}) {
            const auto rows = points_in(make("random", points(n, d), {}, {.seed = seed}));
            const PointSet table = with_outputs(rows, [&](auto) { return rng.uniform(used++); });
            const std::string key = table.dimension() == 3 ? "z" : "x" + std::to_string(d + 1);
            try {
                high += chaos(table).number(key + ".q2") >= 0.2;
            } catch (const Error&) {  // no term was chosen
            }
        }
        // 4 x - 2 y + z + noise with an eighth of the variance, and an inert input.
        const auto rows = points_in(make("random", points(200, 4), {}, {.seed = seed}));
        const Report report = chaos(with_outputs(rows, [&](auto u) {
            return 4 * u[0] - 2 * u[1] + u[2] + std::sqrt(3.0) * (rng.uniform(used++) - 0.5);
        }));
        q2 += report.number("x5.q2") / 20;
        EXPECT_NEAR(report.number("x5.x4.total"), 0, 0.03);
    }
    EXPECT_LT(high, 10);
    EXPECT_NEAR(q2, 0.875, 0.015);
}

// Intervals contain the index in at least 95 % of 40 samples, 3 inputs and two indices each: 210 of
// 240 would have a probability of 1e-6 if independent. Their width is little more than the variance
// that the polynomial does not explain.
TEST(PolynomialChaos, IntervalsHoldTheIndices) {
    int held = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const auto rows = points_in(make("random", points(100, 3), {}, {.seed = seed}));
        const Report report = chaos(with_outputs(rows, ishigami));
        for (std::size_t i = 0; i < 3; ++i)
            for (const bool total : {false, true}) {
                const std::string key =
                    "x4.x" + std::to_string(i + 1) + (total ? ".total" : ".first");
                const double right = total ? ishigami_total[i] : ishigami_first[i];
                held +=
                    report.number(key + "_low") <= right && right <= report.number(key + "_high");
                EXPECT_LT(report.number(key + "_high") - report.number(key + "_low"),
                          0.6 + 2 * (1 - report.number("x4.q2")));
            }
    }
    EXPECT_GE(held, 216);
    const Report few = chaos(with_outputs(points_in(make("random", points(19, 3))), linear));
    EXPECT_EQ(few.text("x4.no_intervals"), "19 runs; intervals need 20");
    EXPECT_EQ(few.find("x4.x1.total_low"), nullptr);
}

// The inputs are exp(5 u), but the output is nearly a polynomial in u.
TEST(PolynomialChaos, TakesRanksWhereTheyFitBetter) {
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
              "does not need a polynomial");
}

}  // namespace stipple::testing::polynomial_chaos_test
