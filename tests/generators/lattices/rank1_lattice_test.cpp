// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "generators/lattices/component_by_component.hpp"
#include "support/contract.hpp"
#include "support/exact.hpp"
#include "support/sequences.hpp"
#include "support/temporary_file.hpp"

namespace stipple::testing::rank1_lattice_test {
namespace {

using Vector = std::vector<std::uint64_t>;

/// Oracle: e^2 by its definition.
double by_definition(std::uint64_t n, const Vector& z, const std::vector<double>& weights) {
    double sum = 0;
    for (std::uint64_t i = 0; i < n; ++i) {
        double product = 1;
        for (std::size_t k = 0; k < z.size(); ++k) {
            const double x = static_cast<double>(i * z[k] % n) / static_cast<double>(n);
            product *=
                1 + weights[k] * 2 * std::numbers::pi * std::numbers::pi * (x * x - x + 1. / 6);
        }
        sum += product;
    }
    return sum / static_cast<double>(n) - 1;
}

/// Oracle: tries all components that have been used least often; takes the first of those that are
/// equal within rounding.
Vector by_trial(std::uint64_t n, const std::vector<double>& weights) {
    Vector z{1};
    while (z.size() < weights.size()) {
        double least = 1e300;
        std::uint64_t best = 0;
        Vector candidates;
        for (std::ptrdiff_t times = 0; n > 1 && candidates.empty(); ++times)
            for (std::uint64_t c = 1; 2 * c <= n; ++c)
                if (std::gcd(c, n) == 1 && std::ranges::count(z, c) == times)
                    candidates.push_back(c);
        z.push_back(0);
        for (const std::uint64_t c : candidates) {
            z.back() = c;
            const double error = by_definition(n, z, weights);
            if (error < least - 1e-12) {
                least = error;
                best = c;
            }
        }
        z.back() = best;
    }
    return z;
}

std::vector<double> decaying(std::size_t count, double exponent) {
    std::vector<double> weights;
    for (std::size_t j = 1; j <= count; ++j)
        weights.push_back(std::pow(static_cast<double>(j), -exponent));
    return weights;
}

}  // namespace

TEST(Rank1Lattice, FibonacciLatticeOfEightByHand) {
    EXPECT_EQ(make("rank1-lattice", points(8, 2), {{"rule", "fibonacci"}}),
              points_of({{0, 0},
                         {.125, .625},
                         {.25, .25},
                         {.375, .875},
                         {.5, .5},
                         {.625, .125},
                         {.75, .75},
                         {.875, .375}}));
    EXPECT_EQ(make("rank1-lattice", points(1, 2), {{"rule", "fibonacci"}}), points_of({{0, 0}}));
    EXPECT_EQ(make("rank1-lattice", points(2, 1), {{"rule", "fibonacci"}}), points_of({{0}, {.5}}));
    EXPECT_EQ(make("rank1-lattice", {}, {{"rule", "fibonacci"}}).count(), 987U);
}

// Integers h with h . z = 0 mod n, except 0: for F_k, max(1, |h_1|) max(1, |h_2|) is at least
// F_(k-2) (S. K. Zaremba 1966); a lattice with another vector fails.
TEST(Rank1Lattice, DualOfFibonacciLatticesIsFarFromTheOrigin) {
    std::int64_t before = 1;
    std::int64_t n = 2;
    for (std::int64_t two_before = 1; n < 2000;
         two_before = std::exchange(before, n), n = before + two_before) {
        const PointSet set = make("rank1-lattice", points(static_cast<std::uint64_t>(n), 2),
                                  {{"rule", "fibonacci"}});
        const auto z = std::llround(set[1][1] * static_cast<double>(n));
        std::int64_t least = n;
        for (std::int64_t h = -n; h <= n; ++h)
            for (std::int64_t g = 0; g < n / std::max<std::int64_t>(1, std::abs(h)); ++g)
                if ((h + g * z) % n == 0 && (h != 0 || g != 0))
                    least = std::min(least, std::max<std::int64_t>(1, std::abs(h)) *
                                                std::max<std::int64_t>(1, g));
        EXPECT_GE(least, two_before) << n;
    }
}

TEST(Rank1Lattice, KorobovVectorIsThePowersOfItsMultiplier) {
    const PointSet set = make("rank1-lattice", points(101, 4), {{"multiplier", "40"}});
    EXPECT_EQ(set, make("rank1-lattice", points(101, 4), {{"vector", "1,40,1600,64000"}}));
    EXPECT_EQ(set[1][2], (1600 % 101) / 101.);
}

TEST(Rank1Lattice, IsClosedUnderAddition) {
    for (const Settings& settings :
         {Settings{}, {{"rule", "korobov"}}, {{"vector", "3,50,77"}}, {{"weights", "1,1,1"}}}) {
        const std::uint64_t n = 360;
        const PointSet set = make("rank1-lattice", points(n, 3), settings);
        std::set<Vector> all;
        const auto whole = [&](std::size_t i) {
            Vector row;
            for (const double x : set[i])
                row.push_back(static_cast<std::uint64_t>(std::llround(x * n)));
            return row;
        };
        for (std::size_t i = 0; i < n; ++i) all.insert(whole(i));
        for (std::size_t i = 0; i < n; i += 7)
            for (std::size_t j = 0; j < n; ++j) {
                Vector sum = whole(i);
                for (std::size_t k = 0; k < 3; ++k) sum[k] = (sum[k] + whole(j)[k]) % n;
                ASSERT_TRUE(all.contains(sum)) << i << " + " << j;
            }
    }
}

TEST(Rank1Lattice, CoordinatesAreCorrectlyRoundedUpToTheLargestCounts) {
    const std::uint64_t most = std::uint64_t{1} << 53;
    const Vector z{1, most - 1, 6'364'136'223'846'793, 0, 3};
    for (const std::uint64_t n : {most, most - 1, most - 111, std::uint64_t{1'000'003}}) {
        const auto sequence = sequence_of("rank1-lattice", points(n, 5),
                                          {{"vector", "1,9007199254740991,6364136223846793,0,3"}});
        for (const std::uint64_t first : {std::uint64_t{0}, n / 3, n - 2000}) {
            const PointSet set = stretch(*sequence, 5, first, 2000);
            for (std::size_t i = 0; i < 2000; i += i < 20 ? 1 : 97)
                for (std::size_t k = 0; k < 5; ++k) {
                    const auto r = static_cast<unsigned __int128>(first + i) * z[k] % n;
                    const Fraction exact(static_cast<std::uint64_t>(r), n);
                    ASSERT_TRUE(is_nearest_double(set[i][k], exact)) << n << " " << first + i;
                    ASSERT_LT(set[i][k], 1);
                }
        }
    }
}

TEST(Rank1Lattice, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("rank1-lattice", points(50, 3)));
    EXPECT_TRUE(stretches_agree("rank1-lattice", points(5000, 2)));
    EXPECT_TRUE(stretches_agree("rank1-lattice", points(700, 23)));
    EXPECT_TRUE(stretches_agree("rank1-lattice", points(6, 3000), {{"multiplier", "5"}}));
}

// P_2 of the two points (0, ..., 0) and (1/2, ..., 1/2): B_2(0) = 1/6, B_2(1/2) = -1/12.
TEST(LatticeError, OfTwoPointsByHand) {
    const double pi2 = std::numbers::pi * std::numbers::pi;
    const double expected =
        -1 + ((1 + pi2 / 3) * (1 + pi2 / 6) + (1 - pi2 / 6) * (1 - pi2 / 12)) / 2;
    EXPECT_NEAR(squared_lattice_error(2, Vector{1, 1}, std::vector{1, 0.5}), expected, 1e-14);
}

TEST(LatticeError, IsItsDefinition) {
    for (const std::uint64_t n : {1U, 2U, 17U, 1000U, 3000U}) {
        const Vector z{1, 5, 333, 77};
        const auto weights = decaying(4, 1);
        EXPECT_NEAR(squared_lattice_error(n, z, weights), by_definition(n, z, weights), 1e-11);
    }
}

// e^2 is a part of about n^-2 of its terms. One coordinate has w pi^2 / (3 n^2); other values are by
// long doubles in NumPy.
TEST(LatticeError, KeepsItsDigitsInLargeLatticesAndForTinyWeights) {
    const double pi2 = std::numbers::pi * std::numbers::pi;
    for (const std::uint64_t n : {3U, 1021U, 1U << 16, 1U << 22})
        for (const double weight : {1e6, 1., 1e-12, 1e-250}) {
            const double expected = weight * pi2 / 3 / static_cast<double>(n * n);
            EXPECT_NEAR(squared_lattice_error(n, Vector{1}, std::vector{weight}) / expected, 1,
                        1e-14)
                << n << ", " << weight;
        }
    const auto of = [](std::uint64_t n, std::uint64_t z, double a, double b) {
        return squared_lattice_error(n, Vector{1, z}, std::vector{a, b});
    };
    EXPECT_NEAR(of(65536, 6713, 1e-8, 1e-8) / 1.5319653903574778e-17, 1, 1e-11);
    EXPECT_NEAR(of(1 << 20, 387275, 1, 0.25) / 8.823060842435424e-11, 1, 1e-9);
    EXPECT_NEAR(of(1009, 2, 1e-300, 1e-300) / 6.462880917523162e-306, 1, 1e-13);
}

// Tiny weights leave the sum over products of two terms, which do not depend on the weights.
TEST(ComponentByComponent, TellsVectorsApartForTinyWeights) {
    for (const std::uint64_t n : {64U, 101U, 1009U}) {
        const auto pairs = [n](std::uint64_t a, std::uint64_t b) {
            const Vector z{a, b};
            const double both = by_definition(n, z, {1, 1});
            return both - by_definition(n, {a}, {1}) - by_definition(n, {b}, {1});
        };
        double least = 1e300;
        for (std::uint64_t c = 2; 2 * c <= n; ++c)
            if (std::gcd(c, n) == 1) least = std::min(least, pairs(1, c));
        for (const double weight : {1e-9, 1e-17, 1e-300}) {
            const Vector z = component_by_component(n, std::vector{weight, weight}, {});
            EXPECT_NEAR(pairs(1, z[1]), least, 1e-12) << n << ", " << weight;
        }
    }
}

TEST(ComponentByComponent, IsTheChoiceByTrialForCountsOfEveryKind) {
    for (const std::uint64_t n : {1U,  2U,  3U,  4U,   5U,   6U,   7U,   8U,   9U,   16U,  30U, 36U,
                                  64U, 81U, 97U, 128U, 180U, 240U, 251U, 256U, 343U, 360U, 500U})
        for (const double exponent : {0., 1., 2.}) {
            const auto weights = decaying(7, exponent);
            Vector expected = by_trial(n, weights);
            if (n == 1) expected.assign(7, 1);
            EXPECT_EQ(component_by_component(n, weights, {}), expected)
                << n << ", weights j^-" << exponent;
        }
}

// Larger counts, which reveal errors that small groups would not show.
TEST(ComponentByComponent, IsTheChoiceByTrialForLargerCounts) {
    for (const std::uint64_t n : {1009U, 1024U, 1155U})
        EXPECT_EQ(component_by_component(n, decaying(4, 1), {}), by_trial(n, decaying(4, 1))) << n;
}

// Products of 600 factors overflow, or lose all differences, unless they are rescaled.
TEST(ComponentByComponent, DoesNotDegenerateInHighDimensions) {
    for (const std::uint64_t n : {1021U, 4096U})
        for (const auto& weights : {decaying(600, 2), std::vector<double>(600, 0.6)}) {
            const Vector z = component_by_component(n, weights, {});
            const std::set<std::uint64_t> last(z.end() - 100, z.end());
            EXPECT_GT(last.size(), 40U) << n << ", last weight " << weights.back();
        }
}

TEST(KorobovSearch, FindsTheBestOfAllWhereThereIsTime) {
    for (const std::uint64_t n : {1U, 2U, 30U, 101U, 256U}) {
        const auto weights = decaying(3, 0);
        double least = 1e300;
        for (std::uint64_t a = 1; a <= n; ++a)
            if (std::gcd(a, n) == 1)
                least = std::min(least, by_definition(n, {1, a, a * a}, weights));
        const std::uint64_t a = korobov_multiplier(n, weights, n, {});
        EXPECT_NEAR(by_definition(n, powers_modulo(a, 3, n), weights), least,
                    1e-11 * std::abs(least))
            << n;
    }
}

// At the origin the product of 700 factors overflows; all multipliers had an infinite error then.
TEST(KorobovSearch, LeavesOutTheOriginWhereItHidesTheOthers) {
    const Vector z =
        powers_modulo(korobov_multiplier(1009, std::vector(700, 0.6), 1009, {}), 700, 1009);
    EXPECT_GT(std::set(z.begin(), z.end()).size(), 100U);
}

TEST(KorobovSearch, IsMuchBetterThanTheMiddleOfAllAlsoWhereItTriesFew) {
    const std::uint64_t n = 1 << 19;
    const auto weights = decaying(40, 2);
    const std::uint64_t a = korobov_multiplier(n, weights, 25, {});  // of 131072 candidates
    const auto error = [&](std::uint64_t b) {
        return squared_lattice_error(n, powers_modulo(b, 40, n), weights);
    };
    std::vector<double> others;
    for (std::uint64_t b = 4321; others.size() < 9; b += 20002) others.push_back(error(b));
    std::ranges::nth_element(others, others.begin() + 4);
    EXPECT_LT(error(a), others[4]);
}

TEST(Rank1Lattice, RulesAreWhatTheOptionsSay) {
    const auto z = component_by_component(400, std::vector{1., 0.25, 1. / 9}, {});
    const PointSet set = make("rank1-lattice", points(400, 3));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(set[1][k], static_cast<double>(z[k]) / 400);
    EXPECT_EQ(set, make("rank1-lattice", points(400, 3), {{"decay", "2"}}));
    EXPECT_EQ(set, make("rank1-lattice", points(400, 3), {{"weights", "1,.25,.1111111111111111"}}));
    EXPECT_NE(set, make("rank1-lattice", points(400, 3), {{"weights", "1,.0001,1"}}));
    EXPECT_EQ(make("rank1-lattice", {}, {{"vector", "1,2,3"}}).dimension(), 3U);
}

TEST(Rank1Lattice, ReadsVectorsFromFiles) {
    const PointSet expected = make("rank1-lattice", points(64, 3), {{"vector", "1,27,19"}});
    for (const char* text : {"1\n27\n19\n", "# of somebody\n1 1\r\n2 27\r\n3 19\r\n4 5",
                             "1\t1\n2\t27 # two\n3\t19\n"}) {
        const TemporaryFile file(text);
        EXPECT_EQ(make("rank1-lattice", points(64, 3), {{"vector-file", file.path()}}), expected)
            << text;
    }
}

// Headers of LDData and LatNet Builder have the numbers of points and coordinates.
TEST(Rank1Lattice, ReadsLatticesOfOtherPackages) {
    const PointSet expected = make("rank1-lattice", points(8, 3), {{"vector", "1,3,5"}});
    for (const char* text :
         {"1\n3\n5\n", "# lattice\n# of somebody\n3  # dimensions\n8\n1\n3\n5\n",
          "# Input Command Line: -t lattice\n# Merit: 1.5\n# Parameters for a lattice rule, "
          "non-embedded\n3    # 3 dimensions\n8    # modulus = n = 8 points\n# "
          "Coordinates\n1\n3\n5"}) {
        const TemporaryFile file(text);
        const Settings settings{{"vector-file", file.path()}};
        EXPECT_EQ(make("rank1-lattice", {.count = 8}, settings), expected) << text;
        if (text[0] != '#') continue;
        EXPECT_EQ(make("rank1-lattice", {}, settings), expected) << text;
        EXPECT_EQ(make("rank1-lattice", {.count = 4}, settings),
                  make("rank1-lattice", points(4, 3), {{"vector", "1,3,5"}}));
        EXPECT_THAT(
            error_of([&] { make("rank1-lattice", {.count = 16}, settings); }),
            ::testing::HasSubstr("holds a lattice of 8 points; 16 does not divide this number"));
    }
    const auto refusal = [](const std::string& text) {
        const TemporaryFile file(text);
        const std::string error = error_of([&] {
            make("rank1-lattice", {}, {{"vector-file", file.path()}});
        });
        return error.substr(error.find(file.path()) + file.path().size());
    };
    EXPECT_EQ(refusal("# plattice\n2\n1\n3\n11\n1\n"),
              ": a polynomial lattice, which polynomial-lattice reads");
    EXPECT_EQ(
        refusal(
            "# Merit: 2\r\n# Parameters for a polynomial lattice rule in base 2\n1\n3\n11\n1\n"),
        ": a polynomial lattice, which polynomial-lattice reads");
    EXPECT_EQ(refusal("# lattice\n3\n8\n1\n3\n"), ": 2 components; expected 3");
    EXPECT_EQ(refusal("# nothing\n"), ": 0 components; expected some");
}

TEST(Rank1Lattice, ComplainsOfFilesByLineAndColumn) {
    const auto complaint = [](const std::string& text) {
        const TemporaryFile file(text);
        const std::string error = error_of([&] {
            make("rank1-lattice", points(64, 3), {{"vector-file", file.path()}});
        });
        return error.substr(std::min(error.size(), error.find(file.path()) + file.path().size()));
    };
    EXPECT_EQ(complaint("1\n2\n"), ": 2 components are too few for dimension 3");
    EXPECT_EQ(complaint("1 1\n3 5\n"),
              ":2:1: 3 is out of order; expected 2, the number of the next component");
    EXPECT_EQ(complaint("1\n2.5\n"),
              ":2:1: '2.5' is not a whole number; expected a component of the vector");
    EXPECT_EQ(complaint("1 1 1\n"), ":1:5: unexpected '1'; expected the end of the line");
    EXPECT_EQ(complaint("1 1\n2\n"),
              ":2:2: the line ends here; expected a component of the vector");
}

TEST(Rank1Lattice, RefusesWhatItCannotMake) {
    const auto error = [](std::uint64_t n, std::size_t d, const Settings& settings) {
        return error_of([&] { make("rank1-lattice", points(n, d), settings); });
    };
    EXPECT_EQ(
        error(1000, 2, {{"rule", "fibonacci"}}),
        "usage: --count: 1000 is not a Fibonacci number, as the rule fibonacci needs; 987 and "
        "1597 are the nearest");
    EXPECT_EQ(error(9'000'000'000'000'000, 2, {{"rule", "fibonacci"}}),
              "usage: --count: 9000000000000000 is not a Fibonacci number, as the rule fibonacci "
              "needs; 8944394323791464 is the nearest");
    EXPECT_EQ(error(8, 3, {{"rule", "fibonacci"}}),
              "usage: --dimension: 3 is outside [1, 2], the range of fibonacci");
    EXPECT_EQ(error(std::uint64_t{1} << 30, 2, {}),
              "usage: --count: 1073741824 is outside [1, 16777216], the range of the search for a "
              "vector | give a vector, or a multiplier for korobov");
    EXPECT_EQ(error(8, 3, {{"vector", "1,3"}}),
              "usage: --vector: 2 components are too few for dimension 3");
    EXPECT_EQ(error(8, 2, {{"vector", "1,2.5"}}),
              "usage: --vector: 2.5 is not a whole number in [0, 2^53]");
    EXPECT_EQ(error(8, 2, {{"vector", "1,3"}, {"rule", "cbc"}}),
              "usage: --vector applies to the rule vector only; the rule here is cbc");
    EXPECT_EQ(
        error(8, 2, {{"multiplier", "3"}, {"decay", "1"}}),
        "usage: --decay applies to the searches cbc and korobov only; the rule here is korobov");
    EXPECT_EQ(error(8, 2, {{"weights", "1"}}),
              "usage: --weights: 1 numbers for 2 coordinates; give one for each");
    EXPECT_EQ(error(8, 2, {{"weights", "1,0"}}), "usage: --weights: 0 is outside (0, 1000000]");
    EXPECT_EQ(error(8, 2, {{"weights", "1,2"}, {"decay", "1"}}),
              "usage: --weights contradicts --decay; give one of them");
    EXPECT_EQ(error(8, 2, {{"rule", "vector"}}),
              "usage: --rule: vector needs one vector; give either --vector or --vector-file");
    EXPECT_EQ(error(8, 2, {{"rule", "korobov"}, {"multiplier", "3"}, {"effort", "2"}}),
              "usage: --effort applies to korobov's search for a multiplier only; the rule here is "
              "korobov");
}

// 32 multipliers of 16384 that are coprime to n, and 64, which include better ones.
TEST(Rank1Lattice, SaysWhatASearchFoundAndWhatItLeftOut) {
    const auto found = [](const Settings& settings, std::vector<std::string>& notes) {
        RunContext run;
        run.warn = [&](const std::string& note) { notes.push_back(note); };
        return generate("rank1-lattice", points(1 << 15, 250), settings, run).provenance.found;
    };
    std::vector<std::string> few, more;
    const auto first = found({{"rule", "korobov"}, {"effort", "0.5"}}, few);
    const auto second = found({{"rule", "korobov"}}, more);
    EXPECT_EQ(few, std::vector<std::string>{"rank1-lattice: 32 of the multipliers up to 16384 are "
                                            "tried; --effort 256 tries all"});
    EXPECT_EQ(more, std::vector<std::string>{"rank1-lattice: 65 of the multipliers up to 16384 are "
                                             "tried; --effort 253 tries all"});
    ASSERT_EQ(first.size(), 2U);
    EXPECT_EQ(first[0].first, "vector");
    EXPECT_EQ(first[1].first, "squared_error");
    EXPECT_LT(std::stod(second[1].second), std::stod(first[1].second));
    const PointSet small = generate("rank1-lattice", points(101, 3));
    const std::string vector = small.provenance.found.at(0).second;
    const PointSet again = generate("rank1-lattice", points(101, 3), {{"vector", vector}});
    EXPECT_TRUE(again.provenance.found.empty()) << "given, not found";
    EXPECT_TRUE(std::ranges::equal(again.flat(), small.flat()));
}

TEST(Rank1Lattice, SaysWherePointsCoincide) {
    std::vector<std::string> notes;
    RunContext run;
    run.warn = [&](const std::string& note) { notes.push_back(note); };
    generate("rank1-lattice", points(100, 2), {{"vector", "1,2"}}, run);
    EXPECT_TRUE(notes.empty());
    generate("rank1-lattice", points(100, 2), {{"vector", "0,12"}}, run);
    EXPECT_EQ(notes,
              std::vector<std::string>{"rank1-lattice: 4 divides the number of points and all "
                                       "numbers of the vector: every point occurs 4 times"});
}

// If there are enough components, all coordinates are different; otherwise a note names the first
// repeated one.
TEST(Rank1Lattice, RepeatsNoCoordinateInSilence) {
    std::vector<std::string> notes;
    RunContext run;
    run.warn = [&](const std::string& note) { notes.push_back(note); };
    for (const std::uint64_t n : {128U, 101U, 64U}) {
        const Vector z = component_by_component(n, decaying(16, 2), {});
        EXPECT_EQ(std::set(z.begin(), z.end()).size(), 16U) << n;
    }
    generate("rank1-lattice", points(128, 12), {}, run);
    EXPECT_TRUE(notes.empty());
    generate("rank1-lattice", points(10, 3), {{"vector", "1,3,11"}}, run);
    EXPECT_EQ(notes,
              std::vector<std::string>{"rank1-lattice: coordinate 3 equals coordinate 1: the 3 "
                                       "numbers of the vector have 2 different values"});
    notes.clear();
    generate("rank1-lattice", points(8, 5), {}, run);  // only 1 and 3 are coprime to 8 up to sign
    EXPECT_EQ(notes.size(), 1U);
}

TEST(Rank1Lattice, ASearchCanBeStoppedShowsItsProgressAndKeepsToItsMemory) {
    for (const Settings& settings : {Settings{}, Settings{{"rule", "korobov"}}}) {
        const auto search = [&](const RunContext& run) {
            make("rank1-lattice", points(1 << 14, 20), settings, run);
        };
        expect_to_stop_at_once(search);
        expect_progress_to_the_end(search);
    }
    const auto error =
        error_of([] { make("rank1-lattice", points(1 << 16, 2), {}, {.max_memory = 2'000'000}); });
    EXPECT_TRUE(error.starts_with("limit: the search for a vector")) << error;
}

}  // namespace stipple::testing::rank1_lattice_test
