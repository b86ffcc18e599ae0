// SPDX-License-Identifier: MIT
#include "math/combinatorics/permutation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <map>
#include <numeric>
#include <vector>

#include "core/rng.hpp"

namespace stipple::testing::permutation_test {
namespace {

using Image = std::uint64_t (*)(std::uint64_t size, std::uint64_t key, std::uint64_t i);

std::uint64_t image(std::uint64_t size, std::uint64_t key, std::uint64_t i) {
    return Permutation(size, key)(i);
}

/// A linear congruence: also a bijection, but pairs keep their distance.
std::uint64_t rotation(std::uint64_t size, std::uint64_t key, std::uint64_t i) {
    return (key % size + i) % size;
}

/// Probability that equally likely cells give a larger chi-square than `hits`.
double upper_tail(const std::vector<std::uint64_t>& hits) {
    const double total = static_cast<double>(std::accumulate(hits.begin(), hits.end(), 0UL));
    const double expected = total / static_cast<double>(hits.size());
    double statistic = 0;
    for (const std::uint64_t h : hits) {
        const double gap = static_cast<double>(h) - expected;
        statistic += gap * gap / expected;
    }
    const boost::math::chi_squared law(static_cast<double>(hits.size() - 1));
    return boost::math::cdf(boost::math::complement(law, statistic));
}

/// Smallest tail probability of three tests: the image of i, the difference of two images, and the
/// pair.
double worst_tail(Image of, std::uint64_t size, std::uint64_t i, std::uint64_t j,
                  std::uint64_t keys) {
    std::vector<std::uint64_t> single(size);
    std::vector<std::uint64_t> step(size - 1);
    std::vector<std::uint64_t> pairs(size * (size - 1));
    const Rng rng(size, i + 1000 * j);
    for (std::uint64_t k = 0; k < keys; ++k) {
        const std::uint64_t key = rng.bits(k);
        const std::uint64_t a = of(size, key, i);
        const std::uint64_t b = (of(size, key, j) + size - a) % size;
        ++single[a];
        ++step[b - 1];
        ++pairs[a * (size - 1) + b - 1];
    }
    return std::min({upper_tail(single), upper_tail(step), upper_tail(pairs)});
}

}  // namespace

TEST(Permutation, IsABijectionForEverySizeAndKey) {
    for (std::uint64_t size = 1; size <= 600; ++size)
        for (std::uint64_t key = 0; key < 20; ++key) {
            const Permutation permutation(size, key);
            std::vector<bool> hit(size);
            for (std::uint64_t i = 0; i < size; ++i) {
                const std::uint64_t y = permutation(i);
                ASSERT_LT(y, size);
                ASSERT_FALSE(hit[y]) << size << ", key " << key;
                hit[y] = true;
            }
        }
}

TEST(Permutation, StretchesHoldTheSingleImages) {
    const std::uint64_t word = std::uint64_t{1} << 32;
    for (const std::uint64_t size :
         {std::uint64_t{1}, std::uint64_t{64}, std::uint64_t{65}, std::uint64_t{1000},
          std::uint64_t{4096}, word - 1, word, word + 1, std::uint64_t{1} << 53}) {
        const Permutation permutation(size, 99);
        const std::size_t count = std::min<std::uint64_t>(size, 700);
        for (const std::uint64_t first : {std::uint64_t{0}, (size - count) / 2, size - count}) {
            std::vector<double> out(count);
            permutation.fill(first, out);
            for (std::size_t j = 0; j < count; ++j)
                ASSERT_EQ(out[j], static_cast<double>(permutation(first + j))) << size;
        }
    }
}

TEST(Permutation, LargeOnesHaveNoTwoEqualImages) {
    for (const std::uint64_t size : {(std::uint64_t{1} << 53) - 1, (std::uint64_t{1} << 40) + 1,
                                     (std::uint64_t{1} << 20) + 1}) {
        std::vector<double> out(1 << 20);
        Permutation(size, 3).fill(size - out.size(), out);
        std::ranges::sort(out);
        EXPECT_EQ(std::ranges::adjacent_find(out), out.end());
        EXPECT_LT(out.back(), static_cast<double>(size));
    }
}

// All 24 orders of 4 elements are equally frequent. False alarm 1e-6.
TEST(Permutation, EveryOrderOfFewIsEquallyLikely) {
    std::map<std::vector<std::uint64_t>, std::uint64_t> orders;
    for (std::uint64_t k = 0; k < 100'000; ++k) {
        const Permutation permutation(4, Rng(5).bits(k));
        ++orders[{permutation(0), permutation(1), permutation(2), permutation(3)}];
    }
    ASSERT_EQ(orders.size(), 24U);
    std::vector<std::uint64_t> hits;
    for (const auto& [order, count] : orders) hits.push_back(count);
    EXPECT_GT(upper_tail(hits), 1e-6);
}

// False alarm: 5 sizes x 4 pairs x 3 statistics x 1e-6 = 6e-5.
TEST(Permutation, ImagesAndPairsOfThemAreUniform) {
    for (const std::uint64_t size : {7, 65, 100, 128, 200})
        for (const auto& [i, j] : {std::pair<std::uint64_t, std::uint64_t>{0, 1},
                                   {0, size / 2},
                                   {size / 3, size - 1},
                                   {size - 2, size - 1}})
            EXPECT_GT(worst_tail(image, size, i, j, 60'000), 1e-6) << size << ": " << i << " " << j;
    EXPECT_LT(worst_tail(rotation, 65, 0, 1, 60'000), 1e-6);
}

// Three consecutive images are in each of the six orders equally often; false alarm 1e-6.
TEST(Permutation, ThreeImagesComeInAnyOrder) {
    for (const std::uint64_t size : {1000UL, 1UL << 20, (1UL << 52) + 1}) {
        std::vector<std::uint64_t> hits(6);
        for (std::uint64_t k = 0; k < 60'000; ++k) {
            const Permutation permutation(size, Rng(6).bits(k));
            const std::uint64_t a = permutation(0);
            const std::uint64_t b = permutation(1);
            const std::uint64_t c = permutation(2);
            ++hits[(a < b ? 3U : 0U) + (a < c ? 1U : 0U) + (b < c ? 1U : 0U)];
        }
        // For a < b, 0, 1, 2 mean c < a < b, a < c < b, a < b < c; for b < a: c < b, b < c < a, a <
        // c.
        EXPECT_GT(upper_tail(hits), 1e-6) << size;
    }
}

}  // namespace stipple::testing::permutation_test
