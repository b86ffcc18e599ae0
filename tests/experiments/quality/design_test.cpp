// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/chain.hpp"
#include "support/units.hpp"

namespace stipple::testing::design_test {
namespace {

constexpr const char* unit = "design";

Report report_on(const PointSet& set, const Settings& settings = {}) {
    return analyze(unit, set, settings);
}

/// Efficiency of a design from its levels.
Report efficiency(std::string_view generator, const Request& request, const Settings& settings,
                  const char* model) {
    return report_on(make(generator, request, settings), {{"model", model}, {"compare", "0"}});
}

}  // namespace

// The corners (1/4, 1/4), ..., by hand: four distances 1/2 and two 1/sqrt 2.
TEST(Design, DistancesOfFourCornersByHand) {
    const Report report = report_on(make("factorial", {}), {{"p", "2"}, {"compare", "0"}});
    EXPECT_DOUBLE_EQ(report.number("minimum"), 0.5);
    EXPECT_DOUBLE_EQ(report.number("minimum_squared"), 0.25);
    EXPECT_DOUBLE_EQ(report.number("phi_p"), std::sqrt(4 * 4 + 2 * 2.0));
    EXPECT_DOUBLE_EQ(report.number("audze_eglais"), 20);
    EXPECT_EQ(report.number("variation"), 0);
    EXPECT_EQ(report.number("line_minimum"), 0);
    EXPECT_DOUBLE_EQ(report.number("plane_minimum"), 0.5);
    EXPECT_EQ(report.find("maxpro"), nullptr) << "coordinates are shared";
    EXPECT_EQ(report.find("latin_hypercube"), nullptr);
}

// Oracle: the definitions, pair by pair.
TEST(Design, CriteriaAreThoseOfTheDefinitions) {
    const std::size_t n = 40;
    const std::size_t d = 3;
    const PointSet set = make("random", points(n, d), {}, {.seed = 3});
    const Report report = report_on(set, {{"p", "15"}, {"compare", "0"}});
    double least = 9;
    double phi = 0;
    double audze = 0;
    double maxpro = 0;
    std::vector<double> line(d, 9);
    std::vector<double> plane(d, 9);  // projected along axis k
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            double squared = 0;
            double product = 1;
            for (std::size_t k = 0; k < d; ++k) {
                const double step = set[i][k] - set[j][k];
                squared += step * step;
                product *= step * step;
                line[k] = std::min(line[k], std::abs(step));
            }
            for (std::size_t k = 0; k < d; ++k)
                plane[k] = std::min(plane[k], squared - std::pow(set[i][k] - set[j][k], 2));
            least = std::min(least, squared);
            phi += std::pow(squared, -7.5);
            audze += 1 / squared;
            maxpro += 1 / product;
        }
    EXPECT_NEAR(report.number("minimum"), std::sqrt(least), 1e-14);
    EXPECT_NEAR(report.number("phi_p"), std::pow(phi, 1. / 15), 1e-11);
    EXPECT_NEAR(report.number("audze_eglais"), audze, 1e-11 * audze);
    const double pairs = n * (n - 1) / 2.;
    EXPECT_NEAR(report.number("maxpro"), std::cbrt(maxpro / pairs), 1e-11 * std::cbrt(maxpro));
    const auto axis = static_cast<std::size_t>(std::ranges::min_element(line) - line.begin());
    EXPECT_NEAR(report.number("line_minimum"), line[axis], 1e-15);
    EXPECT_EQ(std::get<Report::Integers>(*report.find("line_axis")),
              Report::Integers{static_cast<std::int64_t>(axis + 1)});
    const auto along = static_cast<std::size_t>(std::ranges::min_element(plane) - plane.begin());
    EXPECT_NEAR(report.number("plane_minimum"), std::sqrt(plane[along]), 1e-14);
    Report::Integers axes{1, 2, 3};
    std::erase(axes, static_cast<std::int64_t>(along + 1));
    EXPECT_EQ(std::get<Report::Integers>(*report.find("plane_axes")), axes);
}

TEST(Design, CorrelationsAreThoseOfTheMoments) {
    const PointSet set = make("random", points(30, 2), {}, {.seed = 8});
    const Report moments = analyze("moments", set);
    const auto& covariance = moments.curve("covariance");
    const double expected = std::abs(covariance[1]) / std::sqrt(covariance[0] * covariance[3]);
    const Report report = report_on(set, {{"compare", "0"}});
    EXPECT_NEAR(report.number("largest_correlation"), expected, 1e-13);
    EXPECT_NEAR(report.number("rms_correlation"), expected, 1e-13);
    EXPECT_EQ(std::get<Report::Integers>(*report.find("largest_correlation_axes")),
              (Report::Integers{1, 2}));
    const PointSet screening = make("plackett-burman", points(12, 11));
    EXPECT_NEAR(report_on(screening).number("largest_correlation"), 0, 1e-15);
}

// Orthogonal two-level designs have the largest possible efficiency.
TEST(Design, OrthogonalDesignsHaveEfficiencyOne) {
    const Request three{.dimension = 3};
    for (const Report& report :
         {efficiency("factorial", three, {}, "linear"),
          efficiency("factorial", three, {}, "interaction"),
          efficiency("factorial", {.dimension = 6}, {}, "linear"),
          efficiency("plackett-burman", points(12, 11), {}, "linear"),
          efficiency("fractional-factorial", points(8, 7), {}, "linear"),
          efficiency("fractional-factorial", points(16, 5), {}, "interaction")})
        for (const char* key : {"d_efficiency", "a_efficiency", "g_efficiency"})
            EXPECT_NEAR(report.number(key), 1, 1e-12) << key;
}

// 3^2 runs for 6 terms, by hand: det = 6 6 4 36 = 5184; the trace of the inverse is 1/6 + 1/6 + 1/4
// + 14/9; the variance is largest at the corners, 1/6 + 1/6 + 1/4 + 2/9 = 29/36.
TEST(Design, QuadraticEfficiencyOfThreeSquaredByHand) {
    const Report report = efficiency("factorial", {}, {{"levels", "3"}}, "quadratic");
    EXPECT_EQ(report.number("terms"), 6);
    EXPECT_NEAR(report.number("d_efficiency"), std::pow(5184, 1. / 6) / 9, 1e-12);
    EXPECT_NEAR(report.number("a_efficiency"), 6 / (9 * (7. / 12 + 14. / 9)), 1e-12);
    EXPECT_NEAR(report.number("g_efficiency"), 24. / 29, 1e-12);
    EXPECT_EQ(report.text("g_places"), "grid");
}

TEST(Design, AliasedTermsHaveNoEfficiency) {
    const Report report =
        efficiency("fractional-factorial", points(16, 5), {{"generators", "E=AB"}}, "interaction");
    for (const char* key : {"d_efficiency", "a_efficiency", "g_efficiency"})
        EXPECT_EQ(report.number(key), 0) << key;
    EXPECT_EQ(report.text("g_places"), "corners");
}

// With too many corners to try all, efficiency is evaluated at the design's own points.
TEST(Design, ManyFactorsAreJudgedAtThePoints) {
    const Report report = efficiency("plackett-burman", points(48, 47), {}, "linear");
    EXPECT_EQ(report.text("g_places"), "points");
    EXPECT_NEAR(report.number("g_efficiency"), 1, 1e-12);
}

// Compared with means over the sets of seeds 1 to 3, computed one by one.
TEST(Design, ComparesWithTheMeanOfLatinHypercubes) {
    const PointSet set = make("sobol", points(32, 3));
    const Report report = report_on(set, {{"compare", "3"}});
    for (const char* key : {"minimum", "phi_p", "maxpro", "rms_correlation", "d_efficiency",
                            "line_minimum", "plane_minimum"}) {
        double mean = 0;
        for (const std::uint64_t seed : {1, 2, 3})
            mean += report_on(make("latin-hypercube", points(32, 3), {}, {.seed = seed}),
                              {{"compare", "0"}})
                        .number(key) /
                    3;
        EXPECT_NEAR(report.number(std::string("latin_hypercube.") + key), mean, 1e-12 * mean)
            << key;
    }
    EXPECT_EQ(report_on(set).number("minimum"), report.number("minimum"));
}

TEST(Design, BoxesAreScaledToTheCube) {
    const PointSet set = make("random", points(64, 2));
    PointSet wide =
        generate("random", {.count = 64, .dimension = 2, .bounds = parse_box("0..8,-4..0", 2)});
    const Report one = report_on(set, {{"model", "quadratic"}});
    const Report other = report_on(wide, {{"model", "quadratic"}});
    for (const char* key :
         {"minimum", "phi_p", "maxpro", "rms_correlation", "d_efficiency", "g_efficiency"})
        EXPECT_NEAR(one.number(key), other.number(key), 1e-9 * one.number(key)) << key;
}

TEST(Design, PointsThatCoincideLeaveSumsOut) {
    const Report report = report_on(make("central-composite", {}, {{"center", "3"}}));
    EXPECT_EQ(report.number("minimum"), 0);
    for (const char* key : {"phi_p", "audze_eglais", "maxpro"})
        EXPECT_EQ(report.find(key), nullptr) << key;
    EXPECT_NE(report.find("latin_hypercube.phi_p"), nullptr);
}

// Two points that differ by 1/2 in each coordinate have maxpro (1/2)^-2; it was 0 for 512
// coordinates and more, and absent for points near each other in many.
TEST(Design, MaxproOfManyCoordinates) {
    const auto maxpro = [](double step, std::size_t d) {
        const PointSet two = points_of({std::vector(d, 0.25), std::vector(d, 0.25 + step)});
        return report_on(two, {{"model", "none"}, {"compare", "0"}}).number("maxpro");
    };
    EXPECT_NEAR(maxpro(0.5, 600), 4, 1e-12);
    EXPECT_NEAR(maxpro(0x1p-10, 300), 0x1p20, 1e-6);
}

// Correlations do not depend on the place and the width of the points. In a cluster of width 1e-14
// the rounding of the mean had made one of 0.8; widths below 1e-154 gave -1 for the largest.
TEST(Design, CorrelationsOfClusters) {
    const PointSet set = make("random", points(2000, 3));
    for (const auto& [place, width] : {std::pair(0.875, 0x1p-46), {0., 0x1p-600}}) {
        PointSet cluster = set;
        for (std::size_t i = 0; i < set.count(); ++i)
            for (std::size_t k = 1; k < 3; ++k)
                cluster[i][k] = place + width * std::floor(64 * set[i][k]) / 64;
        PointSet levels = set;
        for (std::size_t i = 0; i < set.count(); ++i)
            for (std::size_t k = 1; k < 3; ++k) levels[i][k] = std::floor(64 * set[i][k]) / 64;
        const Settings settings{{"compare", "0"}, {"model", "none"}};
        const Report found = report_on(cluster, settings);
        const Report expected = report_on(levels, settings);
        for (const char* key : {"largest_correlation", "rms_correlation"})
            EXPECT_NEAR(found.number(key), expected.number(key), 1e-12) << place;
    }
}

// Different projections whose squared distance underflows are no plane_minimum of 0.
TEST(Design, ProjectionsBelowFloat64AreLeftOut) {
    PointSet set = make("random", points(8, 3));
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t k = 1; k < 3; ++k) set[i][k] *= 1e-200;
    const Report report = report_on(set, {{"compare", "0"}});
    EXPECT_EQ(report.find("plane_minimum"), nullptr);
    EXPECT_GT(report.number("line_minimum"), 0);
}

TEST(Design, RefusesTooFewPoints) {
    const auto error = [](std::uint64_t n, std::size_t d, const Settings& settings) {
        return error_of([&] { report_on(make("random", points(n, d)), settings); });
    };
    EXPECT_EQ(error(1, 2, {}), "input: design needs at least two points; this is one");
    EXPECT_EQ(error(5, 2, {{"model", "quadratic"}}),
              "input: 5 points are fewer than the 6 terms of --model quadratic | --model none "
              "omits the efficiencies");
    EXPECT_EQ(report_on(make("random", points(5, 8)), {{"model", "none"}}).find("d_efficiency"),
              nullptr);
}

}  // namespace stipple::testing::design_test
