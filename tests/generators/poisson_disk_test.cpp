// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "core/rng.hpp"
#include "core/text.hpp"
#include "support/pictures.hpp"
#include "support/units.hpp"

using namespace stipple;
using namespace stipple::testing;

namespace {

struct Space {
    std::vector<double> low;
    std::vector<double> high;
    bool torus;

    [[nodiscard]] std::size_t dimension() const { return low.size(); }
    [[nodiscard]] std::string name() const {
        return format_box({low, high}) + (torus ? " torus" : " bounded");
    }
};

/// Odd proportions, small and large against a radius of 1; far from the origin; thin.
const std::vector<Space> spaces = [] {
    std::vector<Space> all;
    for (const bool torus : {true, false})
        for (const auto& [low, high] :
             std::vector<std::pair<std::vector<double>, std::vector<double>>>{
                 {{0, 0}, {20, 20}},
                 {{0, 0}, {1, 1}},
                 {{0, 0}, {2, 2}},
                 {{-7, 3}, {6.3, 4.1}},
                 {{1e6, -5}, {1e6 + 9, 8}},
                 {{0, 0}, {90, 0.01}},
                 {{0, 0, 0}, {1, 1, 1}},
                 {{0, 0, 0}, {7, 7, 7}},
                 {{-9, 1, 2}, {8, 1.3, 5.7}}})
            all.push_back({low, high, torus});
    return all;
}();

PointSet fill(const Space& space, std::optional<std::uint64_t> count, Settings settings,
              std::uint64_t seed = 1) {
    if (!space.torus) settings.emplace_back("bounded", "true");
    Request request{.count = count, .dimension = space.dimension()};
    request.bounds = Box{space.low, space.high};
    return make("poisson-disk", request, settings, {.seed = seed});
}

/// Oracle: the distance as a user would work it out.
double distance(std::span<const double> p, std::span<const double> q, const Space& space) {
    double sum = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
        double d = std::abs(p[k] - q[k]);
        if (space.torus) d = std::min(d, (space.high[k] - space.low[k]) - d);
        sum += d * d;
    }
    return std::sqrt(sum);
}

double smallest_distance(const PointSet& set, const Space& space) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < set.count(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            least = std::min(least, distance(set[i], set[j], space));
    return least;
}

/// Fraction of the space where one more point would fit, by 4000 probes.
double uncovered(const PointSet& set, const Space& space, double radius) {
    const Rng rng(77);
    const std::size_t d = space.dimension();
    const std::uint64_t probes = 4000;
    double free = 0;
    for (std::uint64_t i = 0; i < probes; ++i) {
        std::vector<double> p(d);
        for (std::size_t k = 0; k < d; ++k)
            p[k] = space.low[k] + rng.uniform(i * d + k) * (space.high[k] - space.low[k]);
        bool fits = true;
        for (std::size_t j = 0; j < set.count() && fits; ++j)
            fits = distance(p, set[j], space) >= radius;
        free += fits;
    }
    return free / static_cast<double>(probes);
}

double radius_of(const PointSet& set) {
    for (const auto& [name, text] : set.provenance.options)
        if (name == "radius") return parse_number(text).value();
    return -1;
}

void expect_inside(const PointSet& set, const Space& space) {
    for (std::size_t i = 0; i < set.count(); ++i)
        for (std::size_t k = 0; k < set.dimension(); ++k)
            EXPECT_TRUE(set[i][k] >= space.low[k] && set[i][k] < space.high[k]) << space.name();
}

}  // namespace

TEST(PoissonDisk, EveryPairKeepsTheRadiusInAnyBox) {
    for (const Space& space : spaces)
        for (const std::uint64_t seed : {1, 2, 3}) {
            const PointSet set = fill(space, {}, {{"radius", "1"}}, seed);
            EXPECT_GE(smallest_distance(set, space), 1) << space.name() << ", seed " << seed;
            expect_inside(set, space);
            EXPECT_EQ(radius_of(set), 1);
        }
}

// Bridson's method leaves about 0.1 % (2-D) and 0.3 % (3-D) of the space; single small boxes vary,
// so that the mean over ten seeds is asked to be below 1 %.
TEST(PoissonDisk, HardlyAPlaceIsLeft) {
    for (const Space& space : spaces) {
        double left = 0;
        for (std::uint64_t seed = 1; seed <= 10; ++seed)
            left += uncovered(fill(space, {}, {{"radius", "1"}}, seed), space, 1) / 10;
        EXPECT_LT(left, 0.01) << space.name();
    }
}

TEST(PoissonDisk, RadiiLargerThanHalfTheBoxWork) {
    for (const bool torus : {true, false})
        for (const char* radius : {"0.45", "0.5", "0.6", "0.71", "0.9", "1.2", "1.41"}) {
            const Space square{{0, 0}, {1, 1}, torus};
            for (std::uint64_t seed = 1; seed <= 20; ++seed) {
                const PointSet set = fill(square, {}, {{"radius", radius}}, seed);
                EXPECT_GE(smallest_distance(set, square), radius_of(set)) << square.name();
            }
        }
    // Half the diagonal is as far as it goes on the torus.
    EXPECT_EQ(make("poisson-disk", {}, {{"radius", "0.71"}}).count(), 1);
}

// Bridson's sets have a density n r^2 of about 0.615 on the torus, n r^3 of about 0.575.
TEST(PoissonDisk, DensityIsThatOfTheMethod) {
    const PointSet plane = make("poisson-disk", {}, {{"radius", "0.01"}});
    EXPECT_NEAR(static_cast<double>(plane.count()) * 1e-4, 0.615, 0.015);
    const PointSet space = make("poisson-disk", {.dimension = 3}, {{"radius", "0.05"}});
    EXPECT_NEAR(static_cast<double>(space.count()) * 1.25e-4, 0.575, 0.03);
}

TEST(PoissonDisk, MoreAttemptsLeaveFewerGaps) {
    const Space square{{0, 0}, {1, 1}, true};
    const auto gaps = [&](const char* k) {
        return uncovered(fill(square, {}, {{"radius", "0.03"}, {"k", k}}), square, 0.03);
    };
    EXPECT_GT(gaps("1"), 0.03);
    EXPECT_LT(gaps("300"), 0.001);
}

TEST(PoissonDisk, MakesExactlyAsManyAsAskedWithARadiusThatHolds) {
    for (const Space& space : spaces)
        for (const std::uint64_t n : {1, 2, 3, 7, 64}) {
            const PointSet set = fill(space, n, {});
            EXPECT_EQ(set.count(), n) << space.name();
            EXPECT_GT(radius_of(set), 0);
            EXPECT_GE(smallest_distance(set, space), radius_of(set)) << space.name() << ", " << n;
            expect_inside(set, space);
        }
    for (const std::uint64_t n : {1000, 3000}) {
        const PointSet set = fill({{0, 0}, {1, 1}, true}, n, {});
        EXPECT_EQ(set.count(), n);
        EXPECT_GE(smallest_distance(set, {{0, 0}, {1, 1}, true}), radius_of(set)) << n;
    }
    EXPECT_EQ(make("poisson-disk", {}).count(), 1024);
}

// The radius for N is within 0.5 % of the one that gives N on average, n r^2 = 0.6156.
TEST(PoissonDisk, RadiusForACountIsNearTheOneThatGivesItOnAverage) {
    for (const std::uint64_t n : {1000, 3000, 20'000}) {
        const double average = std::sqrt(0.6156 / static_cast<double>(n));
        const double found = radius_of(make("poisson-disk", points(n, 2)));
        EXPECT_GT(found, 0.995 * average) << n;
        EXPECT_LT(found, 1.02 * average) << n;
    }
}

// The points that fit into [0, 1] / 4 are a quarter of all within 10 standard deviations of a
// random set: one clump or one hole would miss that by far.
TEST(PoissonDisk, ExactCountsSpreadEvenly) {
    const PointSet set = make("poisson-disk", points(5000, 2));
    for (const double x : {0.0, 0.5})
        for (const double y : {0.0, 0.5}) {
            int inside = 0;
            for (std::size_t i = 0; i < set.count(); ++i)
                inside +=
                    set[i][0] >= x && set[i][0] < x + 0.5 && set[i][1] >= y && set[i][1] < y + 0.5;
            EXPECT_NEAR(inside, 1250, 40);
        }
    EXPECT_LT(uncovered(set, {{0, 0}, {1, 1}, true}, radius_of(set)), 0.02);
}

TEST(PoissonDisk, SeedAloneDecides) {
    const auto with = [](std::uint64_t seed, unsigned threads) {
        return make("poisson-disk", points(500, 2), {}, {.seed = seed, .threads = threads});
    };
    EXPECT_EQ(with(1, 1), with(1, 7));
    EXPECT_NE(with(1, 1), with(2, 1));
}

// Rotation on the torus changes nothing: the mean of 30 sets' coordinates is 1/2 within 5 standard
// deviations of points at random, which these spread less than.
TEST(PoissonDisk, FavoursNoPlace) {
    double sum[2] = {0, 0};
    double count = 0;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const PointSet set = make("poisson-disk", {}, {{"radius", "0.1"}}, {.seed = seed});
        for (std::size_t i = 0; i < set.count(); ++i)
            for (std::size_t k = 0; k < 2; ++k) sum[k] += set[i][k] - 0.5;
        count += static_cast<double>(set.count());
    }
    for (const double s : sum) EXPECT_LT(std::abs(s), 5 * std::sqrt(count / 12));
}

TEST(PoissonDisk, ProgressRisesToTheEnd) {
    for (const Settings& settings : {Settings{{"radius", "0.01"}}, Settings{}}) {
        double last = 0;
        RunContext run;
        run.progress = [&](double fraction) {
            EXPECT_GE(fraction, last);
            last = fraction;
        };
        make("poisson-disk", {}, settings, run);
        EXPECT_EQ(last, 1);
    }
}

TEST(PoissonDisk, StopsWhenAsked) {
    for (const Settings& settings :
         {Settings{{"radius", "0.0002"}}, Settings{{"radius", "0.3"}, {"k", "1000000"}}}) {
        std::stop_source source;
        RunContext run{.stop = source.get_token()};
        run.progress = [&](double) { source.request_stop(); };
        EXPECT_EQ(error_of([&] { make("poisson-disk", {}, settings, run); }),
                  "cancelled: interrupted");
    }
}

TEST(PoissonDisk, RefusesContradictionsAndImpossibleRadii) {
    const auto refusal = [](const Request& request, const Settings& settings) {
        return error_of([&] { make("poisson-disk", request, settings, {.max_memory = 1 << 30}); });
    };
    EXPECT_EQ(refusal(points(10, 2), {{"radius", "0.1"}}),
              "usage: --radius 0.1 contradicts --count 10; give one of them");
    EXPECT_EQ(refusal({}, {{"torus", "true"}, {"bounded", "true"}}),
              "usage: --torus contradicts --bounded; give one of them");
    EXPECT_EQ(refusal({}, {{"radius", "1.5"}}),
              "usage: --radius: 1.5 is outside (0, 1.4142135623730951]; no two points of the box "
              "are farther apart");
    EXPECT_EQ(refusal({}, {{"radius", "0"}}), "usage: --radius: 0 is outside (0, inf)");
    EXPECT_NE(refusal({}, {{"radius", "-1"}}), "");
    EXPECT_NE(refusal({}, {{"radius", "nan"}}), "");
    EXPECT_NE(refusal({}, {{"radius", "inf"}}), "");
    EXPECT_NE(refusal({}, {{"k", "0"}}), "");
    EXPECT_NE(refusal(points(10, 1), {}), "");
    EXPECT_NE(refusal(points(10, 4), {}), "");
    EXPECT_EQ(refusal({}, {{"radius", "1e-5"}}).substr(0, 6), "limit:");
    EXPECT_EQ(refusal({}, {{"radius", "1e-300"}}).substr(0, 6), "limit:");
    EXPECT_EQ(refusal(points(1'000'000'000, 2), {}).substr(0, 6), "limit:");
    EXPECT_EQ(error_of([] {
                  make("poisson-disk", {}, {{"radius", "1e-7"}});
              }).substr(0, 6),
              "limit:");
    EXPECT_EQ(refusal({.dimension = 3, .bounds = Box{{0, 0}, {1, 1}}}, {}),
              "usage: --bounds: 2 ranges for 3 coordinates");
    EXPECT_NE(refusal({.bounds = Box{{0, 0}, {1e-200, 1e-200}}}, {}), "");
    EXPECT_NE(refusal({.bounds = Box{{0, 0}, {1e200, 1}}}, {}), "");
}

// Coordinates near 1e12 are 2^-13 apart.
TEST(PoissonDisk, RefusesRadiiFinerThanTheCoordinates) {
    const Space far{{1e12, 0}, {1e12 + 1, 1}, true};
    EXPECT_EQ(error_of([&] {
                  fill(far, {}, {{"radius", "0.01"}});
              }),
              "limit: a radius of 0.01 is too fine for coordinates near 1000000000001, which tell "
              "0.22737 from each other well");
    EXPECT_EQ(error_of([&] { fill(far, 100'000, {}); }).substr(0, 6), "limit:");
    EXPECT_EQ(error_of([&] { fill(far, {}, {{"radius", "0.3"}}); }), "");
}

// The provenance says what makes the set again: the files, and the least radius.
TEST(PoissonDisk, NotesFilesAndTheLeastRadius) {
    const TemporaryFile density(npy_of("<f8", "(1, 2)", std::vector<double>{1, 4}));
    const TemporaryFile mask(npy_of("<f8", "(2, 1)", std::vector<double>{1, 0}));
    const PointSet set = make("poisson-disk", {},
                              {{"density", density.path()},
                               {"invert", "true"},
                               {"mask", mask.path()},
                               {"radius", "0.05"}});
    using Notes = std::vector<std::pair<std::string, std::string>>;
    EXPECT_EQ(set.provenance.options, (Notes{{"radius", "0.05"},
                                             {"torus", "true"},
                                             {"order", "random"},
                                             {"density", density.path()},
                                             {"mask", mask.path()},
                                             {"invert", "true"}}));
}

// A mask that leaves all is no other rule: n r^2 of the uniform set and of this one agree, within
// 5 of the standard deviations of each, 0.3 % of 4353 points.
TEST(PoissonDisk, AMaskOfAllLeavesTheProcessAsItIs) {
    const TemporaryFile mask(npy_of("<f8", "(1, 1)", std::vector<double>{3}));
    for (const std::uint64_t seed : {1, 2, 3}) {
        const PointSet set = make("poisson-disk", {},
                                  {{"radius", "0.01265"}, {"mask", mask.path()}}, {.seed = seed});
        const PointSet plain = make("poisson-disk", {}, {{"radius", "0.01265"}}, {.seed = seed});
        EXPECT_NEAR(static_cast<double>(set.count()), static_cast<double>(plain.count()),
                    5 * 0.003 * std::sqrt(2) * 4353);
    }
}
