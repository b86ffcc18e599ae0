// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/text.hpp"
#include "generators/lattices/polynomial_search.hpp"
#include "math/digital/gf2.hpp"
#include "support/contract.hpp"
#include "support/nets.hpp"
#include "support/scrambling.hpp"
#include "support/sequences.hpp"
#include "support/temporary_file.hpp"

namespace stipple::testing::polynomial_lattice_test {
namespace {

std::string listed(const std::vector<std::uint64_t>& numbers) {
    std::vector<std::string> words;
    for (const std::uint64_t number : numbers) words.push_back(std::to_string(number));
    return join(words, ",");
}

Settings given(std::uint64_t modulus, const std::vector<std::uint64_t>& vector) {
    return {{"modulus", std::to_string(modulus)}, {"vector", listed(vector)}};
}

/// Largest degree of a partial quotient of q / p, by Euclid's algorithm.
int largest_quotient(std::uint64_t p, std::uint64_t q) {
    int largest = 0;
    while (q != 0) {
        largest = std::max(largest, gf2::degree(p) - gf2::degree(q));
        p = std::exchange(q, gf2::remainder(p, q));
    }
    return largest;
}

/// Oracle: e^2 computed from the points.
double error_of_points(const PointSet& set, const std::vector<double>& weights) {
    double sum = 0;
    for (std::size_t i = 0; i < set.count(); ++i) {
        double product = 1;
        for (std::size_t k = 0; k < set.dimension(); ++k) {
            const double x = set[i][k];
            product *= 1 + weights[k] *
                               (x == 0 ? 1. / 6 : 1. / 6 - std::exp2(std::floor(std::log2(x)) - 1));
        }
        sum += product;
    }
    return sum / static_cast<double>(set.count()) - 1;
}

/// Oracle: tries every polynomial for every component.
std::vector<std::uint64_t> by_trying_all(std::uint64_t modulus,
                                         const std::vector<double>& weights) {
    std::vector<std::uint64_t> vector;
    const std::uint64_t n = std::uint64_t{1} << gf2::degree(modulus);
    for (std::size_t k = 0; k < weights.size(); ++k) {
        std::uint64_t best = 0;
        double least = 1e300;
        std::vector<std::uint64_t> candidates;  // components used least often so far
        for (std::ptrdiff_t times = 0; candidates.empty(); ++times)
            for (std::uint64_t q = 1; q < n; ++q)
                if (std::ranges::count(vector, q) == times) candidates.push_back(q);
        vector.push_back(0);
        for (const std::uint64_t q : candidates) {
            vector.back() = q;
            const PointSet set = make("polynomial-lattice", {.count = n}, given(modulus, vector));
            const double error = error_of_points(set, weights);
            if (error < least - 1e-13) {
                least = error;
                best = q;
            }
        }
        vector.back() = best;
    }
    return vector;
}

}  // namespace

// By hand: 1 / (x^3 + x + 1) has the digits 0010111 with period 7, so those of i = 1, x, x^2 are
// 001, 010 and 101; (x + 1) / (x^3 + x + 1) has the digits 0111001, which give 011, 111 and 110.
TEST(PolynomialLattice, FirstPointsByHand) {
    const PointSet set = make("polynomial-lattice", {.count = 8}, given(11, {1, 3}));
    const std::vector<double> first = {0, 1, 2, 3, 5, 4, 7, 6};
    const std::vector<double> second = {0, 3, 7, 4, 6, 5, 1, 2};
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(set[i][0], first[i] / 8) << i;
        EXPECT_EQ(set[i][1], second[i] / 8) << i;
    }
}

// The definition: x is the first m digits of the Laurent series of i(x) q(x) / p(x).
TEST(PolynomialLattice, IsTheQuotientOfPolynomials) {
    for (const std::uint64_t p : {2ULL, 7ULL, 19ULL, 24ULL, 283ULL, 1ULL << 10, 1033ULL}) {
        const int m = gf2::degree(p);
        const std::uint64_t n = std::uint64_t{1} << m;
        for (const std::uint64_t q : {std::uint64_t{1}, n - 1, n / 3 + 1}) {
            const PointSet set = make("polynomial-lattice", {.count = n}, given(p, {q}));
            for (std::uint64_t i = 0; i < n; ++i) {
                std::uint64_t rest = gf2::product(i, q, p);
                std::uint64_t quotient = 0;  // of the remainder times x^m by p
                for (int digit = 0; digit < m; ++digit) {
                    rest <<= 1;
                    quotient = quotient << 1 | rest >> m;
                    if (rest >> m != 0) rest ^= p;
                }
                ASSERT_EQ(set[i][0], std::ldexp(static_cast<double>(quotient), -m))
                    << "modulus " << p << ", q = " << q << ", i = " << i;
            }
        }
    }
}

// Niederreiter 1992, section 4.4: with (1, q), t + 1 is the largest degree of a partial quotient in
// the continued fraction of q / p. So t = 0 if all of them are linear.
TEST(PolynomialLattice, InThePlaneTIsThatOfTheContinuedFraction) {
    for (const std::uint64_t p : {67ULL, 64ULL, 73ULL, 131ULL}) {
        const std::uint64_t n = std::uint64_t{1} << gf2::degree(p);
        int best = 100;
        for (std::uint64_t q = 1; q < n; ++q) {
            if (gf2::common_divisor(p, q) != 1) continue;
            const PointSet set = make("polynomial-lattice", {.count = n}, given(p, {1, q}));
            const int t = largest_quotient(p, q) - 1;
            best = std::min(best, t);
            ASSERT_EQ(exact_t(set, 2), static_cast<std::size_t>(t)) << p << ", " << q;
        }
        EXPECT_EQ(best, 0) << p;
    }
}

// Compared with the points, also for a lattice that is its own mirror image, and for one point.
TEST(PolynomialLattice, ErrorOfAVectorIsThatOfItsPoints) {
    const std::vector<double> weights = {1, 0.5, 0.25, 0.7};
    for (const std::uint64_t modulus : {2ULL, 3ULL, 11ULL, 16ULL, 283ULL, 1033ULL}) {
        const std::uint64_t n = std::uint64_t{1} << gf2::degree(modulus);
        const std::vector<std::uint64_t> vector = {1, n - 1, n / 2, n / 3 + 1};
        const std::span<const double> some(weights);
        const PointSet set = make("polynomial-lattice", {.count = n}, given(modulus, vector));
        EXPECT_NEAR(squared_polynomial_error(modulus, vector, some), error_of_points(set, weights),
                    1e-13)
            << modulus;
        EXPECT_NEAR(
            squared_polynomial_error(modulus, std::vector<std::uint64_t>{1}, some.first(1)),
            error_of_points(make("polynomial-lattice", {.count = n}, given(modulus, {1})), {1}),
            1e-13);
    }
}

// e^2 is a part of about n^-2 of its terms; one coordinate has w / (6 n^2). Others by NumPy.
TEST(PolynomialLattice, ErrorKeepsItsDigitsInLargeLatticesAndForTinyWeights) {
    for (const int m : {1, 10, 20})
        for (const double weight : {1e6, 1., 1e-12, 1e-250})
            EXPECT_NEAR(
                squared_polynomial_error(gf2::smallest_irreducible(m),
                                         std::vector<std::uint64_t>{1}, std::vector{weight}) /
                    std::ldexp(weight / 6, -2 * m),
                1, 1e-14)
                << m << ", " << weight;
    const std::vector<std::uint64_t> vector = {1, 800};
    const std::vector<double> weights = {1e-10, 1e-10};
    EXPECT_NEAR(squared_polynomial_error(1033, vector, weights) / 3.178914388444826e-17, 1, 1e-12);
}

// 1000 points are not a lattice: the error is that of all 1024.
TEST(PolynomialLattice, NamesTheErrorOfAllPointsWhereSomeAreLeftOut) {
    EXPECT_EQ(generate("polynomial-lattice", points(1024, 2)).provenance.found.at(1).first,
              "squared_error");
    EXPECT_EQ(generate("polynomial-lattice", points(1000, 2)).provenance.found.at(1).first,
              "squared_error_of_all_points");
}

TEST(PolynomialLattice, IsClosedUnderXor) {
    const PointSet set = make("polynomial-lattice", points(64, 3));
    std::set<std::vector<int>> all;
    const auto digits = [&](std::size_t i) {
        std::vector<int> row;
        for (const double x : set[i]) row.push_back(static_cast<int>(x * 64));
        return row;
    };
    for (std::size_t i = 0; i < 64; ++i) all.insert(digits(i));
    EXPECT_EQ(all.size(), 64U);
    for (std::size_t i = 0; i < 64; ++i)
        for (std::size_t j = 0; j < 64; ++j) {
            auto sum = digits(i);
            const auto other = digits(j);
            for (std::size_t k = 0; k < 3; ++k) sum[k] ^= other[k];
            ASSERT_TRUE(all.contains(sum)) << i << " and " << j;
        }
}

TEST(PolynomialLattice, EveryCoordinateOfASearchedOneTakesEveryValueOnce) {
    const PointSet set = make("polynomial-lattice", points(256, 20));
    for (std::size_t k = 0; k < 20; ++k) {
        std::set<double> values;
        for (std::size_t i = 0; i < 256; ++i) values.insert(set[i][k] * 256);
        EXPECT_EQ(values.size(), 256U);
        EXPECT_EQ(*values.rbegin(), 255);
    }
}

// The search by Fourier transforms finds the same as trying all, with ties resolved to the smallest
// number. 283 has a generator other than x.
TEST(PolynomialLattice, ComponentByComponentIsTheBestOfEachComponent) {
    const std::vector<double> square = {1, 1. / 4, 1. / 9, 1. / 16, 1. / 25};
    for (const std::uint64_t p : {2ULL, 7ULL, 11ULL, 19ULL, 37ULL, 61ULL, 67ULL, 131ULL})
        EXPECT_EQ(polynomial_components(p, square, {}), by_trying_all(p, square)) << p;
    const std::vector<double> equal(4, 1.0);
    for (const std::uint64_t p : {19ULL, 37ULL, 283ULL})
        EXPECT_EQ(polynomial_components(p, equal, {}), by_trying_all(p, equal)) << p;
    const std::vector<double> rising = {0.1, 2, 30};
    EXPECT_EQ(polynomial_components(67, rising, {}), by_trying_all(67, rising));
}

// The kernel's definition: the mean over all shifts s of the kernel of the Sobolev space, B_1(y)
// B_1(z) + B_2(|y - z|) / 2 at y = s, z = s XOR x. For x of m digits, s XOR x - s is constant on
// intervals of length 2^-m, on which Simpson's rule is exact.
TEST(PolynomialLattice, KernelIsTheMeanOverShiftsOfTheSobolevSpaces) {
    const auto b2 = [](double u) { return u * u - u + 1. / 6; };
    for (unsigned x = 0; x < 32; ++x) {
        double mean = 0;
        for (unsigned s = 0; s < 32; ++s) {
            const double y = s / 32.;
            const double z = (s ^ x) / 32.;
            const auto at = [&](double u) {
                return (y + u - 0.5) * (z + u - 0.5) + b2(std::abs(y - z)) / 2;
            };
            mean += (at(0) + 4 * at(1 / 64.) + at(1 / 32.)) / 6 / 32;
        }
        EXPECT_NEAR(digital_shift_kernel(x / 32.), mean, 1e-15) << x;
    }
}

// Here products reach 2^3000 unless a common factor is removed.
TEST(PolynomialLattice, SearchesInManyDimensionsWithoutOverflow) {
    const auto vector = polynomial_components(1033, std::vector<double>(3000, 6.0), {});
    const auto front = polynomial_components(1033, std::vector<double>(30, 6.0), {});
    EXPECT_EQ(vector.size(), 3000U);
    EXPECT_TRUE(std::ranges::equal(front, std::span(vector).first(30)));
    EXPECT_GT(std::set<std::uint64_t>(vector.end() - 100, vector.end()).size(), 1U);
}

TEST(PolynomialLattice, AnyCountIsTheFrontOfTheSmallestLatticeThatHoldsIt) {
    const PointSet whole = make("polynomial-lattice", points(1024, 3));
    const PointSet front = make("polynomial-lattice", points(700, 3));
    EXPECT_TRUE(std::ranges::equal(front.flat(), whole.flat().first(front.flat().size())));
    EXPECT_TRUE(stretches_agree("polynomial-lattice", points(50, 3)));
    EXPECT_TRUE(stretches_agree("polynomial-lattice", points(5000, 2)));
    EXPECT_EQ(make("polynomial-lattice", points(1, 2)), points_of({{0, 0}}));
    EXPECT_EQ(make("polynomial-lattice", points(2, 2)), points_of({{0, 0}, {0.5, 0.5}}));
}

TEST(PolynomialLattice, ReachesItsLargestCount) {
    const std::uint64_t n = std::uint64_t{1} << 52;
    const auto sequence = sequence_of("polynomial-lattice", points(n, 2), {{"vector", "1,5"}});
    const PointSet last = stretch(*sequence, 2, n - 3, 3);
    for (const double x : last.flat()) EXPECT_TRUE(x >= 0 && x < 1) << x;
}

TEST(PolynomialLattice, ScrambledPointsAreItsPointsScrambledAndAsGoodANet) {
    const PointSet plain = make("polynomial-lattice", points(256, 3));
    for (const char* scramble : {"digital-shift", "matrix", "owen"})
        for (const std::uint64_t seed : {1, 17}) {
            const PointSet set = make("polynomial-lattice", points(256, 3),
                                      {{"scramble", scramble}}, {.seed = seed});
            EXPECT_EQ(set, scrambled(plain, scramble, seed)) << scramble;
            EXPECT_EQ(exact_t(set, 2), exact_t(plain, 2)) << scramble;
        }
}

TEST(PolynomialLattice, WeightsAndDecaySteerTheSearch) {
    const Request request = points(256, 4);
    const PointSet plain = make("polynomial-lattice", request);
    EXPECT_EQ(make("polynomial-lattice", request, {{"decay", "2"}}), plain);
    EXPECT_EQ(
        make("polynomial-lattice", request, {{"weights", "1,0.25,0.1111111111111111,0.0625"}}),
        plain);
    EXPECT_NE(make("polynomial-lattice", points(256, 12), {{"decay", "0"}}),
              make("polynomial-lattice", points(256, 12)));
    EXPECT_NE(make("polynomial-lattice", request, {{"modulus", "285"}}), plain);
}

TEST(PolynomialLattice, ReadsLatticesOfOtherPackages) {
    const PointSet expected =
        make("polynomial-lattice", {.count = 8}, {{"modulus", "11"}, {"vector", "1,5"}});
    const auto from = [](const std::string& text, Settings settings = {}) {
        const TemporaryFile file(text);
        settings.emplace_back("vector-file", file.path());
        return make("polynomial-lattice", {}, settings);
    };
    EXPECT_EQ(from("# plattice\n2 # base\n2\n3\n11 # modulus\n1\n5\n"), expected);
    const std::string latnet =
        "# Parameters for a polynomial lattice rule in base 2\n2  # 2 dimensions\n3\n11\n1\n5\n";
    EXPECT_EQ(from(latnet), expected);
    // Points of an interlaced lattice made by LatNet Builder's own scripts.
    const std::string woven =
        "# Parameters for a polynomial lattice rule in base 2\n2  # 2 dimensions\n2 # Interlacing "
        "factor\n4 # Number of components\n10 # k = 10\n1033\n1\n800\n839\n753\n";
    const TemporaryFile interlaced(woven);
    EXPECT_EQ(make("polynomial-lattice", {.count = 4}, {{"vector-file", interlaced.path()}}),
              points_of({{0, 0},
                         {0.31349754333496094, 0.9035816192626953},
                         {0.25399112701416016, 0.6143264770507812},
                         {0.0674581527709961, 0.47689247131347656}}));
    const auto refusal = [&](const std::string& text, const Settings& settings = {}) {
        return error_of([&] { from(text, settings); });
    };
    EXPECT_THAT(
        refusal("# Parameters for a polynomial lattice rule\n2\n2 # Interlacing factor\n5\n"),
        ::testing::HasSubstr(":4:1: '5' is out of range; expected the number of components, "
                             "4"));
    EXPECT_THAT(refusal(latnet, {{"modulus", "11"}}),
                ::testing::HasSubstr(" contains its own, 11"));
    EXPECT_THAT(refusal("# lattice\n1\n8\n1\n"),
                ::testing::HasSubstr("a lattice of whole numbers, which rank1-lattice reads"));
    EXPECT_THAT(refusal("# plattice\n3\n1\n3\n11\n1\n"), ::testing::HasSubstr("the base 2"));
    EXPECT_THAT(refusal("# plattice\n2\n1\n3\n16\n1\n"),
                ::testing::HasSubstr("the modulus, of that degree"));
    EXPECT_THAT(refusal("# plattice\n2\n1\n3\n11\n8\n"),
                ::testing::HasSubstr("8 is not a polynomial in [1, 7]"));
    EXPECT_THAT(refusal(latnet, {{"vector", "1,5"}}),
                ::testing::HasSubstr("--vector contradicts --vector-file; give one of them"));
}

TEST(PolynomialLattice, RefusesWhatItCannotMake) {
    const auto refusal = [](const Request& request, const Settings& settings) {
        return error_of([&] { make("polynomial-lattice", request, settings); });
    };
    EXPECT_EQ(refusal(points(9, 2), given(11, {1, 3})),
              "usage: --count: 9 is above 8 = 2^3, the number of points of modulus 11");
    EXPECT_EQ(
        refusal(points(8, 2), {{"modulus", "9"}}),
        "usage: --modulus: 9 is not irreducible, as cbc needs; 11 is the smallest of degree 3 "
        "that is | give a --vector, which takes any modulus");
    EXPECT_EQ(refusal(points(8, 3), given(11, {1, 3})),
              "usage: --vector: 2 components are too few for dimension 3");
    EXPECT_EQ(refusal(points(8, 2), given(11, {1, 8})),
              "usage: --vector: 8 is not a polynomial in [1, 7]");
    EXPECT_EQ(refusal(points(8, 2), {{"modulus", "11"}, {"vector", "1,2.5"}}),
              "usage: --vector: 2.5 is not a polynomial in [1, 7]");
    EXPECT_EQ(refusal(points(8, 2), {{"rule", "vector"}}),
              "usage: --rule: vector needs a vector; give --vector or --vector-file");
    EXPECT_EQ(refusal(points(8, 2), {{"rule", "cbc"}, {"vector", "1,2"}}),
              "usage: --vector applies to the rule vector only; the rule here is cbc");
    EXPECT_EQ(refusal(points(8, 2), {{"decay", "1"}, {"vector", "1,2"}}),
              "usage: --decay applies to the rule cbc only; the rule here is vector");
    EXPECT_EQ(refusal(points(8, 2), {{"decay", "1"}, {"weights", "1,2"}}),
              "usage: --weights contradicts --decay; give one of them");
    EXPECT_EQ(refusal(points(8, 2), {{"weights", "1"}}),
              "usage: --weights: 1 numbers for 2 coordinates; give one for each");
    EXPECT_EQ(refusal(points(8, 2), {{"weights", "1,-1"}}),
              "usage: --weights: -1 is outside (0, 1000000]");
    EXPECT_EQ(refusal(points(5'000'000, 2), {}),
              "usage: --count: cbc searches lattices of up to 2^22 points; 5000000 points with "
              "modulus 8388641 belong to one of 2^23 | give a --vector");
    EXPECT_EQ(
        refusal(points((std::uint64_t{1} << 52) + 1, 2), {}),
        "usage: --count: 4503599627370497 is outside [1, 2^52], the range of polynomial-lattice");
}

TEST(PolynomialLattice, ASearchCanBeStoppedShowsItsProgressAndKeepsToItsMemory) {
    const auto search = [&](const RunContext& run) {
        make("polynomial-lattice", points(1 << 14, 20), {}, run);
    };
    expect_to_stop_at_once(search);
    expect_progress_to_the_end(search);
    const auto error = error_of(
        [] { make("polynomial-lattice", points(1 << 16, 2), {}, {.max_memory = 2'000'000}); });
    EXPECT_TRUE(error.starts_with("limit: the search for a vector")) << error;
}

}  // namespace stipple::testing::polynomial_lattice_test
