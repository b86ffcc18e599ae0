// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/text.hpp"
#include "report/average.hpp"
#include "support/units.hpp"

namespace stipple::testing::hyperuniformity_test {
namespace {

constexpr const char* unit = "hyperuniformity";

Report report(const PointSet& set, const Settings& settings = {}) {
    return analyze(unit, set, settings);
}

/// Volume of the intersection of two balls, in slices perpendicular to the line between their
/// centres.
double overlap_by_slices(std::size_t d, double r, double radius) {
    if (r >= 2 * radius) return 0;
    if (d == 1) return 2 * radius - r;
    constexpr int slices = 20'000;
    const double low = std::asin(r / 2 / radius);
    const double step = (std::numbers::pi / 2 - low) / slices;
    double sum = 0;
    for (int i = 0; i < slices; ++i) {
        const double half = radius * std::cos(low + step * (i + 0.5));
        sum += half * step * (d == 2 ? 2 * half : std::numbers::pi * half * half);
    }
    return 2 * sum;
}

double volume_of_ball(std::size_t d, double radius) { return overlap_by_slices(d, 0, radius); }

PointSet in_box(std::size_t n, const Box& box) {
    PointSet set = make("random", points(n, box.dimension()));
    scale_into(box, set.flat());
    set.domain = box_domain(box);
    return set;
}

}  // namespace

TEST(Hyperuniformity, VarianceIsTheSumOverPairsOfTheirOverlaps) {
    for (const Box& box : {Box{{-1}, {3}}, Box{{0, 2}, {1, 3.5}}, Box{{0, 0, -1}, {1, 2, 0.5}}}) {
        PointSet set = in_box(40, box);
        std::ranges::copy(set[3], set[5].begin());
        for (std::size_t k = 0; k < box.dimension(); ++k) set[7][k] = box.high[k];
        const Report found = report(set, {{"radii", "3"}});
        const double volume = volume_of(box);
        for (std::size_t at = 0; at < 3; ++at) {
            const double radius = found.curve("radius")[at] * found.number("mean_distance");
            const double ball = volume_of_ball(box.dimension(), radius);
            const double mean = 40 * ball / volume;
            double squares = mean;
            for (std::size_t i = 0; i < 40; ++i)
                for (std::size_t j = 0; j < i; ++j) {
                    double squared = 0;
                    for (std::size_t k = 0; k < box.dimension(); ++k) {
                        const double gap = std::abs(set[i][k] - set[j][k]);
                        squared += std::pow(std::min(gap, box.extent(k) - gap), 2);
                    }
                    squares +=
                        2 / volume * overlap_by_slices(box.dimension(), std::sqrt(squared), radius);
                }
            const double variance = squares - mean * mean;
            const double tolerance = 1e-7 * mean * mean + 1e-8;
            EXPECT_NEAR(found.curve("mean")[at], mean, 1e-7 * mean) << box.dimension();
            EXPECT_NEAR(found.curve("variance")[at], variance, tolerance) << box.dimension();
            EXPECT_NEAR(found.curve("dispersion")[at], variance / mean / (1 - ball / volume),
                        tolerance / mean)
                << box.dimension();
        }
    }
}

// Square lattices have few distances, which bins of any width preserve; others have a few per bin.
// Oracle: all pairs, with overlaps summed one by one.
TEST(Hyperuniformity, VarianceOfLatticesIsWithinTheErrorThatIsStated) {
    for (const auto& [generator, n, most] :
         {std::tuple{"regular", std::size_t{900}, 1e-10}, {"halton", std::size_t{500}, 1e-6}}) {
        const PointSet set = make(generator, points(n, 2));
        const Report found = report(set);
        for (const std::size_t at : {0U, 11U, 39U}) {
            if (at >= found.curve("radius").size()) continue;
            const long double radius =
                found.curve("radius")[at] * static_cast<long double>(found.number("mean_distance"));
            long double sum = 0;
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = 0; j < i; ++j) {
                    long double squared = 0;
                    for (std::size_t k = 0; k < 2; ++k) {
                        const long double gap = std::abs(set[i][k] - set[j][k]);
                        squared += std::min(gap, 1 - gap) * std::min(gap, 1 - gap);
                    }
                    const long double r = std::sqrt(squared);
                    if (r >= 2 * radius) continue;
                    sum += 2 * radius * radius * std::acos(r / (2 * radius)) -
                           r / 2 * std::sqrt(4 * radius * radius - squared);
                }
            const long double mean =
                static_cast<long double>(n) * std::numbers::pi_v<long double> * radius * radius;
            const auto right = static_cast<double>(mean + 2 * sum - mean * mean);
            const double error = found.curve("variance_error")[at];
            const double rounding = 1e-14 * static_cast<double>(mean * mean);
            EXPECT_NEAR(found.curve("variance")[at], right, error + rounding) << generator;
            EXPECT_LT(error, most) << generator << " " << found.curve("radius")[at];
        }
    }
}

// Counts in windows at many positions, here on a lattice of centres that is incommensurable with
// the points.
TEST(Hyperuniformity, VarianceIsThatOfCountsInWindows) {
    const PointSet set = make("random", points(200, 2));
    const Report found = report(set);
    for (const std::size_t at : {0U, 20U, 39U}) {
        const double radius = found.curve("radius")[at] * found.number("mean_distance");
        double sum = 0, squares = 0;
        constexpr int side = 211;
        for (int u = 0; u < side; ++u)
            for (int v = 0; v < side; ++v) {
                int count = 0;
                for (std::size_t i = 0; i < set.count(); ++i) {
                    double x = std::abs(set[i][0] - u / double{side});
                    double y = std::abs(set[i][1] - v / double{side});
                    x = std::min(x, 1 - x);
                    y = std::min(y, 1 - y);
                    count += x * x + y * y <= radius * radius ? 1 : 0;
                }
                sum += count;
                squares += count * count;
            }
        const double mean = sum / (side * side);
        EXPECT_NEAR(found.curve("mean")[at], mean, 0.01 * mean);
        EXPECT_NEAR(found.curve("variance")[at], squares / (side * side) - mean * mean,
                    0.02 * found.curve("variance")[at]);
    }
}

// n points on a circle, 1 / n apart: a window of length f / n and a bit more contains f or f + 1.
TEST(Hyperuniformity, LatticeOnALineByHand) {
    const Report found = report(make("regular", points(400, 1)));
    for (std::size_t i = 0; i < found.curve("radius").size(); ++i) {
        const double places = 2 * found.curve("radius")[i];
        const double part = places - std::floor(places);
        EXPECT_NEAR(found.curve("variance")[i], part * (1 - part), 1e-9) << places;
    }
    EXPECT_LT(std::abs(found.number("exponent")), 0.3);
}

// Poisson's sum over the lattice's frequencies k of (2 pi R J_1(k R) / k)^2, whose average over the
// oscillation is 4 pi R / k^3: variance / R is 1 / (2 pi^2) sum over (a, b) != 0 of (a^2 +
// b^2)^(-3/2), which is 4 zeta(3/2) beta(3/2) / (2 pi^2), in units of the lattice spacing.
TEST(Hyperuniformity, SquareLatticeByItsFrequencies) {
    const Report found = report(make("regular", points(128 * 128, 2)),
                                {{"min-radius", "10"}, {"max-radius", "14"}, {"radii", "1000"}});
    const auto& radius = found.curve("radius");
    const auto& variance = found.curve("variance");
    double area = 0;
    for (std::size_t i = 1; i < radius.size(); ++i)
        area += (variance[i] / radius[i] + variance[i - 1] / radius[i - 1]) / 2 *
                (radius[i] - radius[i - 1]);
    const double zeta = 2.612375348685488;
    const double beta = 0.8645026534612;
    EXPECT_NEAR(area / (radius.back() - radius.front()),
                4 * zeta * beta / (2 * std::numbers::pi * std::numbers::pi), 0.002);
}

// Standard deviations between sets of independent points are 0.09 for exponents and 0.04 for
// dispersions (estimated from 60 sets): the bounds are 5 standard deviations of a mean of 5. False
// alarm: 1e-6 each.
TEST(Hyperuniformity, ExponentTellsIndependentPointsFromEvenOnes) {
    for (const std::size_t d : {1U, 2U, 3U}) {
        const auto side = static_cast<std::size_t>(d == 1 ? 4096 : d == 2 ? 64 : 16);
        const auto n = static_cast<std::size_t>(std::pow(side, d));
        double independent = 0, even = 0, dispersion = 0;
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            const Report found = report(make("random", points(n, d), {}, {.seed = seed}));
            independent += found.number("exponent") / 5;
            dispersion += found.curve("dispersion")[10] / 5;
            const auto jittered = make("jittered", points(n, d), {}, {.seed = seed});
            even += report(jittered).number("exponent") / 5;
        }
        const auto dimension = static_cast<double>(d);
        EXPECT_NEAR(independent, dimension, 0.2) << d;
        EXPECT_NEAR(dispersion, 1, 0.1) << d;
        EXPECT_NEAR(even, dimension - 1, 0.15) << d;
    }
}

// A lattice has the same variance inside a box as on the torus. Variances of 10,000 windows have a
// standard deviation of at least 1.4 %; those of independent points the set's own 10 %.
TEST(Hyperuniformity, StraightWindowsStayInTheBox) {
    for (const std::size_t d : {1U, 2U, 3U}) {
        const PointSet grid = make("regular", points(d == 3 ? 4096 : 1024, d));
        const Settings radii = {{"min-radius", "1"}, {"max-radius", "3"}, {"radii", "5"}};
        Settings straight = radii;
        straight.insert(straight.end(), {{"metric", "euclidean"}, {"windows", "10000"}});
        const Report drawn = report(grid, straight);
        const Report exact = report(grid, radii);
        for (std::size_t i = 0; i < drawn.curve("radius").size(); ++i) {
            const double variance = exact.curve("variance")[i];
            EXPECT_NEAR(drawn.curve("mean")[i], exact.curve("mean")[i],
                        5 * std::sqrt(variance / 10'000) + 1e-9);
            EXPECT_NEAR(drawn.curve("variance")[i], variance,
                        0.08 * variance + 5 * std::sqrt(variance / 10'000) + 1e-9)
                << d;
        }
        EXPECT_EQ(drawn.text("method"), "windows");
    }
    // Windows do not extend beyond the walls: there is no deficit at the corners.
    const Report random = report(make("random", points(20'000, 2)), {{"metric", "euclidean"}});
    EXPECT_NEAR(random.curve("dispersion")[10], 1, 0.3);
    EXPECT_NEAR(random.number("exponent"), 2, 0.4);
    const Report even = report(make("jittered", points(19'881, 2)), {{"metric", "euclidean"}});
    EXPECT_NEAR(even.number("exponent"), 1, 0.2);
}

// Points 0.2 apart, centres in [0.25, 0.75]: a window of R = 0.125 has two points at a fifth of its
// positions, otherwise one; one of 0.25 has three at three fifths, otherwise two.
TEST(Hyperuniformity, WindowsByHand) {
    PointSet set(5, 1);
    for (std::size_t i = 0; i < 5; ++i) set[i][0] = 0.1 + 0.2 * static_cast<double>(i);
    const Report found = report(
        set,
        {{"metric", "euclidean"}, {"min-radius", "0.625"}, {"max-radius", "1.25"}, {"radii", "3"}});
    EXPECT_NEAR(found.curve("mean").front(), 1.2, 0.02);
    EXPECT_NEAR(found.curve("variance").front(), 0.16, 0.01);
    EXPECT_NEAR(found.curve("mean").back(), 2.6, 0.025);
    EXPECT_NEAR(found.curve("variance").back(), 0.24, 0.005);
}

TEST(Hyperuniformity, PointsAtFewPlacesAreCountedToo) {
    // Half of the points at each of two positions that no window contains both: N is 50 or 0.
    PointSet set(100, 2);
    for (std::size_t i = 50; i < 100; ++i) set[i][0] = set[i][1] = 0.5;
    const Report found = report(set);
    for (std::size_t i = 0; i < found.curve("radius").size(); ++i) {
        const double share = found.curve("mean")[i] / 50;
        EXPECT_NEAR(found.curve("variance")[i], 2500 * share * (1 - share), 1e-5);
    }
}

TEST(Hyperuniformity, AverageHasTheSlopeOfTheMeanVariance) {
    const Analyzer& analyzer = find_analyzer(unit);
    Report mean = report(make("random", points(500, 2)));
    const double slope = mean.number("exponent");
    auto* variance = std::get_if<Report::Curve>(mean.find("variance"));
    auto* dispersion = std::get_if<Report::Curve>(mean.find("dispersion"));
    for (std::size_t i = 0; i < variance->size(); ++i) {
        const double radius = mean.curve("radius")[i];
        (*variance)[i] *= radius;
        (*dispersion)[i] *= radius;
    }
    analyzer.refine(mean, 2, analyzer.options.defaults());
    EXPECT_NEAR(mean.number("exponent"), slope + 1, 1e-9);
}

// Neighbouring radii share their pairs, so the residuals of one fit give no standard error. Over 100
// means of 8 sets, that of the mean is the spread of the means; both have errors below 10 %.
TEST(Hyperuniformity, TheExponentsStandardErrorIsTheSpreadOfMeans) {
    const Analyzer& analyzer = find_analyzer(unit);
    constexpr std::size_t repeats = 100;
    constexpr std::size_t sets = 8;
    double sum = 0, squares = 0, errors = 0, covered = 0;
    for (std::size_t k = 0; k < repeats; ++k) {
        ReportAverage average;
        std::vector<Report> singles;
        for (std::size_t i = 0; i < sets; ++i) {
            const Report one =
                report(make("random", {64, 2}, {}, {.seed = k * sets + i + 1}), {{"radii", "8"}});
            EXPECT_EQ(one.find("exponent_standard_error"), nullptr);
            average.add(one);
            singles.push_back(numbers_only(one));
        }
        Report mean = average.mean();
        analyzer.refine(mean, sets, analyzer.options.defaults());
        analyzer.combine(mean, singles, analyzer.options.defaults());
        const double exponent = mean.number("exponent");
        const double error = mean.number("exponent_standard_error");
        sum += exponent;
        squares += exponent * exponent;
        errors += error * error;
        covered += std::abs(exponent - 2) <= 2 * error ? 1 : 0;
    }
    const double spread = std::sqrt((squares - sum * sum / repeats) / (repeats - 1));
    EXPECT_NEAR(std::sqrt(errors / repeats) / spread, 1, 0.25);
    EXPECT_GE(covered, 84) << "about 92 are, by Student's t with 7 degrees of freedom";
}

TEST(Hyperuniformity, RefusesWhatHasNoWindows) {
    const auto refusal = [](const PointSet& set, const Settings& settings = {}) {
        return error_of([&] { report(set, settings); });
    };
    const PointSet set = make("random", points(100, 2));
    EXPECT_EQ(refusal(points_of({{0.5, 0.5}})),
              "input: hyperuniformity needs at least two points; this is one");
    EXPECT_EQ(refusal(points_of({{0.5, 0.5}, {0.5, 0.5}})),
              "input: hyperuniformity needs points at two or more places; all 2 are at one");
    EXPECT_EQ(refusal(make("random", points(10, 4))),
              "input: hyperuniformity requires points of dimension 1 to 3; these have 4");
    EXPECT_EQ(refusal(set, {{"max-radius", "2.6"}}),
              "usage: --max-radius: 2.6 is more than a quarter of the shortest side, which is 2.5 "
              "mean distances");
    EXPECT_EQ(refusal(set, {{"windows", "100"}}),
              "usage: --windows applies to --metric euclidean only");
    EXPECT_EQ(refusal(set, {{"min-radius", "2"}, {"max-radius", "1"}}),
              "usage: --min-radius: 2 is not below the largest radius, 1");
    EXPECT_EQ(refusal(set, {{"min-radius", "0.9999"}, {"max-radius", "1"}}),
              "usage: --min-radius: 0.9999 is too close to the largest radius, 1, to fit a slope");
}

// Windows of 4e4 points whose numbers vary by less than 1: the squares' means cancel in float64, and
// are not small enough to be rounding errors.
TEST(Hyperuniformity, WindowsWithManyPointsCountExactly) {
    constexpr std::size_t n = 100'000;
    PointSet line = make("random", points(n, 1));
    for (std::size_t i = 0; i < n; ++i)
        line[i][0] = (static_cast<double>(i) + line[i][0]) / static_cast<double>(n);
    const Report found = report(line, {{"metric", "euclidean"},
                                       {"min-radius", "12000"},
                                       {"max-radius", "24000"},
                                       {"windows", "2000"},
                                       {"radii", "4"}});
    for (const double variance : found.curve("variance")) EXPECT_NEAR(variance, 1. / 3, 0.12);
    ASSERT_NE(found.find("exponent"), nullptr);
    EXPECT_NEAR(found.number("exponent"), 0, 1);  // that of the 0.12 over a factor of two
}

}  // namespace stipple::testing::hyperuniformity_test
