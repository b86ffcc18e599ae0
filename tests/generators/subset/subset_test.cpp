// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <map>
#include <set>
#include <stop_token>
#include <thread>

#include "core/rng.hpp"
#include "core/text.hpp"
#include "math/functions/normal_distribution.hpp"
#include "support/temporary_file.hpp"
#include "support/units.hpp"

namespace stipple::testing::subset_test {
namespace {

constexpr const char* unit = "subset";

/// The points as text, one per line, which reads back to the same numbers.
std::string text_of(const PointSet& set) {
    std::string text;
    for (std::size_t i = 0; i < set.count(); ++i)
        for (std::size_t k = 0; k < set.dimension(); ++k)
            text += format_number(set[i][k]) + (k + 1 < set.dimension() ? " " : "\n");
    return text;
}

PointSet choice_of(const PointSet& set, const std::vector<std::size_t>& rows) {
    PointSet chosen(rows.size(), set.dimension());
    for (std::size_t s = 0; s < rows.size(); ++s)
        std::ranges::copy(set[rows[s]], chosen[s].begin());
    return chosen;
}

/// Value of a measure, by its analyzer.
double value_of(const std::string& by, const PointSet& set) {
    if (by == "star") return measure("star-discrepancy", "value", set);
    if (by.starts_with("l2-"))
        return measure("l2-discrepancy", by.substr(3) + ".squared", set, {{"kind", by.substr(3)}});
    return measure("kernel-discrepancy", "squared", set, {{"kernel", by}});
}

constexpr const char* measures[] = {"star",       "l2-star",    "l2-centered", "l2-wraparound",
                                    "l2-mixture", "l2-average", "periodic",    "gaussian",
                                    "matern",     "stein"};

/// Calls `look` for all choices of n rows.
void for_choices(std::size_t all, std::size_t n,
                 const std::function<void(const std::vector<std::size_t>&)>& look) {
    std::vector<bool> in(all, false);
    std::fill_n(in.begin(), n, true);
    do {
        std::vector<std::size_t> rows;
        for (std::size_t i = 0; i < all; ++i)
            if (in[i]) rows.push_back(i);
        look(rows);
    } while (std::prev_permutation(in.begin(), in.end()));
}

double found_value(const PointSet& set, std::string_view name) {
    for (const auto& [key, text] : set.provenance.found)
        if (key == name) return parse_number(text).value();
    return -1;
}

/// Points of the standard normal distribution with their scores.
PointSet normal_rows(std::size_t n, std::size_t d, std::uint64_t seed) {
    PointSet rows(n, 2 * d);
    const PointSet uniform = make("random", points(n, d), {}, {.seed = seed});
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < d; ++k) {
            rows[i][k] = bounded_normal_quantile(uniform[i][k]);
            rows[i][d + k] = -rows[i][k];
        }
    return rows;
}

/// Whether the rows of `part` are rows of `whole`, in the same order.
bool is_part(const PointSet& part, const PointSet& whole) {
    std::size_t at = 0;
    for (std::size_t i = 0; i < whole.count() && at < part.count(); ++i)
        if (std::ranges::equal(whole[i], part[at])) ++at;
    return at == part.count();
}

}  // namespace

// Oracle: all 330 or 462 subsets, each by the analyzer.
TEST(Subset, FindsTheBestOfAllSubsetsOfFewPoints) {
    for (const std::string by : measures)
        for (const std::size_t d : {1, 2, 3}) {
            const std::size_t n = 3 + d % 2;
            const PointSet all = by == "stein" ? normal_rows(11, d, 4)
                                               : make("random", points(11, d), {}, {.seed = d});
            double least = 1e300;
            for_choices(11, n, [&](const std::vector<std::size_t>& rows) {
                least = std::min(least, value_of(by, choice_of(all, rows)));
            });
            const TemporaryFile file(text_of(all));
            const PointSet found = make(unit, {.count = n}, {{"from", file.path()}, {"by", by}});
            EXPECT_NEAR(value_of(by, found), least, 1e-9 * least) << by << ", d = " << d;
            EXPECT_TRUE(is_part(found, all)) << by;
        }
}

TEST(Subset, TellsTheValueThatTheAnalyzerFinds) {
    for (const std::string by : measures) {
        const PointSet all =
            by == "stein" ? normal_rows(200, 2, 1) : make("random", points(200, 2));
        const TemporaryFile file(text_of(all));
        const PointSet found =
            make(unit, {.count = 20}, {{"from", file.path()}, {"by", by}, {"effort", "0.01"}});
        const double told = found_value(found, by == "star" ? "star_discrepancy" : "squared");
        EXPECT_NEAR(told, value_of(by, found), 1e-9 * told) << by;
        // Far below the value of the first 20 points.
        std::vector<std::size_t> first(20);
        for (std::size_t i = 0; i < 20; ++i) first[i] = i;
        EXPECT_LT(told, 0.5 * value_of(by, choice_of(all, first))) << by;
    }
}

// With a long scale, terms of about 1 cancel to less than their rounding errors.
TEST(Subset, BoundsValuesThatCancel) {
    const TemporaryFile file(text_of(make("random", points(30, 2))));
    for (const std::string by : {"gaussian", "matern"}) {
        const PointSet set =
            make(unit, {.count = 5}, {{"from", file.path()}, {"by", by}, {"bandwidth", "1e100"}});
        EXPECT_EQ(found_value(set, "squared_lower"), 0) << by;
        EXPECT_GT(found_value(set, "squared_upper"), 0) << by;
        EXPECT_LT(found_value(set, "squared_upper"), 1e-12) << by;
    }
}

// Oracle: each prefix is extended by the point that l2-discrepancy rates best.
TEST(Subset, WithoutEffortChoosesGreedily) {
    const PointSet all = make("random", points(60, 2), {}, {.seed = 3});
    const TemporaryFile file(text_of(all));
    for (const std::string by : {"l2-centered", "l2-star", "periodic"}) {
        std::vector<std::size_t> rows;
        while (rows.size() < 7) {
            double least = 1e300;
            std::size_t best = 0;
            for (std::size_t i = 0; i < all.count(); ++i) {
                if (std::ranges::find(rows, i) != rows.end()) continue;
                std::vector<std::size_t> more = rows;
                more.push_back(i);
                const double value = value_of(by, choice_of(all, more));
                // By the periodic kernel single points are equal: then the first.
                if (value < least * (1 - 1e-12)) least = value, best = i;
            }
            rows.push_back(best);
        }
        std::ranges::sort(rows);
        EXPECT_EQ(make(unit, {.count = 7}, {{"from", file.path()}, {"by", by}, {"effort", "1e-6"}}),
                  choice_of(all, rows))
            << by;
    }
}

// A small version of choosing 512 of 2^18. The mean of random points is (1 + pi^2/3)^2 - 1 = 17.4
// over n.
TEST(Subset, IsFarMoreEvenThanRandomPoints) {
    const PointSet found = make(unit, points(64, 2), {{"candidates", "8192"}, {"effort", "0.1"}});
    EXPECT_LT(value_of("periodic", found), 0.037);
    EXPECT_GT(value_of("periodic", make("random", points(64, 2))), 0.15);
}

// Clement, Doerr and Paquete: subsets of Sobol' points in six dimensions are better than the first
// points.
TEST(Subset, HasASmallerStarDiscrepancyThanSobolPoints) {
    const PointSet found =
        make(unit, points(40, 6),
             {{"of", "sobol"}, {"candidates", "512"}, {"by", "star"}, {"effort", "0.03"}});
    const double told = found_value(found, "star_discrepancy");
    EXPECT_EQ(told, value_of("star", found));
    EXPECT_LT(told, 0.75 * value_of("star", make("sobol", points(40, 6))));
    EXPECT_TRUE(is_part(found, make("sobol", points(512, 6))));
}

TEST(Subset, MoreEffortIsNoWorse) {
    for (const std::string by : {"star", "l2-mixture", "matern"}) {
        const auto value = [&](const char* effort) {
            return value_of(by, make(unit, points(12, 3), {{"by", by}, {"effort", effort}}));
        };
        EXPECT_LE(value("0.05"), value("0.001")) << by;
        EXPECT_LE(value("0.001"), value("1e-6")) << by;
    }
}

TEST(Subset, TakesAllOneOrDuplicates) {
    const PointSet all = make("random", points(30, 2));
    const TemporaryFile file(text_of(all));
    const TemporaryFile equal("0.5 0.25\n0.5 0.25\n0.5 0.25\n1 0\n");
    for (const std::string by : measures) {
        if (by == "stein") continue;
        EXPECT_EQ(make(unit, {.count = 30}, {{"from", file.path()}, {"by", by}}), all) << by;
        double least = 1e300;
        for (std::size_t i = 0; i < 30; ++i)
            least = std::min(least, value_of(by, choice_of(all, {i})));
        EXPECT_NEAR(value_of(by, make(unit, {.count = 1}, {{"from", file.path()}, {"by", by}})),
                    least, 1e-12)
            << by;
        const PointSet two = make(unit, {.count = 3}, {{"from", equal.path()}, {"by", by}});
        EXPECT_EQ(two.count(), 3U);
        EXPECT_TRUE(is_part(two, points_of({{0.5, 0.25}, {0.5, 0.25}, {0.5, 0.25}, {1, 0}})));
    }
    EXPECT_EQ(make(unit, {}, {{"from", file.path()}, {"effort", "0.01"}}).count(), 1U);
}

TEST(Subset, IsTheSameForAnyThreads) {
    for (const std::string by : {"star", "periodic"})
        for (const char* split : {"1", "3"}) {
            const Settings settings = {{"by", by},
                                       {"candidates", split == std::string("1") ? "3000" : "60"},
                                       {"split", split},
                                       {"effort", "0.002"}};
            const Request request = points(60, 3);
            const PointSet one = make(unit, request, settings, Seeded{.threads = 1});
            EXPECT_EQ(one, make(unit, request, settings, Seeded{.threads = 4})) << by << split;
        }
}

TEST(Subset, SplitPartsAllPointsIntoSetsThatAreEvenAlike) {
    const PointSet all = make("random", points(240, 2), {}, {.seed = 6});
    const TemporaryFile file(text_of(all));
    for (const std::string by : measures) {
        if (by == "stein") continue;
        for (const std::size_t sets : {2, 5, 240}) {
            const PointSet parted = make(unit, {},
                                         {{"from", file.path()},
                                          {"by", by},
                                          {"split", std::to_string(sets)},
                                          {"effort", "0.01"}});
            const auto sorted = [](const PointSet& set) {
                std::multiset<std::vector<double>> rows;
                for (std::size_t i = 0; i < set.count(); ++i)
                    rows.emplace(set[i].begin(), set[i].end());
                return rows;
            };
            EXPECT_EQ(sorted(parted), sorted(all)) << by << ", " << sets;
            if (sets == 240) continue;
            const std::size_t n = 240 / sets;
            double most = 0;
            double least = 1e300;
            double random = 0;
            for (std::size_t s = 0; s < sets; ++s) {
                std::vector<std::size_t> rows(n);
                for (std::size_t i = 0; i < n; ++i) rows[i] = s * n + i;
                const PointSet part = choice_of(parted, rows);
                EXPECT_TRUE(is_part(part, all));
                most = std::max(most, value_of(by, part));
                least = std::min(least, value_of(by, part));
                random = std::max(random, value_of(by, choice_of(all, rows)));
            }
            const bool star = by == "star";
            EXPECT_NEAR(found_value(parted, star ? "star_discrepancy" : "squared"), most,
                        1e-9 * most);
            EXPECT_NEAR(found_value(parted, "smallest"), least, 1e-9 * most);
            EXPECT_LT(most, (star ? 0.8 : 0.7) * random) << by << ", " << sets;
        }
    }
}

// Two sets of three points: all ten splits.
TEST(Subset, SplitFindsTheBestHalves) {
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
        const PointSet all = make("random", points(6, 2), {}, {.seed = seed});
        const TemporaryFile file(text_of(all));
        const auto sum = [](const PointSet& set) {
            return value_of("l2-star", choice_of(set, {0, 1, 2})) +
                   value_of("l2-star", choice_of(set, {3, 4, 5}));
        };
        std::vector<double> sums;
        for_choices(6, 3, [&](std::vector<std::size_t> rows) {
            for (std::size_t i = 0; i < 6; ++i)
                if (std::ranges::find(rows, i) == rows.end()) rows.push_back(i);
            sums.push_back(sum(choice_of(all, rows)));
        });
        const PointSet parted =
            make(unit, {}, {{"from", file.path()}, {"by", "l2-star"}, {"split", "2"}});
        std::ranges::sort(sums);  // each occurs twice; exchanges end at a local optimum
        EXPECT_LE(sum(parted), sums[3] * (1 + 1e-12)) << seed;
    }
}

TEST(Subset, RefusesWhatCannotBeChosenAndSaysWhy) {
    const PointSet all = make("random", points(30, 3));
    const TemporaryFile file(text_of(all));
    const TemporaryFile beyond("0.5 0.5\n1.5 0\n");
    const TemporaryFile empty("");
    const auto refusal = [&](const Request& request, Settings settings) {
        std::string text = error_of([&] { make(unit, request, settings); });
        replace_all(text, file.path(), "FILE");
        replace_all(text, beyond.path(), "BEYOND");
        return text;
    };
    const std::string& path = file.path();
    EXPECT_EQ(refusal({.count = 31}, {{"from", path}}),
              "usage: --count: 31 points cannot be chosen from the 30 in FILE");
    EXPECT_EQ(refusal({.count = 31}, {{"candidates", "30"}}),
              "usage: --count: 31 points cannot be chosen from 30 candidates");
    EXPECT_EQ(refusal({.dimension = 2}, {{"from", path}}),
              "usage: --dimension: 2, but FILE has rows of 3 numbers");
    EXPECT_EQ(refusal({}, {{"from", path}, {"split", "4"}}),
              "usage: --split: the 30 points of FILE cannot be split into 4 sets of equal size");
    EXPECT_EQ(refusal({.count = 10}, {{"from", path}, {"split", "3"}}),
              "usage: --count: 10, but --split writes all 30 points of FILE; leave --count out");
    EXPECT_EQ(refusal({.count = 31}, {{"split", "3"}}),
              "usage: --split: the 31 points cannot be split into 3 sets of equal size");
    EXPECT_EQ(refusal({}, {{"from", path}, {"of", "sobol"}}),
              "usage: --from contradicts --of; give one of them");
    EXPECT_EQ(
        refusal({}, {{"from", path}, {"candidates", "9"}}),
        "usage: --candidates applies to --of only; --from chooses from all points of the file");
    EXPECT_EQ(refusal({}, {{"by", "stein"}}),
              "usage: --by stein needs rows with scores; give their file by --from");
    EXPECT_EQ(refusal({}, {{"by", "stein"}, {"from", path}}),
              "input: FILE: rows of 3 numbers; --by stein takes d coordinates and d scores");
    EXPECT_EQ(
        refusal({}, {{"bandwidth", "1"}}),
        "usage: --bandwidth: periodic has no length scale; gaussian, matern and stein have one");
    EXPECT_EQ(refusal({}, {{"smoothness", "0.5"}}),
              "usage: --smoothness applies to --by matern only; --by is periodic");
    EXPECT_EQ(refusal({.count = 1}, {{"from", beyond.path()}}),
              "input: BEYOND: point 1 is outside the unit cube; it has a coordinate 1.5 | --by "
              "stein takes points outside the cube");
    const TemporaryFile distant("1e160 1\n-1e160 2\n0 1\n");
    EXPECT_EQ(refusal({.count = 2}, {{"from", distant.path()}, {"by", "stein"}}),
              "input: the points are too far apart for the kernel stein in float64, with "
              "--bandwidth 1");
    EXPECT_TRUE(refusal({}, {{"of", "sobl"}}).starts_with("usage: "));
    EXPECT_TRUE(refusal({}, {{"from", empty.path()}}).starts_with("input: "));
    EXPECT_TRUE(refusal({}, {{"from", "nowhere.csv"}}).starts_with("io: "));
    EXPECT_TRUE(refusal({.bounds = Box{{0, 0}, {2, 2}}}, {}).starts_with("usage: --bounds: "));
}

// A first round of swaps needs n^2 kernel values, here a second or more.
TEST(Subset, StopsAtOnceInARoundOfTrades) {
    std::stop_source source;
    const RunContext run{.threads = 1, .stop = source.get_token()};
    std::jthread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        source.request_stop();
    });
    const std::clock_t begin = std::clock();
    EXPECT_EQ(error_of([&] {
                  make(unit, points(60'000, 6), {{"split", "2"}}, run);
              }),
              "cancelled: interrupted");
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 0.5);
}

// Searches that would take hours; --split by a kernel ends after a few rounds.
TEST(Subset, StopsWhileItSearches) {
    const std::pair<const char*, const char*> searches[] = {
        {"star", "1"}, {"star", "2"}, {"periodic", "1"}};
    for (const auto& [by, split] : searches) {
        std::stop_source source;
        RunContext run{.threads = 2, .stop = source.get_token()};
        int reports = 0;
        std::string words;
        const bool star = by == std::string("star");
        const char* expected = !star           ? "squared "
                               : *split == '1' ? "star discrepancy 0."
                                               : "largest star discrepancy 0.";
        run.progress = [&](double) {
            if (++reports > 4 && words.starts_with(expected)) source.request_stop();
        };
        run.note = [&](const std::string& note) { words = note; };
        const Settings settings = {{"by", by}, {"split", split}, {"effort", "1e5"}};
        EXPECT_EQ(error_of([&] { make(unit, points(100, 4), settings, run); }),
                  "cancelled: interrupted")
            << by;
        EXPECT_GT(reports, 4);
    }
}

}  // namespace stipple::testing::subset_test
