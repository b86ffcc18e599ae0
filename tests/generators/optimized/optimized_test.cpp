// SPDX-License-Identifier: MIT
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stop_token>

#include "support/designs.hpp"
#include "support/temporary_file.hpp"
#include "support/units.hpp"

namespace stipple::testing::optimized_test {
namespace {

double star_of(const PointSet& points) { return measure("star-discrepancy", "value", points); }

double said(const PointSet& points) {
    EXPECT_EQ(points.provenance.found.at(0).first, "star_discrepancy");
    return std::stod(points.provenance.found.at(0).second);
}

/// The points as text of a file.
std::string text_of(const PointSet& points) {
    std::string text;
    for (std::size_t i = 0; i < points.count(); ++i)
        text += fmt::format("{}\n", fmt::join(points[i], ","));
    return text;
}

}  // namespace

// Proven optima: F. Clement, C. Doerr, K. Klamroth, L. Paquete, arXiv:2311.17463, table 1.
TEST(Optimized, FindsTheOptimaThatAreKnown) {
    const double known[] = {.6180, .3660, .2847, .2500, .2000, .1667, .1500, .1328,
                            .1235, .1111, .1030, .0952, .0889, .0837, .0782, .0739};
    for (std::size_t n = 1; n <= 16; ++n) {
        const PointSet points = make("optimized", testing::points(n, 2), {{"effort", "0.4"}});
        EXPECT_NEAR(star_of(points), known[n - 1], 5.1e-5) << n;
        EXPECT_NEAR(star_of(points), said(points), 1e-12) << n;
    }
    EXPECT_NEAR(star_of(make("optimized", testing::points(20, 2))), .0604, 5.1e-5);
}

TEST(Optimized, IsBelowWhatIsPublished) {
    const PointSet points = make("optimized", testing::points(50, 2), {{"effort", "0.1"}});
    EXPECT_LT(star_of(points), 0.0274);  // by message passing (arXiv:2405.15059)
    EXPECT_NEAR(star_of(points), said(points), 1e-12);
}

TEST(Optimized, IsAFunctionOfCountSeedAndEffort) {
    const Settings little{{"effort", "0.01"}};
    const Request request = points(40, 2);
    const PointSet one = make("optimized", request, little, {.threads = 1});
    EXPECT_EQ(one, make("optimized", request, little, {.threads = 3}));
    EXPECT_NE(one, make("optimized", request, little, {.seed = 2}));
    EXPECT_NE(one, make("optimized", request, {{"effort", "0.02"}}));
}

TEST(Optimized, OnTheLineIsTheGridOfMiddles) {
    for (const std::size_t n : {1, 2, 7, 1000}) {
        const PointSet points = make("optimized", testing::points(n, 1));
        EXPECT_NEAR(star_of(points), 0.5 / static_cast<double>(n), 1e-15);
        EXPECT_NEAR(said(points), 0.5 / static_cast<double>(n), 1e-15);
    }
}

struct Judged {
    const char* objective;
    std::size_t dimension;
    const char* found;  ///< option in the provenance
    const char* analyzer;
    const char* key;
    Settings settings;
};

const Judged objectives[] = {
    {"star", 2, "star_discrepancy", "star-discrepancy", "value", {}},
    {"star", 3, "star_discrepancy", "star-discrepancy", "value", {}},
    {"star", 5, "star_discrepancy", "star-discrepancy", "value", {}},
    {"extreme", 2, "extreme_discrepancy", "star-discrepancy", "value", {{"kind", "extreme"}}},
    {"periodic", 2, "periodic_discrepancy", "star-discrepancy", "value", {{"kind", "periodic"}}},
    {"dispersion", 2, "dispersion", "dispersion", "value", {}},
    {"dispersion", 3, "dispersion", "dispersion", "value", {}},
    {"l2-star", 2, "l2_star_discrepancy", "l2-discrepancy", "star.value", {}},
    {"l2-centered", 5, "l2_centered_discrepancy", "l2-discrepancy", "centered.value", {}},
    {"l2-wraparound", 2, "l2_wraparound_discrepancy", "l2-discrepancy", "wraparound.value", {}},
    {"l2-mixture", 3, "l2_mixture_discrepancy", "l2-discrepancy", "mixture.value", {}},
    {"l2-average", 2, "l2_average_discrepancy", "l2-discrepancy", "average.value", {}}};

// A ten-thousandth of the usual steps suffices to be well below Kronecker sets.
TEST(Optimized, SaysWhatTheAnalyzersSayAndIsBelowLatticesAndNets) {
    for (const Judged& one : objectives) {
        const auto judge = [&](const PointSet& set) {
            return measure(one.analyzer, one.key, set, one.settings);
        };
        const PointSet found = make("optimized", points(24, one.dimension),
                                    {{"objective", one.objective}, {"effort", "0.003"}});
        const auto& [name, value] = found.provenance.found.at(0);
        EXPECT_EQ(name, one.found);
        EXPECT_NEAR(judge(found) / std::stod(value), 1, 1e-11) << one.objective;
        const double least = std::min({judge(make("sobol", points(24, one.dimension))),
                                       judge(make("halton", points(24, one.dimension))),
                                       judge(make("kronecker", points(24, one.dimension)))});
        EXPECT_LT(judge(found), 0.9 * least) << one.objective << ", d = " << one.dimension;
    }
}

TEST(Optimized, InSpaceIsBelowWhatIsPublished) {
    // F. Clement et al., arXiv:2311.17463: no set of 8 points has less than 0.1875 (rounded).
    const PointSet few = make("optimized", points(8, 3), {{"effort", "0.03"}});
    EXPECT_LT(star_of(few), 0.189);
    EXPECT_GT(star_of(few), 0.18745);
    EXPECT_LT(star_of(make("optimized", points(32, 3), {{"effort", "0.02"}})), 0.075);
}

TEST(Optimized, DoesNotDependOnThreadsUnderAnyObjective) {
    for (const Judged& one : objectives) {
        const Settings little{{"objective", one.objective}, {"effort", "0.0005"}};
        const PointSet alone = make("optimized", points(20, one.dimension), little, {.threads = 1});
        EXPECT_EQ(alone, make("optimized", points(20, one.dimension), little, {.threads = 3}));
        for (const double x : alone.flat()) EXPECT_TRUE(x >= 0 && x < 1);
    }
}

// More boxes are found than count; which of them do does not depend on who found them.
TEST(Optimized, OfManyPointsInSpaceDoesNotDependOnThreads) {
    const Settings little{{"effort", "1e-4"}};
    EXPECT_EQ(make("optimized", points(600, 3), little, {.threads = 1}),
              make("optimized", points(600, 3), little, {.threads = 3}));
}

TEST(Optimized, OnTheLineIsBestUnderAnyObjective) {
    for (const Judged& one : objectives) {
        const PointSet set = make("optimized", points(7, 1), {{"objective", one.objective}});
        PointSet other = set;
        for (std::size_t i = 0; i < 7; ++i) other[i][0] += i % 2 == 0 ? 1e-3 : -1e-3;
        EXPECT_LT(measure(one.analyzer, one.key, set, one.settings),
                  measure(one.analyzer, one.key, other, one.settings))
            << one.objective;
    }
    EXPECT_NEAR(measure("dispersion", "value",
                        make("optimized", points(7, 1), {{"objective", "dispersion"}})),
                0.125, 1e-15);
}

// x + x^d = 1 by hand: the golden ratio's inverse, and the real root of a cubic.
TEST(Optimized, OfOnePointIsBestUnderAnyObjective) {
    EXPECT_NEAR(star_of(make("optimized", points(1, 2))), 0.6180339887498949, 1e-15);
    EXPECT_NEAR(star_of(make("optimized", points(1, 3))), 0.6823278038280193, 1e-15);
    EXPECT_THAT(make("optimized", points(1, 6)).provenance.found,
                ::testing::Contains(::testing::Pair("certificate", "optimal")));
    for (const Judged& one : objectives) {
        const PointSet set = make("optimized", points(1, one.dimension),
                                  {{"objective", one.objective}, {"effort", "0.1"}});
        const double least = measure(one.analyzer, one.key, set, one.settings);
        for (const std::uint64_t seed : {1, 2, 3}) {
            const PointSet other = make("random", points(1, one.dimension), {}, {.seed = seed});
            EXPECT_LE(least, measure(one.analyzer, one.key, other, one.settings) + 1e-12)
                << one.objective;
        }
    }
}

TEST(Optimized, KeepsTheFirstPointsOfAFile) {
    const PointSet given = make("random", points(10, 2));
    const TemporaryFile file(text_of(given), ".csv");
    for (const char* objective : {"star", "l2-centered", "extreme"}) {
        const PointSet more = make("optimized", points(30, 2),
                                   {{"objective", objective},
                                    {"effort", "0.002"},
                                    {"from", file.path()},
                                    {"keep", "10"},
                                    {"order", "true"}});
        ASSERT_EQ(more.count(), 30U);
        EXPECT_TRUE(std::ranges::equal(more.flat().first(20), given.flat())) << objective;
        EXPECT_LT(star_of(more), 0.6 * star_of(given));
    }
}

TEST(Optimized, GoesOnFromAFileAndFromAGenerator) {
    const PointSet sobol = make("sobol", points(64, 5));
    const TemporaryFile file(text_of(sobol), ".csv");
    const auto of = [](const PointSet& set) {
        return measure("l2-discrepancy", "star.value", set);
    };
    for (const Settings& start :
         {Settings{{"from", file.path()}}, {{"initial", "sobol:scramble=owen"}}}) {
        Settings settings{{"objective", "l2-star"}, {"effort", "0.003"}};
        settings.insert(settings.end(), start.begin(), start.end());
        const PointSet set = make("optimized", points(64, 5), settings);
        EXPECT_LT(of(set), 0.85 * of(sobol));
    }
}

TEST(Optimized, PutsPointsIntoAnOrderOfEvenPrefixes) {
    const Settings settings{{"objective", "l2-centered"}, {"effort", "0.003"}};
    Settings ordered = settings;
    ordered.emplace_back("order", "true");
    const PointSet plain = make("optimized", points(48, 2), settings);
    const PointSet set = make("optimized", points(48, 2), ordered);
    const auto sorted = [](const PointSet& of) {
        std::vector<std::pair<double, double>> rows;
        for (std::size_t i = 0; i < of.count(); ++i) rows.emplace_back(of[i][0], of[i][1]);
        std::ranges::sort(rows);
        return rows;
    };
    EXPECT_EQ(sorted(plain), sorted(set));
    const auto half = [](const PointSet& of) {
        const auto rows = of.flat().first(48);
        return measure("l2-discrepancy", "centered.value",
                       PointSet(std::vector<double>(rows.begin(), rows.end()), 2));
    };
    EXPECT_LT(half(set), 1.2 * half(make("sobol", points(24, 2))));
    EXPECT_LT(half(set), 0.5 * half(plain));
}

TEST(Optimized, WeightsMakeACoordinateMoreEven) {
    const auto first_axis = [](const PointSet& set) {
        std::vector<double> x;
        for (std::size_t i = 0; i < set.count(); ++i) x.push_back(set[i][0]);
        return measure("l2-discrepancy", "star.value", PointSet(std::move(x), 1));
    };
    for (const char* objective : {"star", "l2-star"}) {
        const Settings even{{"objective", objective}, {"effort", "0.005"}, {"weights", "1,1"}};
        const Settings first{{"objective", objective}, {"effort", "0.005"}, {"weights", "1,0.02"}};
        EXPECT_LT(first_axis(make("optimized", points(30, 2), first)),
                  0.98 * first_axis(make("optimized", points(30, 2), even)))
            << objective;
    }
}

/// Discrepancy over all boxes that end at coordinates, just below 1 with the axis' weight, or at 1
/// without it.
double weighted_star(const PointSet& set, const std::vector<double>& weights) {
    const auto n = static_cast<double>(set.count());
    const auto worst_from = [&](auto self, std::size_t axis, std::vector<double> corner,
                                double weight) -> double {
        if (axis == weights.size()) {
            double volume = 1;
            double inside = 0;
            double within = 0;
            for (const double end : corner) volume *= end;
            for (std::size_t i = 0; i < set.count(); ++i) {
                inside += std::ranges::equal(set[i], corner, std::less());
                within += std::ranges::equal(set[i], corner, std::less_equal());
            }
            return weight * std::max(volume - inside / n, within / n - volume);
        }
        corner.push_back(1);
        double worst = self(self, axis + 1, corner, weight);
        worst = std::max(worst, self(self, axis + 1, corner, weight * weights[axis]));
        for (std::size_t i = 0; i < set.count(); ++i) {
            corner.back() = set[i][axis];
            worst = std::max(worst, self(self, axis + 1, corner, weight * weights[axis]));
        }
        return worst;
    };
    return worst_from(worst_from, 0, {}, 1);
}

TEST(Optimized, ReportsTheWeightedDiscrepancyToTheLastDigits) {
    const std::vector<std::vector<double>> all = {{2},         {0.25},    {1, 0.3},
                                                  {1.5, 0.3},  {3, 7},    {0.1, 0.2},
                                                  {2, 1, 0.5}, {4, 2, 3}, {2, 1, .5, .3}};
    for (const std::vector<double>& weights : all) {
        const PointSet set =
            make("optimized", points(7, weights.size()),
                 {{"effort", "0.00001"}, {"weights", format_value(Value(weights))}});
        EXPECT_DOUBLE_EQ(std::stod(found_in(set, "star_discrepancy")), weighted_star(set, weights))
            << format_value(Value(weights));
    }
}

// Best of all lattices of the plane, measured by the analyzer.
TEST(Optimized, FindsTheLatticeOfLeastPeriodicDiscrepancy) {
    const auto value_of = [](const PointSet& set) {
        return measure("star-discrepancy", "value", set, {{"kind", "periodic"}});
    };
    for (const std::size_t n : {2, 3, 7, 21, 32}) {
        double least = 1;
        for (std::size_t g = 1; g <= n; ++g)
            least = std::min(least, value_of(make("rank1-lattice", points(n, 2),
                                                  {{"vector", "1," + std::to_string(g)}})));
        const PointSet found =
            make("optimized", points(n, 2), {{"objective", "periodic"}, {"lattice", "true"}});
        EXPECT_EQ(value_of(found), least) << n;
        for (const double x : found.flat())
            EXPECT_EQ(x * static_cast<double>(n), std::round(x * static_cast<double>(n)));
    }
}

TEST(Optimized, FindsTheLatticeOfLeastWraparoundDiscrepancyInSpace) {
    const auto value_of = [](const PointSet& set) {
        return measure("l2-discrepancy", "wraparound.value", set);
    };
    double least = 1;
    for (int g = 1; g < 31; ++g)
        least = std::min(least,
                         value_of(make("rank1-lattice", points(31, 3),
                                       {{"rule", "korobov"}, {"multiplier", std::to_string(g)}})));
    const PointSet found =
        make("optimized", points(31, 3), {{"objective", "l2-wraparound"}, {"lattice", "true"}});
    EXPECT_NEAR(value_of(found), least, 1e-12);
}

TEST(Optimized, TellsWhatIsPublishedAndWhatIsCertain) {
    const auto entries = [](const PointSet& set) {
        std::map<std::string, std::string> all(set.provenance.found.begin(),
                                               set.provenance.found.end());
        return all;
    };
    auto few = entries(make("optimized", points(6, 2)));
    EXPECT_EQ(few["certificate"], "optimal");
    EXPECT_EQ(few["published"], "0.1667");
    auto more = entries(make("optimized", points(50, 2), {{"effort", "0.001"}}));
    EXPECT_EQ(more["certificate"], "optimal-for-its-order");
    EXPECT_EQ(more["published"], "0.027415");
    EXPECT_EQ(entries(make("optimized", points(50, 3), {{"effort", "0.001"}})).size(), 1U);
}

// A stop after the first progress report: cancelled, or the best set so far if the run keeps it.
TEST(Optimized, KeepsTheBestWhenItIsStopped) {
    for (const Judged& one : {objectives[0], objectives[1], objectives[7]})
        for (const bool keeps : {false, true}) {
            std::stop_source source;
            RunContext run{.threads = 2, .stop = source.get_token(), .keeps_best = keeps};
            run.progress = [&](double done) {
                if (done > 0) source.request_stop();
            };
            const Request request = points(24, one.dimension);
            const Settings settings{{"objective", one.objective}, {"effort", "20"}};
            if (!keeps) {
                EXPECT_EQ(error_of([&] { make("optimized", request, settings, run); }),
                          "cancelled: interrupted");
                continue;
            }
            const PointSet set = make("optimized", request, settings, run);
            EXPECT_EQ(set.provenance.found.back(),
                      (std::pair<std::string, std::string>("ended", "interrupted")));
            EXPECT_LT(star_of(set), 0.3);
        }
}

TEST(Optimized, CertifiesNoLatticeUnlessAllWereTried) {
    std::stop_source source;
    RunContext run{.threads = 1, .stop = source.get_token(), .keeps_best = true};
    run.progress = [&](double done) {
        if (done > 0) source.request_stop();
    };
    const PointSet set = make("optimized", points(400, 2),
                              {{"objective", "l2-wraparound"}, {"lattice", "true"}}, run);
    ASSERT_EQ(set.provenance.found.size(), 2U);
    EXPECT_EQ(set.provenance.found[0].first, "l2_wraparound_discrepancy");
    EXPECT_EQ(set.provenance.found[1].second, "interrupted");
}

// On a line the optimal points are known, for as many as fit into memory.
TEST(Optimized, AsksForTheMemoryOfItsPoints) {
    EXPECT_TRUE(error_of([&] {
                    make("optimized", points(std::uint64_t{1} << 31, 1), {},
                         {.max_memory = 300'000'000});
                }).starts_with("limit: the point set needs 16 GiB"));
}

// A stop before the first result leaves nothing to keep.
TEST(Optimized, IsCancelledWhereAStopComesBeforeTheFirstSet) {
    std::stop_source source;
    source.request_stop();
    const RunContext run{.threads = 2, .stop = source.get_token(), .keeps_best = true};
    for (const Judged& one : objectives)
        EXPECT_EQ(
            error_of([&] {
                make("optimized", points(24, one.dimension), {{"objective", one.objective}}, run);
            }),
            "cancelled: interrupted")
            << one.objective;
}

TEST(Optimized, RefusesWhatItCannotMake) {
    const TemporaryFile file(text_of(make("random", points(10, 2))), ".csv");
    const TemporaryFile wide("0,2\n0,0\n", ".csv");
    const auto error = [&](const Request& request, const Settings& settings) {
        return error_of([&] { make("optimized", request, settings); });
    };
    const std::string& ten = file.path();
    EXPECT_EQ(error(points(64, 7), {}),
              "usage: optimized: objective star takes 1 to 6 dimensions; L2 kinds take more");
    EXPECT_EQ(error(points(64, 2), {{"keep", "3"}}),
              "usage: --keep applies to the points of a file; give --from too");
    EXPECT_EQ(error(points(64, 2), {{"from", ten}, {"keep", "11"}}),
              "usage: --keep: 11 is more than the 10 points of " + ten);
    EXPECT_EQ(error(points(9, 2), {{"from", ten}}),
              "usage: --count: 9 is less than the 10 points of " + ten);
    EXPECT_THAT(error(points(9, 3), {{"from", ten}}), ::testing::HasSubstr("points of 2 coord"));
    EXPECT_THAT(error(points(9, 2), {{"from", wide.path()}}),
                ::testing::HasSubstr("outside the unit cube"));
    EXPECT_EQ(error(points(9, 2), {{"weights", "1,2,3"}}),
              "usage: --weights: 3 numbers for 2 coordinates; give one for each");
    EXPECT_THAT(error(points(9, 2), {{"weights", "1,0"}}),
                ::testing::HasSubstr("0 is outside [1e-30, 1000]"));
    EXPECT_THAT(error(points(9, 2), {{"weights", "1e-31,1"}}), ::testing::HasSubstr("[1e-30, "));
    EXPECT_EQ(error(points(3, 2), {{"weights", "1e-30,1e-30"}, {"effort", "1e-6"}}), "");
    EXPECT_THAT(error(points(9, 2), {{"weights", "1,2"}, {"objective", "dispersion"}}),
                ::testing::HasSubstr("objective dispersion takes no weights"));
    EXPECT_THAT(error(points(9, 2), {{"lattice", "true"}}),
                ::testing::HasSubstr("objective star depends on a shift of the lattice"));
    EXPECT_THAT(
        error(points(10, 2), {{"objective", "periodic"}, {"lattice", "true"}, {"from", ten}}),
        ::testing::HasSubstr("no points to start from"));
    EXPECT_EQ(error(points(100'000, 2), {{"objective", "l2-star"}}),
              "limit: optimized: 100000 points; a search over coordinates takes up to 65536");
    EXPECT_THAT(
        error_of([] { make("optimized", points(20'000, 2), {}, {.max_memory = 1U << 30}); }),
        ::testing::HasSubstr("the search for an order needs"));
}

}  // namespace stipple::testing::optimized_test
