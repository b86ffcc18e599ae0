// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/sensitivity/models.hpp"
#include "stipple/warp.hpp"
#include "support/temporary_file.hpp"

namespace stipple::testing::elementary_effects_test {

using namespace sensitivity;

namespace {
constexpr const char* unit = "sensitivity";
}

// A linear model has the same effect everywhere: mu* = |c|, and standard deviation 0.
TEST(ElementaryEffects, OfALinearModelAreItsCoefficients) {
    const Model model = [](auto u) { return 3 * u[0] - 2 * u[1] + 0.5 * u[2]; };
    const Report report = analyze(unit, with_outputs(morris_rows(10, 3, 1), model));
    EXPECT_EQ(report.text("x4.method"), "morris");
    EXPECT_EQ(report.text("x4.scale"), "cube");
    const double coefficients[] = {3, -2, 0.5};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string key = "x4.x" + std::to_string(i + 1);
        EXPECT_NEAR(report.number(key + ".mu"), coefficients[i], 1e-14);
        EXPECT_NEAR(report.number(key + ".mu_star"), std::abs(coefficients[i]), 1e-14);
        EXPECT_NEAR(report.number(key + ".mu_star_low"), std::abs(coefficients[i]), 1e-14);
        EXPECT_NEAR(report.number(key + ".sigma"), 0, 1e-7);  // the square root of rounding errors
    }
    EXPECT_EQ(report.number("x4.samples"), 10);
}

// x y on two trajectories: effects of x are y = 0 and 1, of y x = 1 and 1/2, by hand.
TEST(ElementaryEffects, ByHand) {
    const Rows rows = {{0, 0}, {1, 0}, {1, 1}, {0.5, 0.5}, {0.5, 1}, {0, 1}};
    const Report report = analyze(unit, with_outputs(rows, [](auto u) { return u[0] * u[1]; }));
    EXPECT_DOUBLE_EQ(report.number("z.x.mu"), 0.5);
    EXPECT_DOUBLE_EQ(report.number("z.x.mu_star"), 0.5);
    EXPECT_DOUBLE_EQ(report.number("z.x.sigma"), std::sqrt(0.5));
    EXPECT_DOUBLE_EQ(report.number("z.y.mu"), 0.75);
    EXPECT_DOUBLE_EQ(report.number("z.y.sigma"), std::sqrt(0.125));
    EXPECT_EQ(report.find("z.x.mu_star_low"), nullptr);
    EXPECT_EQ(report.text("z.no_intervals"), "2 trajectories; intervals need 10");
}

TEST(ElementaryEffects, OppositeEffectsCancelInMuAlone) {
    const Model model = [](auto u) { return std::abs(u[0] - 0.5) + u[1]; };
    const Rows rows = {{0, 0}, {0.5, 0}, {0.5, 1}, {0.5, 0}, {1, 0}, {1, 1}};
    const Report report = analyze(unit, with_outputs(rows, model));
    EXPECT_DOUBLE_EQ(report.number("z.x.mu"), 0);
    EXPECT_DOUBLE_EQ(report.number("z.x.mu_star"), 1);
    EXPECT_DOUBLE_EQ(report.number("z.x.sigma"), std::sqrt(2));
}

// Steps are fractions of the range: units do not matter, whether the range is given or estimated.
TEST(ElementaryEffects, StepsAreOfUnitInputs) {
    Rows rows = morris_rows(8, 2, 3);
    for (auto& row : rows) row = {100 + 50 * row[0], row[1] / 1000};
    const PointSet table =
        with_outputs(rows, [](auto u) { return (u[0] - 100) / 50 + 3000 * u[1]; });
    const Report seen = analyze(unit, table);
    EXPECT_EQ(seen.text("z.scale"), "range");
    EXPECT_NEAR(seen.number("z.x.mu"), 1, 1e-12);
    EXPECT_NEAR(seen.number("z.y.mu"), 3, 1e-12);

    std::string text = "# tool: \"stipple\"\n# domain: \"box:bounds=[100..200,0..0.001]\"\n";
    for (const auto& row : rows) text += fmt::format("{},{}\n", row[0], row[1]);
    const TemporaryFile design(text, ".csv");
    PointSet outputs(rows.size(), 1);
    for (std::size_t i = 0; i < rows.size(); ++i) outputs[i][0] = table[i][2];
    const Report told = analyze(unit, outputs, {{"design", design.path()}});
    EXPECT_EQ(told.text("y.scale"), "box");
    EXPECT_NEAR(told.number("y.x.mu"), 2, 1e-12);
    EXPECT_NEAR(told.number("y.y.mu"), 3, 1e-12);
}

// f(x) = ln x with a log range from 1 to e^6 is 6 u: its effect is 6 for any steps. A design with
// --bounds (0, 2) is one of u = x / 2.
TEST(ElementaryEffects, AreOfProbabilitiesOfTheInputs) {
    const std::string range =
        R"({"parameters":[{"name":"a","range":[1,403.428793492735],"scale":"log"},)"
        R"({"name":"b","range":[0,2]}]})";
    const PointSet points = make("morris", {.dimension = 2}, {{"middles", "true"}});
    PointSet design = warp("parameters:json=[" + range + "]", points);
    PointSet table =
        with_outputs(points_in(design), [](auto x) { return std::log(x[0]) + 3 * x[1]; });
    table.provenance = design.provenance;
    table.provenance.columns = {"a", "b", "y"};
    const Report report = analyze(unit, table);
    EXPECT_EQ(report.text("y.scale"), "distributions");
    EXPECT_NEAR(report.number("y.a.mu_star"), 6, 1e-9);
    EXPECT_NEAR(report.number("y.b.mu_star"), 6, 1e-9);
    EXPECT_NEAR(report.number("y.a.sigma"), 0, 1e-9);
}

// One star around (0, 0) and one around (1/2, 1/2), by hand: x y has the effects 0, 0 and 1/2, 1/2.
TEST(ElementaryEffects, OfStars) {
    const Rows rows = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}, {1, 0.5}, {0.5, 0}};
    const Report report = analyze(unit, with_outputs(rows, [](auto u) { return u[0] * u[1]; }));
    EXPECT_EQ(report.text("z.method"), "morris");
    EXPECT_DOUBLE_EQ(report.number("z.x.mu"), 0.25);
    EXPECT_DOUBLE_EQ(report.number("z.y.mu_star"), 0.25);
    EXPECT_DOUBLE_EQ(report.number("z.y.sigma"), std::sqrt(0.125));
    const PointSet radial = make("morris", points(80, 3), {{"radial", "true"}});
    const Report made = analyze(unit, with_outputs(points_in(radial), linear));
    EXPECT_EQ(made.number("x4.samples"), 20);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(made.number("x4.x" + std::to_string(i + 1) + ".mu_star"),
                    3. - static_cast<double>(i), 1e-9);
}

// The second trajectory does not move x: the effects of x are those of the other two, 1 and 3, by
// hand.
TEST(ElementaryEffects, OfAnInputThatStandsStill) {
    const Rows rows = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {0, 0}, {0, 1}, {0, 1}, {1, 1}, {1, 0}};
    const Report report =
        analyze(unit, with_outputs(rows, [](auto u) { return u[0] + 2 * u[0] * u[1]; }));
    EXPECT_EQ(report.text("z.method"), "morris");
    EXPECT_DOUBLE_EQ(report.number("z.x.mu"), 2);
    EXPECT_DOUBLE_EQ(report.number("z.x.sigma"), std::sqrt(2));
    EXPECT_DOUBLE_EQ(report.number("z.y.mu"), 4. / 3);
}

TEST(ElementaryEffects, TooLargeForADoubleAreMissing) {
    const Rows rows = {{0, 0}, {1, 0}, {1, 1}, {0.5, 0.5}, {0.5, 1}, {1, 1}};
    const Report report =
        analyze(unit, with_outputs(rows, [](auto u) { return u[0] > 0.9 ? 1.7e308 : -1.7e308; }));
    EXPECT_EQ(report.find("z.x.mu_star"), nullptr);
    EXPECT_NE(report.find("z.x.missing"), nullptr);
    EXPECT_EQ(report.number("z.y.mu_star"), 0);
}

TEST(ElementaryEffects, LeavesOutTrajectoriesWithFailedRuns) {
    const Rows rows = morris_rows(12, 3, 2);
    PointSet some = with_outputs(rows, ishigami);
    some[9][3] = std::nan("");
    Rows kept = rows;
    kept.erase(kept.begin() + 8, kept.begin() + 12);
    const Report report = analyze(unit, some);
    const Report all = analyze(unit, with_outputs(kept, ishigami));
    for (const char* key : {"x1.mu", "x2.mu_star", "x3.sigma", "x1.mu_star_high"})
        EXPECT_EQ(report.number(std::string("x4.") + key), all.number(std::string("x4.") + key));
    EXPECT_EQ(report.number("x4.used"), 44);
    EXPECT_EQ(report.number("x4.failed"), 1);
}

TEST(ElementaryEffects, RefusesTrajectoriesOnWhichAnInputMovesTwice) {
    const Rows rows = {{0, 0}, {1, 0}, {0.5, 0}, {0, 0}, {1, 0}, {1, 1}};
    const auto error = error_of([&] {
        analyze(unit, with_outputs(rows, [](auto u) { return u[0]; }), {{"method", "morris"}});
    });
    EXPECT_NE(error.find("coordinate 1 changes twice on the trajectory that starts at point 0"),
              std::string::npos)
        << error;
}

// Effects of y are 0 and 1 on five trajectories each, whatever x, or a trajectory with a failed run,
// does: sigma was 0 beside outputs of 1e200, whose squares it was compared with.
TEST(ElementaryEffects, DeviationsHaveTheirOwnUnit) {
    const double nan = std::nan("");
    Rows rows;
    for (int t = 0; t < 10; ++t)
        for (const auto& row : t % 2 == 0 ? Rows{{0, 0, 0}, {0, 1, 1}, {1, 1, 1e200}}
                                          : Rows{{1, 0, 1e200}, {1, 1, 1e200}, {0, 1, 1}})
            rows.push_back(row);
    const double deviation = std::sqrt(5. / 18);
    EXPECT_DOUBLE_EQ(analyze(unit, points_of(rows)).number("z.y.sigma"), deviation);
    for (auto& row : rows) row[2] = row[0] == 0 && row[1] == 1 ? 1e-150 : 0;
    for (const auto& row : Rows{{0, 0, 1e250}, {0, 1, nan}, {1, 1, 0}}) rows.push_back(row);
    const Report report = analyze(unit, points_of(rows));
    EXPECT_DOUBLE_EQ(report.number("z.y.sigma") / 1e-150, deviation);
    EXPECT_DOUBLE_EQ(report.number("z.y.mu") / 1e-150, 0.5);
    EXPECT_EQ(report.number("z.y.sigma_low"), 0) << "a deviation is not negative";
}

// The event x < 0.3, y < 0.5, z < 0.9 changes with z, by a step of 2/3, where z moves between 1/3 and 1
// (1/2) while x and y are low (1/4 and 1/2). No trajectory of ten shows that in half of the designs:
// 51 of 100 intervals held mu*.
TEST(ElementaryEffects, IntervalsAllowForEventsThatNoTrajectoryHasShown) {
    const auto event = [](auto u) { return u[0] < 0.3 && u[1] < 0.5 && u[2] < 0.9 ? 1. : 0.; };
    int mean = 0;
    int deviation = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const PointSet design = make("morris", points(40, 3), {}, {.seed = seed});
        const Report report = analyze(unit, with_outputs(points_in(design), event),
                                      {{"bootstrap", "100"}, {"method", "morris"}});
        const auto holds = [&](const std::string& key, double right) {
            return report.number("x4.x3." + key + "_low") <= right &&
                   right <= report.number("x4.x3." + key + "_high");
        };
        mean += holds("mu_star", 1.5 / 16);
        deviation += holds("sigma", 1.5 * std::sqrt(15.) / 16);
    }
    EXPECT_GE(mean, 88);
    EXPECT_GE(deviation, 88);
}

}  // namespace stipple::testing::elementary_effects_test
