// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <map>

#include "media/density_map.hpp"
#include "support/contract.hpp"
#include "support/pictures.hpp"
#include "support/spacing.hpp"
#include "support/units.hpp"

namespace stipple::testing::tiled_test {
namespace {

const std::string name = "tiled";
const Settings small{{"tile-points", "64"}, {"iterations", "100"}};

double smallest_distance(const PointSet& set) {
    return stipple::testing::smallest_distance(set, {{{0, 0}, {1, 1}}, true});
}

/// A steep density on 16 x 16 cells, with a band of zeros.
std::vector<double> steep() {
    std::vector<double> values(256);
    for (std::size_t i = 0; i < 256; ++i) {
        const auto x = static_cast<double>(i % 16);
        const auto y = static_cast<double>(i / 16);
        values[i] = i / 16 == 5 ? 0 : 0.05 + (x * x / 225) * (1 - 0.5 * y / 15);
    }
    return values;
}

Settings with_density(const TemporaryFile& file, Settings settings = small) {
    settings.emplace_back("density", file.path());
    return settings;
}

std::string array_of(std::size_t width, std::size_t height, const std::vector<double>& values) {
    return npy_of("<f8", fmt::format("({}, {})", height, width), values);
}

/// Pearson's statistic of the counts in 16 x 16 cells relative to the densities.
double statistic(const PointSet& set, const std::vector<double>& densities) {
    std::vector<double> found(256);
    for (std::size_t i = 0; i < set.count(); ++i)
        ++found[static_cast<std::size_t>(set[i][1] * 16) * 16 +
                static_cast<std::size_t>(set[i][0] * 16)];
    double sum = 0;
    for (const double density : densities) sum += density;
    double total = 0;
    for (std::size_t c = 0; c < 256; ++c) {
        const double expected = static_cast<double>(set.count()) * densities[c] / sum;
        if (expected > 0)
            total += (found[c] - expected) * (found[c] - expected) / expected;
        else
            EXPECT_EQ(found[c], 0);
    }
    return total;
}

/// Number of uses of each position in the tile, in units of 2^-28.
std::map<std::pair<double, double>, std::size_t> places(const PointSet& set, double side) {
    std::map<std::pair<double, double>, std::size_t> found;
    for (std::size_t i = 0; i < set.count(); ++i) {
        const auto inside = [&](double x) {
            const double t = std::round(x * side * 0x1p28) / 0x1p28;
            return t - std::floor(t);
        };
        ++found[{inside(set[i][0]), inside(set[i][1])}];
    }
    return found;
}

}  // namespace

// At most 64 points per tile: 1000 points need 4 x 4 tiles of 63, eight of which omit one point.
TEST(Tiled, RepeatsOneTileAndThinsItsLastPoint) {
    const PointSet set = make(name, points(1000, 2), small);
    const auto found = places(set, 4);
    EXPECT_EQ(found.size(), 63U);
    std::map<std::size_t, std::size_t> times;
    for (const auto& [place, count] : found) ++times[count];
    EXPECT_EQ(times, (std::map<std::size_t, std::size_t>{{16, 62}, {8, 1}}));
}

TEST(Tiled, EveryTileHasAsManyPointsUpToOne) {
    for (const std::uint64_t n : {65, 257, 1000, 1023, 1024, 1025, 5000}) {
        const auto side = static_cast<std::size_t>(std::ceil(std::sqrt((n + 63) / 64)));
        std::vector<std::uint64_t> found(side * side);
        const PointSet set = make(name, points(n, 2), small);
        for (std::size_t i = 0; i < n; ++i)
            ++found[static_cast<std::size_t>(set[i][1] * static_cast<double>(side)) * side +
                    static_cast<std::size_t>(set[i][0] * static_cast<double>(side))];
        const auto [least, most] = std::ranges::minmax(found);
        EXPECT_LE(most - least, 1U) << n;
        EXPECT_LE(most, 64U) << n;
    }
}

TEST(Tiled, KeepsTheTilesDistanceAcrossItsSeams) {
    const PointSet tile = make(name, points(64, 2), small);
    const double least = smallest_distance(tile);
    EXPECT_GT(least, 0.5 / 8);
    const PointSet set = make(name, points(64 * 25, 2), small);
    EXPECT_NEAR(smallest_distance(set), least / 5, 1e-9);
    EXPECT_GE(smallest_distance(make(name, points(64 * 25 - 24, 2), small)), 0.5 / 40);
}

// Ranks: the first half of the tile is spread better than a random half.
TEST(Tiled, EveryRankIsWellSpread) {
    const PointSet tile = make(name, points(1024, 2), {{"iterations", "100"}});
    for (const std::size_t n : {4U, 16U, 64U, 256U, 512U}) {
        const auto first = tile.flat().first(2 * n);
        const double spacing = 1 / std::sqrt(static_cast<double>(n));
        EXPECT_GT(smallest_distance(PointSet({first.begin(), first.end()}, 2)), 0.5 * spacing) << n;
    }
}

// Points of the last rank are spread over the tiles: each half of the square has its fraction.
TEST(Tiled, HolesAreSpreadOverTheSquare) {
    const std::uint64_t n = 64 * 400 - 200;
    const PointSet set = make(name, points(n, 2), small);
    std::size_t below = 0;
    for (std::size_t i = 0; i < n; ++i) below += set[i][1] < 0.5;
    EXPECT_NEAR(static_cast<double>(below), static_cast<double>(n) / 2, 1);
}

TEST(Tiled, FewPointsAreOneTile) {
    for (const std::uint64_t n : {1, 2, 3, 63})
        EXPECT_EQ(make(name, points(n, 2), small).count(), n);
    EXPECT_NE(make(name, points(63, 2), small, {.seed = 2}), make(name, points(63, 2), small));
}

TEST(Tiled, ManyPointsStayBelowOne) {
    const Generator& unit = find_generator(name);
    Values options = unit.options.defaults();
    unit.options.set(options, "tile-points", "16");
    const std::uint64_t n = (std::uint64_t{1} << 53) - 1;
    const auto sequence = unit.sequence(plan_for(unit, points(n, 2), options), options, {});
    std::vector<double> rows(2000);
    for (const std::uint64_t first : {std::uint64_t{0}, n / 2, n - 1000}) {
        sequence->fill(first, rows);
        for (const double x : rows) EXPECT_TRUE(x >= 0 && x < 1) << x;
    }
}

// For independent points the statistic has 240 - 1 degrees of freedom. These are much more even: it
// is in the lower tail for all seeds, and in the upper one for a density that is halved at one
// side. No false alarm, since the sets are fixed.
TEST(Tiled, PointsPerAreaFollowTheDensity) {
    const TemporaryFile file(array_of(16, 16, steep()));
    auto tilted = steep();
    for (std::size_t c = 0; c < 256; ++c) tilted[c] *= 1 - 0.5 * static_cast<double>(c / 16) / 15;
    const boost::math::chi_squared independent(239);
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
        const PointSet set = make(name, points(20'000, 2), with_density(file), {.seed = seed});
        EXPECT_LT(cdf(independent, statistic(set, steep())), 1e-6) << seed;
        EXPECT_LT(cdf(complement(independent, statistic(set, tilted))), 1e-6) << seed;
    }
}

// Two of 2000 points belong to an area of 31 tiles with 64 points: no single rank is low enough.
// Their number differs between sets by one or two, so the sum over 50 sets by less than 14; one
// standard deviation of independent points would be 10.
TEST(Tiled, FaintRegionsGetTheirShare) {
    const TemporaryFile file(array_of(2, 1, {1, 0.001}));
    double faint = 0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        const PointSet set =
            make(name, points(2000, 2),
                 with_density(file, {{"tile-points", "64"}, {"iterations", "0"}}), {.seed = seed});
        for (std::size_t i = 0; i < set.count(); ++i) faint += set[i][0] >= 0.5;
    }
    EXPECT_NEAR(faint, 50 * 2000 * 0.001 / 1.001, 14);
}

TEST(Tiled, GivesExactlyAsManyPointsWhateverTheDensity) {
    std::vector<double> checks(64 * 64);
    std::vector<double> spike(64 * 64, 1e-9);
    for (std::size_t i = 0; i < checks.size(); ++i) checks[i] = (i + i / 64) % 2 == 0;
    spike[1234] = 1;
    for (const auto& values : {checks, spike}) {
        const TemporaryFile file(array_of(64, 64, values));
        const DensityMap map(64, 64, values);
        for (const std::uint64_t n : {1, 2, 3, 64, 1000, 3000}) {
            const PointSet set = make(name, points(n, 2), with_density(file));
            ASSERT_EQ(set.count(), n);
            for (std::size_t i = 0; i < n; ++i) EXPECT_GT(map.at(set[i][0], set[i][1]), 0);
        }
    }
}

// Thinned points keep their distances, and those in a region of low density are well spread: random
// ones would have a tenth of the distance.
TEST(Tiled, ThinnedPointsAreSpread) {
    const TemporaryFile file(array_of(2, 1, {0.1, 1.9}));
    const PointSet set = make(name, points(1000, 2),
                              with_density(file, {{"tile-points", "4096"}, {"iterations", "100"}}));
    std::vector<double> halves[2];
    for (std::size_t i = 0; i < set.count(); ++i)
        for (const double x : set[i]) halves[set[i][0] >= 0.5].push_back(x);
    EXPECT_NEAR(static_cast<double>(halves[0].size()) / 2, 50, 2);
    EXPECT_GT(smallest_distance(PointSet(halves[0], 2)), 0.5 / std::sqrt(100));
    EXPECT_GT(smallest_distance(PointSet(halves[1], 2)), 0.5 / std::sqrt(1900));
}

TEST(Tiled, AConstantDensityIsAsNone) {
    const TemporaryFile file(array_of(3, 2, std::vector<double>(6, 0.7)));
    for (const std::uint64_t n : {7, 64, 1000})
        EXPECT_EQ(make(name, points(n, 2), with_density(file)), make(name, points(n, 2), small));
}

TEST(Tiled, InkLiesWhereThePictureIsDark) {
    const TemporaryFile file(png_of(2, 1, {0, 255}));
    for (const char* inverted : {"false", "true"}) {
        Settings settings = with_density(file);
        settings.emplace_back("invert", inverted);
        const PointSet set = make(name, points(500, 2), settings);
        for (std::size_t i = 0; i < 500; ++i)
            EXPECT_EQ(set[i][0] < 0.5, inverted == std::string("true"));
    }
}

TEST(Tiled, DensitiesDoNotDependOnThreads) {
    const TemporaryFile file(array_of(16, 16, steep()));
    const PointSet one = make(name, points(30'000, 2), with_density(file), {.threads = 1});
    EXPECT_EQ(one, make(name, points(30'000, 2), with_density(file), {.threads = 5}));
}

// Distances are those in the box, not in the unit square.
TEST(Tiled, IsEvenInABoxOfAnyProportions) {
    for (const auto& [a, b] : std::vector<std::pair<double, double>>{
             {2, 1}, {1, 3.7}, {30, 0.4}, {0.001, 0.0013}, {7, 7}})
        for (const std::uint64_t n : {60, 500, 2000}) {
            Request request = points(n, 2);
            request.bounds = Box{{5, 3}, {5 + a, 3 + b}};
            const PointSet set = make(name, request, small);
            const Space space{*request.bounds, true};
            EXPECT_GT(stipple::testing::smallest_distance(set, space),
                      0.5 * std::sqrt(a * b / static_cast<double>(n)))
                << space.name() << ", " << n;
        }
}

// Three tiles side by side, although not squares, are fewer than two by two.
TEST(Tiled, RepeatsATileInABoxNoMoreThanNeeded) {
    Request request = points(3 * 64, 2);
    request.bounds = Box{{0, 0}, {2, 1}};
    const PointSet set = make(name, request, small);
    std::map<std::pair<double, double>, std::size_t> found;
    for (std::size_t i = 0; i < set.count(); ++i) {
        const double x = std::round(set[i][0] * 3 * 0x1p28) / 0x1p28;
        ++found[{x - std::floor(x), set[i][1]}];
    }
    EXPECT_EQ(found.size(), 64U);
    for (const auto& [place, count] : found) EXPECT_EQ(count, 3U);
}

TEST(Tiled, WithADensityItReportsProgressAndStops) {
    const TemporaryFile file(array_of(16, 16, steep()));
    const auto work = [&](const RunContext& run) {
        make(name, points(100'000, 2), with_density(file), run);
    };
    expect_progress_to_the_end(work);
    expect_to_stop_at_once(work);
    EXPECT_EQ(error_of([&] {
                  make(name, points(100'000'000, 2), with_density(file), {.max_memory = 1 << 20});
              }).substr(0, 50),
              "limit: the tiling for this density needs 87.2 MiB ");
}

TEST(Tiled, ABoxOfEqualSidesIsAsTheUnitSquare) {
    Request request = points(300, 2);
    request.bounds = Box{{0.1, 1e5}, {1.1, 1e5 + 1}};
    PointSet expected = make(name, points(300, 2), small);
    scale_into(*request.bounds, expected.flat());
    EXPECT_EQ(make(name, request, small), expected);
}

TEST(Tiled, RefusesWrongOptionsInOneLine) {
    EXPECT_EQ(error_of([] {
                  make(name, points(9, 2), {{"invert", "true"}});
              }),
              "usage: --invert: there is no --density to invert");
    EXPECT_EQ(error_of([] {
                  Request request = points(9, 2);
                  request.bounds = Box{{0, 0}, {5000, 1}};
                  make(name, request);
              }),
              "usage: --bounds: 0..5000,0..1 has a side 5000 times as long as another; expected "
              "1000 times at most");
    std::vector<double> spike(1 << 20, 1e-9);
    spike[5] = 1;
    const TemporaryFile file(array_of(1024, 1024, spike));
    const auto error =
        error_of([&] { make(name, points(1'000'000'000'000, 2), with_density(file)); });
    EXPECT_TRUE(error.starts_with(fmt::format("limit: {}: ", file.path()))) << error;
}

}  // namespace stipple::testing::tiled_test
