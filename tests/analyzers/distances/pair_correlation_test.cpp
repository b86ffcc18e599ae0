// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "analyzers/distances/pair_counts.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "support/units.hpp"

namespace stipple::testing::pair_correlation_test {

using analyzers::longest_distance;
using analyzers::pair_probability;
using analyzers::pair_probability_beyond;

namespace {

constexpr const char* unit = "pair-correlation";
constexpr double pi = std::numbers::pi;

Report report(const PointSet& set, const Settings& settings = {}) {
    return analyze(unit, set, settings);
}

PointSet on(PointSet set, const Box& box) {
    set.domain = box_domain(box);
    return set;
}

/// Points in the box, some of them twice, some on its faces.
PointSet awkward(const Box& box, std::size_t count) {
    const Rng rng(7);
    const std::size_t d = box.dimension();
    PointSet set(count, d);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < d; ++k) {
            const double u = rng.uniform(i * d + k);
            const double on_face = u < 0.05 ? 0 : u > 0.95 ? 1 : u;
            set[i][k] = box.low[k] + box.extent(k) * on_face;
        }
    for (std::size_t i = 0; i + 10 < count; i += 10) std::ranges::copy(set[i], set[i + 3].begin());
    return on(std::move(set), box);
}

double distance(const PointSet& set, std::size_t i, std::size_t j, const Box& box, bool torus) {
    double sum = 0;
    for (std::size_t k = 0; k < box.dimension(); ++k) {
        double gap = std::abs(set[i][k] - set[j][k]);
        if (torus) gap = std::min(gap, box.extent(k) - gap);
        sum += gap * gap;
    }
    return std::sqrt(sum);
}

const Box line{{-1}, {3}};
const Box flat{{0, 2}, {1, 2.75}};
const Box solid{{0, 0, -1}, {1, 2, 0.5}};

/// Probability of a distance up to r, by summation over midpoints of small cells of displacements.
double added_up(const Box& box, bool torus, double r, int cells) {
    const std::size_t d = box.dimension();
    double all = 0;
    double within = 0;
    std::vector<int> at(d);
    for (std::size_t k = 0; k < d;) {
        double weight = 1;
        double squares = 0;
        for (std::size_t j = 0; j < d; ++j) {
            const double x = box.extent(j) * (at[j] + 0.5) / cells / (torus ? 2 : 1);
            weight *= torus ? 1 : box.extent(j) - x;
            squares += x * x;
        }
        all += weight;
        if (squares <= r * r) within += weight;
        for (k = 0; k < d && ++at[k] == cells; ++k) at[k] = 0;
    }
    return within / all;
}

}  // namespace

TEST(PairCorrelation, ChancesOfDistancesByHand) {
    // Chiu et al., section 4.7: the integral of the set covariance over the ball, r up to every
    // side.
    const double r = 0.7;
    EXPECT_DOUBLE_EQ(pair_probability(line, true, 1), 0.5);
    EXPECT_DOUBLE_EQ(pair_probability(line, false, 1), 2. / 4 - 1. / 16);
    EXPECT_NEAR(pair_probability({{0, 0}, {3, 2}}, true, r), pi * r * r / 6, 1e-15);
    EXPECT_NEAR(
        pair_probability(flat, false, r),
        (pi * r * r * 0.75 - 4. / 3 * std::pow(r, 3) * 1.75 + std::pow(r, 4) / 2) / (0.75 * 0.75),
        1e-14);
    EXPECT_NEAR(pair_probability({{0, 0, 0}, {2, 3, 4}}, true, r),
                4. / 3 * pi * std::pow(r, 3) / 24, 1e-14);
    EXPECT_NEAR(pair_probability(solid, false, r),
                (4. / 3 * pi * std::pow(r, 3) * 3 - pi / 2 * std::pow(r, 4) * (2 + 1.5 + 3) +
                 8. / 15 * std::pow(r, 5) * 4.5 - std::pow(r, 6) / 6) /
                    9,
                1e-13);
}

TEST(PairCorrelation, ChancesOfLongDistancesAreThoseAddedUp) {
    for (const Box& box : {line, flat, solid})
        for (const bool torus : {true, false}) {
            const double longest = longest_distance(box, torus);
            EXPECT_EQ(pair_probability(box, torus, longest), 1);
            EXPECT_NEAR(pair_probability(box, torus, longest * (1 - 1e-12)), 1, 1e-9);
            EXPECT_EQ(pair_probability(box, torus, 0), 0);
            const int cells = box.dimension() == 3 ? 100 : 1000;
            for (const double share : {0.2, 0.45, 0.6, 0.7, 0.85, 0.95})
                EXPECT_NEAR(pair_probability(box, torus, share * longest),
                            added_up(box, torus, share * longest, cells), 1e-3)
                    << box.dimension() << torus << share;
        }
}

TEST(PairCorrelation, CountsEveryPairOnce) {
    for (const Box& box : {line, flat, solid})
        for (const bool torus : {true, false})
            for (const double share : {0.15, 1.0}) {
                const PointSet set = awkward(box, 700);
                const double reach = share * longest_distance(box, torus);
                const Report found = report(set, {{"max-distance", format_number(reach)},
                                                  {"bins", "50"},
                                                  {"metric", torus ? "torus" : "euclidean"}});
                Report::Integers expected(51);
                for (std::size_t i = 0; i < set.count(); ++i)
                    for (std::size_t j = 0; j < i; ++j) {
                        const double place = distance(set, i, j, box, torus) * (1 / (reach / 50));
                        ++expected[static_cast<std::size_t>(std::min(place, 50.0))];
                    }
                expected.pop_back();
                EXPECT_EQ(std::get<Report::Integers>(*found.find("pairs")), expected)
                    << box.dimension() << torus << share;
            }
}

// Over all distances, the expected number of pairs is that of all pairs, so the weighted mean of g
// is 1.
TEST(PairCorrelation, DensitiesAddUpToAllPairs) {
    for (const Box& box : {line, flat, solid})
        for (const bool torus : {true, false}) {
            const PointSet set = awkward(box, 300);
            const double reach = longest_distance(box, torus) * (1 + 1e-10);
            const Report found = report(set, {{"max-distance", format_number(reach)},
                                              {"bins", "40"},
                                              {"metric", torus ? "torus" : "euclidean"}});
            double sum = 0;
            for (std::size_t i = 0; i < 40; ++i) {
                const double chance =
                    pair_probability(box, torus, reach / 40 * static_cast<double>(i + 1)) -
                    pair_probability(box, torus, reach / 40 * static_cast<double>(i));
                sum += found.curve("density")[i] * chance;
            }
            EXPECT_NEAR(sum, 1, 1e-9) << box.dimension() << torus;
        }
}

TEST(PairCorrelation, NeighborsOfLattices) {
    // 32 x 32 points have 4 neighbours each at 1/32; the ring of the bin is pi (0.3^2 - 0.25^2).
    const PointSet grid = make("regular", points(1024, 2));
    const Report found =
        report(grid, {{"max-distance", "2"}, {"bins", "16"}, {"normalize-distance", "true"}});
    EXPECT_NEAR(found.curve("density")[8] * 1023. / 1024, 4 / (pi * (1.125 * 1.125 - 1)), 1e-9);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(found.curve("density")[i], 0);
}

// False alarm for the first claim: 6 standard deviations in 800 bins, 1e-6.
TEST(PairCorrelation, UniformPointsHaveNone) {
    for (const Box& box : {line, flat, solid})
        for (const bool torus : {true, false})
            for (const char* kernel : {"histogram", "epanechnikov"}) {
                Request request = points(10'000, box.dimension());
                request.bounds = box;
                const Report found =
                    report(make("random", request),
                           {{"kernel", kernel}, {"metric", torus ? "torus" : "euclidean"}});
                EXPECT_EQ(found.find("deviation") != nullptr, torus);
                double squares = 0;
                for (std::size_t i = 1; i < 200; ++i) {
                    const double off = found.curve("density")[i] - 1;
                    if (!torus) {
                        EXPECT_LT(std::abs(off), i < 100 ? 2 : 0.5) << kernel << i;
                        continue;
                    }
                    const double share = off / found.curve("deviation")[i];
                    EXPECT_LT(std::abs(share), 6) << kernel << i;
                    squares += share * share / 199;
                }
                if (!torus) continue;
                // Independent bins: 6 standard deviations of their sum of squares.
                const bool independent = std::string_view(kernel) == "histogram";
                EXPECT_GT(squares, independent ? 0.4 : 0.1) << kernel << box.dimension();
                EXPECT_LT(squares, independent ? 1.6 : 6.0) << kernel << box.dimension();
            }
    const Report jittered = report(make("jittered", points(16384, 2)));
    EXPECT_LT(jittered.curve("density")[3], 0.5);
}

TEST(PairCorrelation, SmoothingIsTheSumOverPairs) {
    for (const Box& box : {line, flat, solid}) {
        const PointSet set = awkward(box, 200);
        const double reach = 0.4;
        const double h = 5 * reach / 40;
        const Report found = report(set, {{"max-distance", format_number(reach)},
                                          {"bins", "40"},
                                          {"kernel", "epanechnikov"},
                                          {"bandwidth", "5"}});
        for (const std::size_t at : {0U, 3U, 20U, 40U}) {
            const double t = reach / 40 * static_cast<double>(at);
            double sum = 0;
            for (std::size_t i = 0; i < set.count(); ++i)
                for (std::size_t j = 0; j < i; ++j) {
                    const double u = (distance(set, i, j, box, true) - t) / h;
                    if (std::abs(u) < 1) sum += 1 - u * u;
                }
            double mean = 0;
            constexpr int steps = 4000;
            const double low = std::max(0.0, t - h);
            for (int s = 0; s < steps; ++s) {
                const double from = low + (t + h - low) * s / steps;
                const double to = low + (t + h - low) * (s + 1) / steps;
                const double u = ((from + to) / 2 - t) / h;
                mean += (1 - u * u) *
                        (pair_probability(box, true, to) - pair_probability(box, true, from));
            }
            EXPECT_NEAR(found.curve("density")[at] / (sum / (mean * 200 * 199 / 2)), 1, 1e-5)
                << box.dimension() << at;
            EXPECT_EQ(found.curve("distance")[at], t);
        }
    }
}

// On the circle of length 1, distances are uniform in [0, 1/2], so w has mean 8 h / 3 and mean
// square 32 h / 15 away from 0, and half of both at 0.
TEST(PairCorrelation, DeviationOfSmoothedDensitiesByHand) {
    const Report found = report(
        make("random", points(100, 1)),
        {{"max-distance", "0.4"}, {"bins", "40"}, {"kernel", "epanechnikov"}, {"bandwidth", "5"}});
    const double h = 0.05;
    for (const std::size_t at : {0U, 5U, 17U, 40U}) {
        const double share = at == 0 ? 0.5 : 1;
        const double mean = share * 8 * h / 3;
        const double variance = share * 32 * h / 15 - mean * mean;
        EXPECT_NEAR(found.curve("deviation")[at], std::sqrt(variance / 4950) / mean, 1e-12) << at;
    }
}

TEST(PairCorrelation, UnitsOfTheMeanDistanceFitSetsOfAnySize) {
    const PointSet few = make("random", points(1000, 2));
    const Report plain = report(few, {{"max-distance", "0.1"}});
    const Report scaled = report(few, {{"max-distance", format_number(0.1 * std::sqrt(1000))},
                                       {"normalize-distance", "true"}});
    EXPECT_EQ(plain.find("pairs") != nullptr, true);
    EXPECT_NEAR(scaled.curve("distance")[10], plain.curve("distance")[10] * std::sqrt(1000), 1e-12);
    EXPECT_NEAR(scaled.curve("density")[10], plain.curve("density")[10], 1e-9);
    const Report more = report(make("random", points(4000, 2)), {{"normalize-distance", "true"}});
    EXPECT_NEAR(more.number("bin_width"),
                report(few, {{"normalize-distance", "true"}}).number("bin_width"), 1e-15);
}

TEST(PairCorrelation, RefusesWhatHasNoPairs) {
    const auto refusal = [](const PointSet& set, const Settings& settings = {}) {
        return error_of([&] { report(set, settings); });
    };
    EXPECT_EQ(refusal(points_of({{0.5, 0.5}})),
              "input: pair-correlation needs at least two points; this is one");
    EXPECT_EQ(refusal(make("random", points(10, 2)), {{"max-distance", "0.8"}}),
              "usage: --max-distance: 0.8 is more than any pair can have; expected at most "
              "0.7071067811865476");
    EXPECT_EQ(refusal(make("random", points(10, 2)), {{"bandwidth", "3"}}),
              "usage: --bandwidth applies to --kernel epanechnikov only");
    EXPECT_EQ(refusal(make("random", points(10, 2)), {{"kernel", "epanechnikov"}, {"bins", "3"}}),
              "usage: --bandwidth: 4 is more than the 3 bins");
    EXPECT_NE(refusal(make("random", points(10, 2)), {{"max-distance", "0"}}), "");
    EXPECT_NE(refusal(make("random", points(10, 4))), "");
    // Two points at the same position are a pair at distance 0.
    const Report same = report(points_of({{0.5, 0.5}, {0.5, 0.5}}));
    EXPECT_EQ(std::get<Report::Integers>(*same.find("pairs"))[0], 1);
}

TEST(PairCorrelation, WarnsOfPointsThatAreAllEqual) {
    const auto warnings = [](const PointSet& set) {
        std::vector<std::string> told;
        RunContext run;
        run.warn = [&told](const std::string& sentence) { told.push_back(sentence); };
        (void)analyze(unit, set, {}, run);
        return told;
    };
    const PointSet equal = points_of({{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}});
    EXPECT_EQ(warnings(equal),
              std::vector<std::string>{"all 3 points are equal: all distances are 0"});
    EXPECT_TRUE(warnings(points_of({{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.25}})).empty());
    EXPECT_EQ(warnings(points_of({{0.1, 0.1}, {0.6, 0.6}})).at(0).substr(0, 24),
              "no two points are within");
}

TEST(PairCorrelation, ProbabilityOfFarPairsKeepsItsDigits) {
    for (const bool torus : {true, false})
        for (const Box& box : {Box{{0, 0}, {1, 1}}, Box{{0, 0}, {3, 0.01}},
                               Box{{0, 0, 0}, {1, 1, 1}}, Box{{0, 0}, {1, 1e-6}},
                               Box{{0, 0, 0}, {1, 0.1, 0.001}}, Box{{0, 0, 0}, {0.1, 1, 1}}}) {
            const double longest = longest_distance(box, torus);
            for (const double less : {0.08, 0.05, 0.02, 0.01, 0.001}) {
                const double r = longest * (1 - less);
                const auto beyond = pair_probability_beyond(box, torus, r);
                if (!beyond) continue;
                EXPECT_NEAR(*beyond, 1 - pair_probability(box, torus, r), 2e-12 + 1e-9 * *beyond)
                    << less;
            }
            EXPECT_EQ(pair_probability_beyond(box, torus, longest * 0.5), std::nullopt);
            EXPECT_EQ(pair_probability_beyond(box, torus, longest * 1.001), 0);
        }
    // Of the cube, to first order in e = sqrt 3 (longest - r): 8 e^6 / 6!; of its torus 8 e^3 / 3!.
    const Box cube{{0, 0, 0}, {1, 1, 1}};
    const double reach = 1e-5 * std::sqrt(3.0);
    EXPECT_NEAR(*pair_probability_beyond(cube, false, std::sqrt(3.0) - 1e-5) /
                    (8 * std::pow(reach, 6) / 720),
                1, 1e-4);
    EXPECT_NEAR(
        *pair_probability_beyond(cube, true, std::sqrt(0.75) - 1e-5) / (8 * std::pow(reach, 3) / 6),
        1, 1e-4);
}

// In the last bin of 2000 the chance of a pair is 1.3e-19, which 1 - p(r) rounded to 0.
TEST(PairCorrelation, FarPairsHaveTheirDensity) {
    const PointSet set = points_of({{0, 0, 0}, {1, 1, 0.9997}, {0.5, 0.5, 0.5}});
    for (const char* kernel : {"histogram", "epanechnikov"}) {
        const Report found = report(set, {{"metric", "euclidean"},
                                          {"max-distance", "1.7320508"},
                                          {"bins", "2000"},
                                          {"kernel", kernel}});
        const double reach = std::sqrt(3.0) * 1.7320508 / 2000;
        const double chance = 8 * std::pow(reach, 6) / 720;
        const double density = found.curve("density")[1999];
        EXPECT_GT(density, 1e-6 / 3 / chance) << kernel;
        EXPECT_LT(density, 10 / 3. / chance) << kernel;
        const bool plain = std::string(kernel) == "histogram";
        EXPECT_NEAR(density * 3 * chance, 1, plain ? 0.01 : 100);
    }
}

TEST(PairCorrelation, RefusesDistancesWithoutProbability) {
    const PointSet set = points_of({{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, {0.1, 0.2, 0.3}});
    EXPECT_TRUE(error_of([&] {
                    report(set, {{"max-distance", "1e-120"}});
                }).starts_with("usage: --max-distance: 1e-120 is too small"));
    EXPECT_GT(report(set, {{"max-distance", "1e-80"}}).curve("density")[0], 1e200);
}

}  // namespace stipple::testing::pair_correlation_test
