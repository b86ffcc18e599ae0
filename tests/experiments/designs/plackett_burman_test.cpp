// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bitset>

#include "experiments/designs/hadamard.hpp"
#include "support/designs.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::plackett_burman_test {
namespace {

constexpr const char* unit = "plackett-burman";

}  // namespace

// First rows of cyclic designs, as published in the article.
TEST(PlackettBurman, PublishedRowsMoveOnByOneAndEndWithMinus) {
    for (const std::string row :
         {"+++-+--", "++-+++---+-", "++--++++-+-+----++-", "+++++-+-++--++--+-+----",
          "-+-+++---+++++-+++--+----+-+-++--+-", "++--+-+--+++-+++++---+-+++-----+---++-+-++-"}) {
        const std::size_t q = row.size();
        const auto rows = signs_of(coded_design(unit, {.count = q + 1}));
        ASSERT_EQ(rows.size(), q + 1);
        for (std::size_t i = 0; i < q; ++i)
            EXPECT_EQ(rows[i], row.substr(q - i) + row.substr(0, q - i)) << q + 1 << " row " << i;
        EXPECT_EQ(rows[q], std::string(q, '-'));
    }
}

// H H^T = n I, and the first column is 1, for all orders below 668, the lowest for which no matrix
// is known, and for some higher ones by each construction.
TEST(PlackettBurman, MatricesAreHadamards) {
    constexpr std::size_t most = 1076;
    std::vector<std::uint64_t> orders{724, 916, 932, most};
    for (std::uint64_t n = 4; n < 668; n += 4) orders.push_back(n);
    for (const std::uint64_t n : orders) {
        ASSERT_TRUE(generators::has_hadamard(n)) << n;
        const generators::Hadamard matrix(n);
        std::vector<std::bitset<most>> rows(n);
        for (std::uint64_t i = 0; i < n; ++i)
            for (std::uint64_t k = 0; k < n; ++k) rows[i][k] = matrix.positive(i, k);
        std::size_t wrong = 0;
        for (std::uint64_t i = 0; i < n; ++i) {
            ASSERT_TRUE(rows[i][0]) << n;
            for (std::uint64_t j = 0; j < i; ++j) wrong += 2 * (rows[i] ^ rows[j]).count() != n;
        }
        EXPECT_EQ(wrong, 0U) << matrix.construction();
    }
}

TEST(PlackettBurman, AnyTwoFactorsAreOrthogonal) {
    for (const std::uint64_t n : {4, 16, 28, 52, 56, 64, 100}) {
        const PointSet set = coded_design(unit, {.count = n});
        ASSERT_EQ(set.dimension(), n - 1);
        for (std::size_t a = 0; a < set.dimension(); ++a) {
            double sum = 0;
            for (std::size_t i = 0; i < n; ++i) sum += set[i][a];
            ASSERT_EQ(sum, 0) << n;
            for (std::size_t b = 0; b < a; ++b) ASSERT_EQ(column_product(set, a, b), 0) << n;
        }
    }
}

TEST(PlackettBurman, TellsHowItIsMade) {
    const auto construction = [](std::uint64_t n) {
        return found_in(make(unit, points(n, 2)), "construction");
    };
    EXPECT_EQ(construction(12), "Paley I, q = 11");
    EXPECT_EQ(construction(28), "Paley I, q = 27");
    EXPECT_EQ(construction(36), "twin primes 5 and 7");
    EXPECT_EQ(construction(52), "Paley II, q = 25");
    EXPECT_EQ(construction(56), "Paley I, q = 27, doubled");
    EXPECT_EQ(construction(92), "Goethals-Seidel, v = 23");
    EXPECT_EQ(construction(116), "Miyamoto, q = 29");
    EXPECT_EQ(construction(184), "Goethals-Seidel, v = 23, doubled");
}

TEST(PlackettBurman, TakesTheFewestRunsOrTheMostFactors) {
    EXPECT_EQ(make(unit, {.dimension = 11}).count(), 12U);
    EXPECT_EQ(make(unit, {.dimension = 12}).count(), 16U);
    EXPECT_EQ(make(unit, {.dimension = 91}).count(), 92U);
    EXPECT_EQ(make(unit, {.count = 20}).dimension(), 19U);
    EXPECT_EQ(make(unit, {}).count(), 12U);
    EXPECT_TRUE(stretches_agree(unit, points(400, 5)));
    const PointSet ends = make(unit, {}, {{"ends", "true"}});
    EXPECT_EQ(ends[0][0], 1 - 0x1p-53);
    EXPECT_EQ(ends[11][0], 0);
}

TEST(PlackettBurman, RefusesOtherCountsNamingTheNearest) {
    const auto error = [](std::uint64_t n, std::size_t k) {
        return error_of([&] { make(unit, points(n, k)); });
    };
    EXPECT_EQ(error(14, 5),
              "usage: --count: 14 is not a multiple of 4, as plackett-burman needs; 12 and 16 are "
              "the nearest");
    EXPECT_EQ(error(668, 5),
              "usage: --count: 668 is not the order of an available Hadamard matrix, as "
              "plackett-burman needs; 664 and 672 are the nearest");
    EXPECT_EQ(error(3, 1),
              "usage: --count: 3 is not a multiple of 4, as plackett-burman needs; 4 is the least");
    EXPECT_EQ(error(std::uint64_t{1} << 30, 1),
              "usage: --count: 1073741824 is not the order of an available Hadamard matrix, as "
              "plackett-burman needs; 1048576 is the nearest");
    EXPECT_EQ(error(12, 12),
              "usage: --dimension: 12 factors need more than 12 runs, which allow up to 11; 16 "
              "runs are the fewest that suffice");
}

}  // namespace stipple::testing::plackett_burman_test
