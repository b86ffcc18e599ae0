// SPDX-License-Identifier: MIT
#include "experiments/parameters/reordering.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/parameters/copula.hpp"
#include "math/distributions/laws.hpp"
#include "pipeline/chain.hpp"
#include "support/units.hpp"

namespace stipple::testing::reordering_test {
namespace {

using parameters::Reordering;
using parameters::score_correlation;
using ::testing::HasSubstr;

std::vector<double> reordered(std::vector<double> rows, const std::vector<double>& spearman,
                              const RunContext& run = {}) {
    const auto d = static_cast<std::size_t>(std::lround(std::sqrt(spearman.size())));
    std::vector<double> scores;
    for (const double r : spearman) scores.push_back(r == 1 ? 1 : score_correlation(r));
    std::vector<std::string> names;
    for (std::size_t k = 0; k < d; ++k) names.emplace_back(1, static_cast<char>('a' + k));
    Reordering{spearman, scores, names, std::vector<MarginalPtr>(d)}.apply(rows, run);
    return rows;
}

std::vector<double> column(const std::vector<double>& rows, std::size_t k, std::size_t d) {
    std::vector<double> numbers;
    for (std::size_t i = k; i < rows.size(); i += d) numbers.push_back(rows[i]);
    return numbers;
}

std::vector<double> sorted(std::vector<double> numbers) {
    std::ranges::sort(numbers);
    return numbers;
}

/// 1 - 6 sum of squared rank differences / (n^3 - n), without ties.
double spearman(const std::vector<double>& rows, std::size_t a, std::size_t b, std::size_t d) {
    const auto x = column(rows, a, d);
    const auto y = column(rows, b, d);
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const auto rank = [i](const std::vector<double>& numbers) {
            return std::ranges::count_if(numbers, [&](double other) { return other < numbers[i]; });
        };
        const auto apart = static_cast<double>(rank(x) - rank(y));
        sum += apart * apart;
    }
    const auto n = static_cast<double>(x.size());
    return 1 - 6 * sum / (n * n * n - n);
}

const std::vector<double> asked = {1, 0.7, 0, 0.7, 1, -0.4, 0, -0.4, 1};

/// Largest deviation from the requested correlations.
double worst(const std::vector<double>& rows) {
    return std::max({std::abs(spearman(rows, 0, 1, 3) - 0.7), std::abs(spearman(rows, 0, 2, 3)),
                     std::abs(spearman(rows, 1, 2, 3) + 0.4)});
}

std::vector<double> numbers_of(const PointSet& points) {
    return {points.flat().begin(), points.flat().end()};
}

}  // namespace

// Three points have a rank correlation of -1, -1/2, 1/2 or 1; 1 is nearest to 0.9.
TEST(Reordering, OfThreePointsByHand) {
    const std::vector<double> rows = {0.1, 0.2, 0.5, 0.9, 0.7, 0.4};
    EXPECT_EQ(reordered(rows, {1, 0.9, 0.9, 1}),
              (std::vector<double>{0.1, 0.2, 0.5, 0.4, 0.7, 0.9}));
    EXPECT_EQ(reordered(rows, {1, -0.9, -0.9, 1}),
              (std::vector<double>{0.1, 0.9, 0.5, 0.4, 0.7, 0.2}));
    EXPECT_EQ(reordered(rows, {1, 0.5, 0.5, 1}), rows);  // unchanged
}

TEST(Reordering, OfOneParameterChangesNothing) {
    for (const std::vector<double>& one : {std::vector<double>{0.3}, {0.9, 0.3}, {0.5, 0.5, 0.1}})
        EXPECT_EQ(reordered(one, {1}), one);
}

// Computed by the same formulas in NumPy, with SciPy's normal quantiles.
TEST(Reordering, IsThatOfAnotherProgram) {
    EXPECT_EQ(
        reordered({0.1, 0.8, 0.35, 0.9, 0.2, 0.6, 0.5, 0.55, 0.05, 0.3, 0.95, 0.9,
                   0.7, 0.4, 0.75, 0.2, 0.1, 0.5, 0.6, 0.65, 0.25, 0.4, 0.3,  0.15},
                  asked),
        (std::vector<double>{0.1, 0.2,  0.25, 0.9, 0.55, 0.75, 0.5, 0.4,  0.05, 0.3, 0.8, 0.35,
                             0.7, 0.65, 0.6,  0.2, 0.1,  0.9,  0.6, 0.95, 0.15, 0.4, 0.3, 0.5}));
}

TEST(Reordering, KeepsALatinHypercube) {
    for (const std::size_t n : {20, 100, 1000})
        for (const bool centered : {false, true}) {
            const auto rows = numbers_of(
                make("latin-hypercube", points(n, 3), {{"centered", centered ? "true" : "false"}}));
            const auto made = reordered(rows, asked);
            EXPECT_EQ(column(made, 0, 3), column(rows, 0, 3));
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_EQ(sorted(column(made, k, 3)), sorted(column(rows, k, 3))) << n;
                std::set<double> strata;
                for (const double x : column(made, k, 3))
                    strata.insert(std::floor(x * static_cast<double>(n)));
                EXPECT_EQ(strata.size(), n);
            }
            EXPECT_NE(made, rows);
        }
}

// For 40 Latin hypercubes in NumPy, the largest errors were 0.084, 0.012 and 0.00008; the copula's
// mean errors with random points are 0.21, 0.10 and 0.028.
TEST(Reordering, GivesTheRankCorrelationsThatAreAskedFor) {
    const std::pair<std::size_t, double> cases[] = {{20, 0.1}, {100, 0.015}, {1000, 1.5e-4}};
    for (const auto& [n, tolerance] : cases) {
        double by_copula = 0;
        double by_order = 0;
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            const auto set = [seed, count = n](const char* generator) {
                return numbers_of(make(generator, points(count, 3), {}, {.seed = seed}));
            };
            const auto design = reordered(set("latin-hypercube"), asked);
            EXPECT_LT(worst(design), tolerance) << n << " points, seed " << seed;

            auto rows = set("random");
            by_order += worst(reordered(rows, asked));
            std::vector<double> scores;
            for (const double r : asked) scores.push_back(r == 1 ? 1 : score_correlation(r));
            const parameters::Copula copula(scores, {});
            for (std::size_t i = 0; i < n; ++i) {
                std::vector<parameters::Share> shares;
                for (std::size_t k = 0; k < 3; ++k)
                    shares.push_back({rows[3 * i + k], 1 - rows[3 * i + k]});
                copula.forward(shares);
                for (std::size_t k = 0; k < 3; ++k) rows[3 * i + k] = shares[k].below;
            }
            by_copula += worst(rows);
        }
        EXPECT_LT(4 * by_order, by_copula) << n;
    }
}

// Tied values have the mean of their ranks: half of (number below + number not above).
TEST(Reordering, ReachesTheRankCorrelationsOfWhatIsEqual) {
    constexpr std::size_t n = 1000;
    const std::vector<MarginalPtr> laws = {integers_law(1, 8), empirical_law({0, 0, 0, 1, 1, 2}),
                                           empirical_law({0, 1})};
    std::vector<double> rows = numbers_of(make("latin-hypercube", points(n, 3)));
    std::vector<double> scores;
    for (const double r : asked) scores.push_back(r == 1 ? 1 : score_correlation(r));
    std::string notes;
    RunContext run;
    run.warn = [&](const std::string& note) { notes += note; };
    Reordering{asked, scores, {"a", "b", "c"}, laws}.apply(rows, run);
    EXPECT_EQ(notes, "");
    std::vector<std::vector<double>> ranks(3, std::vector<double>(n));
    for (std::size_t k = 0; k < 3; ++k) {
        std::vector<double> x = column(rows, k, 3);
        for (double& u : x) u = laws[k]->quantile(u);
        for (std::size_t i = 0; i < n; ++i)
            for (const double other : x) ranks[k][i] += (other < x[i]) / 2.0 - (other > x[i]) / 2.0;
    }
    for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) {
            double sum = 0, of_j = 0, of_k = 0;
            for (std::size_t i = 0; i < n; ++i) {
                sum += ranks[j][i] * ranks[k][i];
                of_j += ranks[j][i] * ranks[j][i];
                of_k += ranks[k][i] * ranks[k][i];
            }
            EXPECT_NEAR(sum / std::sqrt(of_j * of_k), asked[3 * j + k], 3e-3) << j << k;
        }
}

// Ties are ordered by the index of the points.
TEST(Reordering, TakesTiesInTheOrderOfThePoints) {
    std::vector<double> tied, apart;
    for (std::size_t i = 0; i < 24; ++i) {
        const double row[] = {static_cast<double>(i * 7 % 4) / 4, static_cast<double>(i % 3) / 3,
                              static_cast<double>(i * i % 5) / 5};
        for (const double x : row) {
            tied.push_back(x);
            apart.push_back(x + 1e-6 * static_cast<double>(i));
        }
    }
    const auto of_tied = reordered(tied, asked);
    const auto of_apart = reordered(apart, asked);
    for (std::size_t i = 0; i < tied.size(); ++i) EXPECT_NEAR(of_tied[i], of_apart[i], 1e-4) << i;
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(sorted(column(of_tied, k, 3)), sorted(column(tied, k, 3)));
}

TEST(Reordering, IsTheSameOnAnyNumberOfThreads) {
    const auto rows = numbers_of(make("random", points(5000, 3)));
    RunContext one, many;
    one.threads = 1;
    many.threads = 8;
    EXPECT_EQ(reordered(rows, asked, one), reordered(rows, asked, many));
}

TEST(Reordering, SaysWhatItCannotReorder) {
    const std::pair<std::vector<double>, const char*> cases[] = {
        {{0.1, 0.2, 0.3}, "iman-conover: expected at least 4 points for 3 parameters; there is 1"},
        {{0.1, 0.2, 0.3, 0.2, 0.3, 0.1, 0.3, 0.1, 0.2}, "there are 3"},
        {{0.1, 0.5, 0.3, 0.2, 0.5, 0.1, 0.3, 0.5, 0.2, 0.4, 0.5, 0.4},
         "iman-conover: all points have the same value of b; expected different values"},
        {{0.1, 0.2, 0.9, 0.2, 0.4, 0.8, 0.3, 0.1, 0.7, 0.4, 0.3, 0.6, 0.5, 0.5, 0.5},
         "iman-conover: the ranks of c are determined by those of the preceding parameters"}};
    for (const auto& [rows, says] : cases) try {
            reordered(rows, asked);
            ADD_FAILURE() << says;
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::input);
            EXPECT_THAT(std::string(e.what()), HasSubstr(says));
        }
}

// In a chain: after preceding warps, on a whole set, for its own coordinates.
TEST(Reordering, TakesTheWholeSetOfAChain) {
    const std::string json =
        R"(parameters@3,1:json=[{"parameters":[{"name":"a","range":[0,2]},)"
        R"({"name":"b","range":[1,3]}],"correlation":{"reordering":"iman-conover",)"
        R"("spearman":[["a","b",0.8]]}}])";
    const std::vector<Spec> specs = {parse_spec("owen:seed=4"), parse_spec(json)};
    const WarpChain chain(specs, 3, {.seed = 1, .count = 20000});
    EXPECT_TRUE(chain.traits().needs_whole_set);
    const PointSet cube = make("random", points(20000, 3));  // of several blocks
    const auto all = chain.mapped(cube.flat(), false, 0, {});
    EXPECT_EQ(all, chain.forward(numbers_of(cube)));

    const auto before =
        WarpChain({specs.data(), 1}, 3, {.seed = 1, .count = 20000}).forward(numbers_of(cube));
    std::vector<double> pair;
    for (std::size_t i = 0; i < before.size(); i += 3)
        pair.insert(pair.end(), {before[i + 2], before[i]});
    const auto apart = reordered(pair, {1, 0.8, 0.8, 1});
    const WarpChain only({&specs[1], 1}, 3);
    const auto back = only.inverse(all);
    for (std::size_t i = 0; i < before.size() / 3; ++i) {
        ASSERT_EQ(all[3 * i + 1], before[3 * i + 1]);
        ASSERT_EQ(all[3 * i + 2], 2 * apart[2 * i]);
        ASSERT_EQ(all[3 * i], 1 + 2 * apart[2 * i + 1]);
        ASSERT_NEAR(back[3 * i], apart[2 * i + 1], 1e-15);
    }
    EXPECT_FALSE(only.domain()->even());
    EXPECT_THROW(static_cast<void>(only.density(all)), Error);
}

}  // namespace stipple::testing::reordering_test
