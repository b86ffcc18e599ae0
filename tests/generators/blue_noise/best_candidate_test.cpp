// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "core/rng.hpp"
#include "math/combinatorics/splitmix64.hpp"
#include "support/spacing.hpp"

namespace stipple::testing::best_candidate_test {
namespace {

constexpr const char* unit = "best-candidate";
const Space square{{{0, 0}, {1, 1}}, true};

/// Oracle: Mitchell's method as published, with max(1, c i) candidates in the unit cube.
PointSet all_candidates(std::size_t count, const Space& space, std::size_t c, std::uint64_t seed) {
    const std::size_t d = space.box.dimension();
    const Rng rng(seed, 99);
    std::uint64_t drawn = 0;
    PointSet set(count, d);
    for (std::size_t i = 0; i < count; ++i) {
        double best = -1;
        for (std::size_t j = 0; j < std::max<std::size_t>(1, c * i); ++j) {
            std::vector<double> p(d);
            for (double& x : p) x = rng.uniform(drawn++);
            double nearest = std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < i; ++k)
                nearest = std::min(nearest, distance(p, set[k], space));
            if (nearest <= best) continue;
            best = nearest;
            std::ranges::copy(p, set[i].begin());
        }
    }
    return set;
}

/// Sum and sum of squares, over runs, of the distance from point i to earlier ones.
struct Tally {
    double sum = 0;
    double squares = 0;
    double runs = 0;
    void add(double x) {
        sum += x;
        squares += x * x;
        ++runs;
    }
    [[nodiscard]] double mean() const { return sum / runs; }
    [[nodiscard]] double error() const {  // squared standard error of the mean
        return (squares / runs - mean() * mean()) / runs;
    }
};

/// Largest difference of mean distances between the generator with `c` and the oracle with
/// `oracle_c` candidates, in standard errors.
double largest_deviation(const Space& space, const char* c, std::size_t oracle_c) {
    constexpr std::size_t count = 24;
    std::vector<Tally> ours(count);
    std::vector<Tally> theirs(count);
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        const PointSet a = make_in(unit, space, count, {{"candidates", c}}, seed);
        const PointSet b = all_candidates(count, space, oracle_c, seed);
        for (std::size_t i = 1; i < count; ++i) {
            ours[i].add(distance_to_earlier(a, i, space));
            theirs[i].add(distance_to_earlier(b, i, space));
        }
    }
    double worst = 0;
    for (std::size_t i = 1; i < count; ++i)
        worst = std::max(worst, std::abs(ours[i].mean() - theirs[i].mean()) /
                                    std::sqrt(ours[i].error() + theirs[i].error()));
    return worst;
}

}  // namespace

// The distribution is that of generating all candidates. Six spaces and factors, 23 points each, at
// 5 standard errors: false alarm 138 x 6e-7 = 8e-5. Half as many candidates are detected.
TEST(BestCandidate, DistancesFollowTheLawOfAllCandidates) {
    const Space line{{{0}, {1}}, false};
    const Space cube{{{0, 0, 0}, {1, 1, 1}}, true};
    const Space five{{{0, 0, 0, 0, 0}, {1, 1, 1, 1, 1}}, false};
    EXPECT_LT(largest_deviation(square, "1", 1), 5);
    EXPECT_LT(largest_deviation(square, "6", 6), 5);
    EXPECT_LT(largest_deviation({square.box, false}, "3", 3), 5);
    EXPECT_LT(largest_deviation(line, "2", 2), 5);
    EXPECT_LT(largest_deviation(cube, "2", 2), 5);
    EXPECT_LT(largest_deviation(five, "2", 2), 5);
    EXPECT_GT(largest_deviation(square, "3", 6), 5);
    EXPECT_GT(largest_deviation(line, "1", 2), 5);
}

// With very many candidates each point is as far from all earlier ones as possible: at half the
// diagonal, then the centre of the largest gap.
TEST(BestCandidate, EndlessCandidatesFindTheFarthestPlace) {
    const PointSet set = make(unit, points(4, 2), {{"candidates", "1e6"}});
    EXPECT_NEAR(distance_to_earlier(set, 1, square), std::sqrt(0.5), 2e-3);
    EXPECT_NEAR(distance_to_earlier(set, 2, square), 0.5, 2e-3);
    EXPECT_NEAR(distance_to_earlier(set, 3, square), 0.5, 2e-3);
    const Space line{{{0}, {1}}, true};
    const PointSet three = make(unit, points(3, 1), {{"candidates", "1e6"}});
    EXPECT_NEAR(distance_to_earlier(three, 1, line), 0.5, 1e-4);
    EXPECT_NEAR(distance_to_earlier(three, 2, line), 0.25, 1e-4);
}

// Oracle: no position of 10 i random ones is much farther from the first i points than point i.
TEST(BestCandidate, EveryPointIsNearTheFarthestPlaceOfItsTime) {
    const std::size_t n = 300;
    const PointSet set = make(unit, points(n, 2), {{"candidates", "10"}});
    const Rng rng(5);
    double lost = 0;
    for (std::size_t i = 1; i < n; ++i) {
        PointSet probed(i + 1, 2);
        std::copy_n(set.flat().begin(), 2 * i, probed.flat().begin());
        double farthest = 0;
        for (std::size_t j = 0; j < 10 * i; ++j) {
            probed[i][0] = rng.uniform(i * 10'000 + 2 * j);
            probed[i][1] = rng.uniform(i * 10'000 + 2 * j + 1);
            farthest = std::max(farthest, distance_to_earlier(probed, i, square));
        }
        lost += farthest / distance_to_earlier(set, i, square) - 1;
    }
    EXPECT_NEAR(lost / static_cast<double>(n), 0, 0.02);
}

// Oracle: uses the same random numbers and compares every candidate with every point.
TEST(BestCandidate, TakesTheBestOfAllCandidatesInFourDimensions) {
    for (const bool torus : {true, false}) {
        const Space space{{{0, -1, 2, 0}, {1, 3, 2.5, 1}}, torus};
        const std::size_t n = 150;
        const PointSet set = make_in(unit, space, n, {{"candidates", "1.5"}}, 7);
        const Rng rng(7);
        PointSet ours(n, 4);
        for (std::size_t i = 0; i < n; ++i) {
            SplitMix64 stream(rng.bits(i));
            double best = -1;
            for (std::size_t j = 0; j < std::max<std::size_t>(1, i * 3 / 2); ++j) {
                PointSet tried(ours);
                for (std::size_t k = 0; k < 4; ++k)
                    tried[i][k] = space.box.low[k] + to_unit(stream.next()) * space.box.extent(k);
                const double nearest = i == 0 ? 0 : distance_to_earlier(tried, i, space);
                if (nearest <= best) continue;
                best = nearest;
                std::ranges::copy(tried[i], ours[i].begin());
            }
        }
        EXPECT_TRUE(std::ranges::equal(set.flat(), ours.flat())) << space.name();
    }
}

TEST(BestCandidate, MakesPointsInAnyBox) {
    for (const Space& space : some_spaces())
        for (const std::uint64_t n : {1, 2, 3, 100}) {
            const PointSet set = make_in(unit, space, n);
            EXPECT_EQ(set.count(), n) << space.name();
            expect_inside(set, space);
            EXPECT_GT(smallest_distance(set, space), 0) << space.name();
        }
    EXPECT_EQ(make(unit, points(60, 32)).count(), 60U);
}

TEST(BestCandidate, EveryPrefixIsTheSetOfItsCount) {
    for (const std::size_t d : {1, 2, 3, 4}) {
        const PointSet whole = make(unit, points(600, d));
        for (const std::uint64_t n : {1, 2, 100, 599})
            EXPECT_TRUE(
                std::ranges::equal(make(unit, points(n, d)).flat(), whole.flat().first(n * d)));
        const PointSet tail = make(unit, points(200, d, 400));
        EXPECT_TRUE(std::ranges::equal(tail.flat(), whole.flat().last(200 * d)));
    }
}

// Mean coordinates of 200 sets of 20 points are within 5 standard deviations of random points,
// which vary more.
TEST(BestCandidate, FavoursNoPlaceOfTheTorus) {
    double sum[2] = {0, 0};
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const PointSet set = make(unit, points(20, 2), {}, {.seed = seed});
        for (std::size_t i = 0; i < set.count(); ++i)
            for (std::size_t k = 0; k < 2; ++k) sum[k] += set[i][k] - 0.5;
    }
    for (const double s : sum) EXPECT_LT(std::abs(s), 5 * std::sqrt(4000.0 / 12));
}

// Cells were halved until they were far smaller than the share of a candidate, or than coordinates.
TEST(BestCandidate, EndsWithFewCandidatesAndCoarseCoordinates) {
    const PointSet few = make_in(unit, square, 8, {{"candidates", "1e-12"}}, 1);
    expect_inside(few, square);
    for (const std::size_t d : {1, 2}) {
        const Space far{{std::vector<double>(d, 1e15), std::vector<double>(d, 1e15 + 16)}, true};
        expect_inside(make_in(unit, far, 100, {}, 1), far);
    }
}

TEST(BestCandidate, RefusesWhatCannotBe) {
    const auto refusal = [](const Request& request, const Settings& settings) {
        return error_of([&] { make(unit, request, settings, {.max_memory = 1 << 26}); });
    };
    EXPECT_EQ(refusal({}, {{"torus", "true"}, {"bounded", "true"}}),
              "usage: --torus contradicts --bounded; give one of them");
    EXPECT_NE(refusal({}, {{"candidates", "0"}}), "");
    EXPECT_EQ(refusal(points(1'000'000, 2), {}).substr(0, 6), "limit:");
    EXPECT_EQ(error_of([] { make(unit, points(30'000'000, 2)); }).substr(0, 6), "limit:");
    EXPECT_EQ(refusal({.dimension = 3, .bounds = Box{{0, 0}, {1, 1}}}, {}),
              "usage: --bounds: 2 ranges for 3 coordinates");
}

}  // namespace stipple::testing::best_candidate_test
