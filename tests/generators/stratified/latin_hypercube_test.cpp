// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <stop_token>

#include "core/rng.hpp"
#include "math/digital/stratum.hpp"
#include "support/sequences.hpp"
#include "support/strata.hpp"
#include "support/temporary_file.hpp"

namespace stipple::testing::latin_hypercube_test {
namespace {

double correlation(const PointSet& set, std::size_t a, std::size_t b) {
    double sum = 0;
    for (std::size_t i = 0; i < set.count(); ++i) sum += (set[i][a] - 0.5) * (set[i][b] - 0.5);
    return 12 * sum / static_cast<double>(set.count());
}

/// Rows first, ..., last - 1.
PointSet part_of(const PointSet& set, std::size_t first, std::size_t last) {
    const std::size_t d = set.dimension();
    const auto rows = set.flat().subspan(first * d, (last - first) * d);
    return {std::vector<double>(rows.begin(), rows.end()), d};
}

/// The points as text of a file.
std::string text_of(const PointSet& points) {
    std::string text;
    for (std::size_t i = 0; i < points.count(); ++i)
        text += fmt::format("{}\n", fmt::join(points[i], ","));
    return text;
}

double said(const PointSet& set, std::size_t i = 0) {
    return std::stod(set.provenance.found.at(i).second);
}

/// Minimum squared distance of two strata.
double least_square(const PointSet& set) {
    const std::size_t n = set.count();
    double least = 1e300;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            double square = 0;
            for (std::size_t k = 0; k < set.dimension(); ++k) {
                const auto a = static_cast<double>(stratum_of(set[i][k], n));
                const auto b = static_cast<double>(stratum_of(set[j][k], n));
                square += (a - b) * (a - b);
            }
            least = std::min(least, square);
        }
    return least;
}

constexpr const char* criteria[] = {"maximin",     "phi-p",  "audze-eglais",
                                    "centered-l2", "maxpro", "correlation"};

}  // namespace

TEST(LatinHypercube, EachStratumHoldsOnePoint) {
    for (const std::uint64_t n : {1, 2, 3, 49, 64, 65, 97, 1000, 1024, 3001})
        for (const char* centered : {"false", "true"})
            EXPECT_TRUE(is_latin(make("latin-hypercube", points(n, 3), {{"centered", centered}})))
                << n;
    EXPECT_FALSE(is_latin(make("random", points(49, 3))));
}

TEST(LatinHypercube, CenteredPointsAreTheMiddlesOfTheirStrata) {
    const PointSet set = make("latin-hypercube", points(250, 2), {{"centered", "true"}});
    for (const double x : set.flat())
        EXPECT_EQ(x, (2 * static_cast<double>(stratum_of(x, 250)) + 1) / 500);
}

TEST(LatinHypercube, StrengthTwoFillsEachSquareOfEachPairOnce) {
    for (const std::uint64_t p : {2, 3, 5, 7, 11}) {
        const PointSet set =
            make("latin-hypercube", points(p * p, p + 1), {{"strength", "2"}}, {.seed = p});
        EXPECT_TRUE(has_strength(set, p, 2)) << p;
        EXPECT_TRUE(is_latin(set)) << p;
    }
    const PointSet centered =
        make("latin-hypercube", points(49, 8), {{"strength", "2"}, {"centered", "true"}});
    EXPECT_TRUE(has_strength(centered, 7, 2) && is_latin(centered));
    for (const double x : centered.flat())
        EXPECT_EQ(x, (2 * static_cast<double>(stratum_of(x, 49)) + 1) / 98);
    EXPECT_FALSE(has_strength(make("latin-hypercube", points(49, 8)), 7, 2));
}

// All six permutations of three strata relative to each other; a chi-square with 5 degrees of
// freedom exceeds 36 with probability 1e-6.
TEST(LatinHypercube, EveryPermutationIsEquallyLikely) {
    std::map<std::vector<std::uint64_t>, double> seen;
    for (std::uint64_t seed = 0; seed < 6000; ++seed) {
        const PointSet set = make("latin-hypercube", points(3, 2), {}, {.seed = seed});
        std::vector<std::uint64_t> y(3);
        for (std::size_t i = 0; i < 3; ++i) y[stratum_of(set[i][0], 3)] = stratum_of(set[i][1], 3);
        ++seen[y];
    }
    ASSERT_EQ(seen.size(), 6U);
    double statistic = 0;
    for (const auto& [y, count] : seen) statistic += (count - 1000) * (count - 1000) / 1000;
    EXPECT_LT(statistic, 36);
}

// Coordinates are independent: n^(1/2) times their correlation is nearly normal. 45 pairs within
// 5.5 standard deviations: false alarm 2e-6. The same permutation for all coordinates would give
// 141.
TEST(LatinHypercube, CoordinatesAreNotCorrelated) {
    const PointSet set = make("latin-hypercube", points(20'000, 10), {}, {.seed = 4});
    for (std::size_t a = 0; a < 10; ++a)
        for (std::size_t b = 0; b < a; ++b)
            EXPECT_LT(std::abs(correlation(set, a, b)) * std::sqrt(2e4), 5.5) << a << " " << b;
    EXPECT_NEAR(correlation(set, 3, 3), 1, 1e-3);
}

TEST(LatinHypercube, ReachesToTheLargestCounts) {
    for (const std::uint64_t n : {(std::uint64_t{1} << 53) - 1, std::uint64_t{1} << 53})
        for (const char* centered : {"false", "true"}) {
            const auto sequence =
                sequence_of("latin-hypercube", points(n, 2), {{"centered", centered}});
            for (const std::uint64_t first : {std::uint64_t{0}, n - 300}) {
                const PointSet part = stretch(*sequence, 2, first, 300);
                for (const double x : part.flat()) EXPECT_TRUE(x >= 0 && x < 1);
            }
        }
}

TEST(LatinHypercube, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("latin-hypercube", points(53, 2)));
    EXPECT_TRUE(stretches_agree("latin-hypercube", points(3000, 3)));
    EXPECT_TRUE(stretches_agree("latin-hypercube", points(200, 100), {{"centered", "true"}}));
    EXPECT_TRUE(stretches_agree("latin-hypercube", points(121, 4), {{"strength", "2"}}));
}

TEST(LatinHypercube, RefusesWhatStrengthTwoCannotBe) {
    const auto strong = [](std::uint64_t n, std::size_t d) {
        return error_of([=] { make("latin-hypercube", points(n, d), {{"strength", "2"}}); });
    };
    EXPECT_EQ(strong(100, 2),
              "usage: --count: 100 is not p^2 for a prime p, as latin-hypercube of strength 2 "
              "needs; 49 and 121 are the nearest");
    EXPECT_EQ(strong(1, 2),
              "usage: --count: 1 is not p^2 for a prime p, as latin-hypercube of strength 2 needs; "
              "4 is the least");
    EXPECT_EQ(strong(49, 9),
              "usage: --dimension: 9 is outside [1, 8], the range of 49 points at strength 2; it "
              "needs at least 121 points");
    EXPECT_EQ(strong(49, 8), "");
    EXPECT_EQ(make("latin-hypercube", {.dimension = 2}, {{"strength", "2"}}).count(), 961U);
    EXPECT_EQ(make("latin-hypercube", {.dimension = 50}, {{"strength", "2"}}).count(), 2809U);
}

TEST(LatinHypercube, OptimizedByAnyCriterionIsLatin) {
    for (const char* criterion : criteria)
        for (const char* centered : {"false", "true"}) {
            const PointSet set =
                make("latin-hypercube", points(23, 3),
                     {{"optimize", criterion}, {"effort", "0.001"}, {"centered", centered}});
            EXPECT_TRUE(is_latin(set)) << criterion;
            ASSERT_FALSE(set.provenance.found.empty());
        }
}

TEST(LatinHypercube, SaysWhatItsStrataAreWorth) {
    const auto make_by = [](const char* criterion) {
        return make("latin-hypercube", points(40, 4),
                    {{"optimize", criterion}, {"effort", "0.01"}, {"centered", "true"}});
    };
    const PointSet far = make_by("maximin");
    EXPECT_EQ(said(far), least_square(far));
    EXPECT_GE(said(far), 230);  // random ones have 2 to 60
    const PointSet even = make_by("centered-l2");
    EXPECT_NEAR(said(even), measure("l2-discrepancy", "centered.squared", even), 1e-15);
    EXPECT_NEAR(said(even, 1), measure("l2-discrepancy", "centered.value", even), 1e-15);
    EXPECT_LT(said(even, 1),
              0.7 * measure("l2-discrepancy", "centered.value",
                            make("latin-hypercube", points(40, 4), {{"centered", "true"}})));
    EXPECT_LT(said(make_by("correlation")), 0.002);
}

// Published values for d = 2, 3, 5 and n = 10, 20 (data/latin_hypercubes.md), which short searches
// reach.
TEST(LatinHypercube, FindsPublishedDistances) {
    const auto square = [](std::uint64_t n, std::size_t d, const char* effort) {
        return said(
            make("latin-hypercube", points(n, d), {{"optimize", "maximin"}, {"effort", effort}}));
    };
    EXPECT_EQ(square(10, 2, "0.05"), 10);
    EXPECT_EQ(square(20, 2, "0.05"), 18);
    EXPECT_GE(square(10, 3, "0.1"), 27);
    EXPECT_GE(square(10, 5, "0.1"), 82);
}

TEST(LatinHypercube, SearchesDependOnSeedAndEffortNotOnThreads) {
    for (const char* criterion : criteria) {
        const Settings little{{"optimize", criterion}, {"effort", "0.002"}};
        const PointSet one = make("latin-hypercube", points(30, 3), little, {.threads = 1});
        EXPECT_EQ(one, make("latin-hypercube", points(30, 3), little, {.threads = 3}));
        EXPECT_NE(one, make("latin-hypercube", points(30, 3), little, {.seed = 2}));
    }
}

TEST(LatinHypercube, OnTheLineAndOfOnePointThereIsNothingToOptimize) {
    for (const char* criterion : criteria)
        for (const auto& [n, d] : {std::pair{1, 1}, {1, 3}, {2, 1}, {9, 1}, {2, 2}}) {
            const PointSet set = make("latin-hypercube", points(n, d),
                                      {{"optimize", criterion}, {"effort", "0.01"}});
            EXPECT_TRUE(is_latin(set)) << criterion << " " << n << " " << d;
        }
}

// Every slice is a Latin hypercube of n / K strata, and their union is one of n.
TEST(LatinHypercube, SlicesAreLatinHypercubes) {
    for (const auto& [n, slices] : {std::pair{12, 3}, {12, 12}, {12, 1}, {700, 7}, {1000, 10}})
        for (const char* effort : {"", "0.0005"}) {
            Settings settings{{"sliced", std::to_string(slices)}};
            if (*effort != 0 && n < 500)
                settings.insert(settings.end(), {{"optimize", "phi-p"}, {"effort", effort}});
            const PointSet set = make("latin-hypercube", points(n, 3), settings);
            EXPECT_TRUE(is_latin(set)) << n << " " << slices;
            const std::size_t m = set.count() / static_cast<std::size_t>(slices);
            for (std::size_t s = 0; s < set.count(); s += m)
                EXPECT_TRUE(is_latin(part_of(set, s, s + m))) << n << " " << slices << " " << s;
        }
    EXPECT_FALSE(is_latin(part_of(make("latin-hypercube", points(12, 3)), 0, 6)));
    EXPECT_EQ(make("latin-hypercube", {.dimension = 2}, {{"sliced", "10"}}).count(), 1020U);
    EXPECT_TRUE(stretches_agree("latin-hypercube", points(60, 3), {{"sliced", "5"}}));
}

// By hand: two slices of one point each have two designs per coordinate, with probability 1/2 each;
// 10000 seeds, 5 standard deviations of 50.
TEST(LatinHypercube, SlicesTakeStrataAtRandom) {
    int first = 0;
    for (std::uint64_t seed = 0; seed < 10'000; ++seed)
        first +=
            make("latin-hypercube", points(2, 1), {{"sliced", "2"}}, {.seed = seed})[0][0] < .5;
    EXPECT_NEAR(first, 5000, 250);
}

TEST(LatinHypercube, TheFirstOfNestedPointsAreALatinHypercube) {
    for (const auto& [nested, first] :
         {std::pair{"4,12", 4}, {"1,9", 1}, {"7,7", 7}, {"50,1000", 50}})
        for (const bool searched : {false, true}) {
            Settings settings{{"nested", nested}};
            if (searched)
                settings.insert(settings.end(), {{"optimize", "maximin"}, {"effort", "0.0001"}});
            const PointSet set = make("latin-hypercube", {.dimension = 3}, settings);
            EXPECT_TRUE(is_latin(set)) << nested;
            EXPECT_TRUE(is_latin(part_of(set, 0, static_cast<std::size_t>(first)))) << nested;
        }
    EXPECT_FALSE(is_latin(part_of(make("latin-hypercube", points(12, 3)), 0, 4)));
    EXPECT_TRUE(stretches_agree("latin-hypercube", points(60, 3), {{"nested", "12,60"}}));
}

TEST(LatinHypercube, SearchesOfPartsAreBetterThanNone) {
    for (const Settings& form : {Settings{{"sliced", "4"}}, {{"nested", "8,32"}}}) {
        Settings settings = form;
        settings.emplace_back("optimize", "maximin");
        settings.emplace_back("effort", "0.005");
        EXPECT_GT(said(make("latin-hypercube", points(32, 3), settings)),
                  3 * least_square(make("latin-hypercube", points(32, 3), form)));
    }
}

// Each new point is in a stratum of its own along each coordinate, and the old ones are unchanged.
TEST(LatinHypercube, ExtensionsFillEmptyStrata) {
    for (const auto& [old, more] : {std::pair{10, 20}, {10, 10}, {10, 1}, {1, 5}, {12, 7}})
        for (const char* criterion : {"", "maximin", "centered-l2"}) {
            const PointSet given = make("latin-hypercube", points(old, 3), {}, {.seed = 5});
            const TemporaryFile file(text_of(given), ".csv");
            Settings settings{{"extend", file.path()}, {"add", std::to_string(more)}};
            if (*criterion != 0)
                settings.insert(settings.end(), {{"optimize", criterion}, {"effort", "0.001"}});
            const PointSet set = make("latin-hypercube", {}, settings);
            ASSERT_EQ(set.count(), static_cast<std::size_t>(old + more));
            EXPECT_EQ(part_of(set, 0, given.count()), given);
            EXPECT_TRUE(more % old != 0 || is_latin(set)) << old << " " << more;
            for (std::size_t k = 0; k < 3; ++k) {
                std::map<std::uint64_t, int> held;
                for (std::size_t i = 0; i < set.count(); ++i)
                    ++held[stratum_of(set[i][k], set.count())];
                for (std::size_t i = given.count(); i < set.count(); ++i)
                    EXPECT_EQ(held[stratum_of(set[i][k], set.count())], 1) << old << " " << more;
            }
        }
}

// Coordinates i / n are lower edges of strata, though rounded they may be just below them.
TEST(LatinHypercube, ExtensionsCountRoundedEdgesAsTheStrataAboveThem) {
    const PointSet given = make("rank1-lattice", points(49, 2), {{"vector", "1,3"}});
    const TemporaryFile file(text_of(given), ".csv");
    const PointSet set = make("latin-hypercube", {}, {{"extend", file.path()}, {"add", "49"}});
    for (std::size_t k = 0; k < 2; ++k) {
        std::set<double> strata;
        for (std::size_t i = 0; i < set.count(); ++i)
            strata.insert(stipple::stratum_of(set[i][k], 98));
        EXPECT_EQ(strata.size(), 98U);
    }
}

TEST(LatinHypercube, ExtensionsAreOptimized) {
    const PointSet given =
        make("latin-hypercube", points(10, 2), {{"optimize", "maximin"}, {"effort", "0.01"}});
    const TemporaryFile file(text_of(given), ".csv");
    const Settings plain{{"extend", file.path()}, {"add", "20"}};
    Settings searched = plain;
    searched.insert(searched.end(), {{"optimize", "maximin"}, {"effort", "0.01"}});
    const PointSet set = make("latin-hypercube", {}, searched);
    EXPECT_EQ(said(set), least_square(set));
    EXPECT_GT(said(set), 2 * least_square(make("latin-hypercube", {}, plain)));
}

TEST(LatinHypercube, TellsWhereAnExtensionIsNoLatinHypercube) {
    const TemporaryFile file("0.1,0.1\n0.11,0.9\n0.5,0.5\n", ".csv");
    std::string notes;
    RunContext run;
    run.warn = [&](const std::string& note) { notes += note; };
    make("latin-hypercube", {}, {{"extend", file.path()}, {"add", "2"}}, run);
    EXPECT_EQ(notes,
              "latin-hypercube: all 5 points together are not a Latin hypercube: points of " +
                  file.path() +
                  " share up to 1 of the 5 strata along an axis; new points share none");
}

TEST(LatinHypercube, LevelsSpreadCategories) {
    const PointSet set = make("latin-hypercube", points(12, 2),
                              {{"optimize", "maximin"}, {"effort", "0.01"}, {"levels", "3,0"}});
    EXPECT_TRUE(is_latin(set));
    EXPECT_NE(
        set, make("latin-hypercube", points(12, 2), {{"optimize", "maximin"}, {"effort", "0.01"}}));
}

// Five levels of twelve strata cut some strata, in whose middles the points are.
TEST(LatinHypercube, LevelsAreThoseOfThePoints) {
    const PointSet set = make("latin-hypercube", points(12, 2),
                              {{"optimize", "maximin"}, {"effort", "0.01"}, {"levels", "5,5"}});
    EXPECT_TRUE(is_latin(set));
    constexpr int place[] = {0, 3, 5, 7, 10};  // middles of the levels' strata, rounded down
    int least = 1000;
    for (std::size_t i = 0; i < 12; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            int square = 0;
            for (std::size_t k = 0; k < 2; ++k) {
                const auto level = [k](const auto& point) {
                    return static_cast<int>(5 * point[k]);
                };
                const int gap = place[level(set[i])] - place[level(set[j])];
                square += gap * gap;
            }
            least = std::min(least, square);
        }
    EXPECT_EQ(set.provenance.found.at(0).second, std::to_string(least));
}

// A stop after the first progress report: cancelled, or the best design so far if the run keeps it.
TEST(LatinHypercube, KeepsTheBestWhenItsSearchIsStopped) {
    for (const bool keeps : {false, true}) {
        std::stop_source source;
        RunContext run{.threads = 2, .stop = source.get_token(), .keeps_best = keeps};
        run.progress = [&](double done) {
            if (done > 0) source.request_stop();
        };
        const Settings settings{{"optimize", "maximin"}, {"effort", "20"}};
        if (!keeps) {
            EXPECT_EQ(error_of([&] { make("latin-hypercube", points(40, 3), settings, run); }),
                      "cancelled: interrupted");
            continue;
        }
        const PointSet set = make("latin-hypercube", points(40, 3), settings, run);
        EXPECT_EQ(set.provenance.found.back(),
                  (std::pair<std::string, std::string>("ended", "interrupted")));
        EXPECT_TRUE(is_latin(set));
    }
}

TEST(LatinHypercube, RefusesWhatItCannotMake) {
    const TemporaryFile file("0.1,0.2\n0.7,0.8\n", ".csv");
    const TemporaryFile outside("0.1,1.2\n", ".csv");
    const auto error = [&](const Request& request, const Settings& settings) {
        return error_of([&] { make("latin-hypercube", request, settings); });
    };
    EXPECT_EQ(error({}, {{"levels", "2,2"}}),
              "usage: --levels applies to --optimize only; give that too");
    EXPECT_EQ(error({}, {{"add", "2"}}), "usage: --add applies to --extend only; give that too");
    EXPECT_EQ(error({}, {{"p", "2"}, {"optimize", "maximin"}}),
              "usage: --p applies to --optimize phi-p only; give that too");
    EXPECT_EQ(error({}, {{"sliced", "2"}, {"nested", "2,4"}}),
              "usage: --sliced and --nested contradict each other; give one of them");
    EXPECT_EQ(error({}, {{"strength", "2"}, {"optimize", "maximin"}}),
              "usage: --strength 2 and --optimize contradict each other: exchanging strata would "
              "break the squares");
    EXPECT_EQ(error(points(10, 2), {{"sliced", "3"}}),
              "usage: --count: 10 is not a multiple of 3, as --sliced 3 needs; 9 and 12 are the "
              "nearest");
    EXPECT_EQ(
        error({}, {{"nested", "3,10"}}),
        "usage: --nested: 3,10 is not N1,N2 where N1 divides N2; expected, for example, 10,30");
    EXPECT_EQ(error({}, {{"nested", "2.5,10"}}), "usage: --nested: 2.5 is not a number of points");
    EXPECT_EQ(error(points(10, 2), {{"nested", "4,12"}}),
              "usage: --count: 10 contradicts --nested 4,12, which has 12 points");
    EXPECT_EQ(error(points(10'001, 2), {{"optimize", "maximin"}}),
              "usage: --count: 10001 is outside [1, 10000], the range of --optimize");
    EXPECT_EQ(error(points(20, 101), {{"optimize", "maximin"}}),
              "usage: --dimension: 101 is outside [1, 100], the range of --optimize");
    EXPECT_EQ(error(points(20, 3), {{"optimize", "maximin"}, {"levels", "2,2"}}),
              "usage: --levels: 2 numbers for 3 coordinates; give one for each");
    EXPECT_EQ(error(points(20, 1), {{"optimize", "maximin"}, {"levels", "2.5"}}),
              "usage: --levels: 2.5 is not a whole number in [0, 10000]");
    EXPECT_EQ(error({}, {{"extend", file.path()}}),
              "usage: --extend: the number of new points is missing; give --add");
    EXPECT_EQ(error(points(9, 2), {{"extend", file.path()}, {"add", "3"}}),
              "usage: --count: 9 is not 5, the sum of the 2 points of " + file.path() +
                  " and those of --add");
    EXPECT_EQ(error(points(5, 3), {{"extend", file.path()}, {"add", "3"}}),
              "usage: --dimension: 3, but " + file.path() + " has points of 2 coordinates");
    EXPECT_EQ(
        error({.bounds = Box{{0, 0}, {2, 2}}}, {{"extend", file.path()}, {"add", "3"}}),
        "usage: --bounds: --extend does not scale the given points; scale all points afterwards");
    EXPECT_EQ(error({}, {{"extend", outside.path()}, {"add", "3"}}),
              "input: " + outside.path() +
                  ": point 0 is outside the unit cube; it has a coordinate 1.2 | --extend takes "
                  "designs in [0, 1)");
}

}  // namespace stipple::testing::latin_hypercube_test
