// SPDX-License-Identifier: MIT
#include "math/digital/radical_inverse.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"
#include "math/combinatorics/primes.hpp"
#include "support/exact.hpp"

namespace stipple::testing::radical_inverse_test {
namespace {

constexpr std::uint64_t last = (std::uint64_t{1} << 53) - 1;

/// Oracle: the sum in the definition, in fractions.
Fraction by_definition(std::uint64_t index, std::uint32_t base) {
    Fraction sum = 0;
    Fraction weight(1, base);
    for (; index > 0; index /= base) {
        sum += weight * (index % base);
        weight /= base;
    }
    return sum;
}

}  // namespace

// Worked by hand.
TEST(RadicalInverse, FirstValues) {
    const std::vector<double> base2 = {0, 1. / 2, 1. / 4, 3. / 4, 1. / 8, 5. / 8, 3. / 8, 7. / 8};
    const std::vector<double> base3 = {0, 1. / 3, 2. / 3, 1. / 9, 4. / 9, 7. / 9, 2. / 9, 5. / 9};
    const RadicalInverse in_base2(2);
    const RadicalInverse in_base3(3);
    for (std::uint64_t i = 0; i < 8; ++i) {
        EXPECT_EQ(in_base2.of(i), base2[i]);
        EXPECT_EQ(in_base3.of(i), base3[i]);
    }
    EXPECT_EQ(RadicalInverse(65536).of(65535), 65535. / 65536);
    EXPECT_EQ(RadicalInverse(65536).of(65536), 0x1p-32);
}

TEST(RadicalInverse, IsCorrectlyRoundedUpToTheLastIndex) {
    const Rng rng(2);
    for (std::uint64_t i = 0; i < 3000; ++i) {
        const std::uint32_t base = i % 3 == 0 ? primes[i % 20]
                                   : i % 3 == 1
                                       ? primes[rng.below(2 * i, 1000)]
                                       : static_cast<std::uint32_t>(2 + rng.below(i, 65535));
        const std::uint64_t index = i < 10 ? last - i : rng.bits(2 * i + 1) >> (11 + i % 53);
        EXPECT_TRUE(is_nearest_double(RadicalInverse(base).of(index), by_definition(index, base)))
            << index << " in base " << base;
    }
}

// All digits are b - 1: the largest possible result.
TEST(RadicalInverse, NeverReachesOne) {
    for (const std::uint32_t base : primes) {
        const RadicalInverse inverse(base);
        std::uint64_t index = 0;
        for (std::uint64_t next = base - 1; next <= last; next = index * base + base - 1)
            index = next;
        for (const std::uint64_t i : {index, last / (index + 1) * (index + 1) - 1, last})
            EXPECT_LE(inverse.of(i), 1 - 0x1p-53) << i << " in base " << base;
    }
}

TEST(RadicalInverse, FillGivesTheNumbersOneByOne) {
    for (const std::uint32_t base : {2U, 3U, 5U, 31U, 37U, 1021U, 1031U, 7919U, 65536U}) {
        const RadicalInverse table(base);
        for (const std::uint64_t first :
             {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1023}, std::uint64_t{7000},
              std::uint64_t{1} << 32, last / base - 1500, last / 2 - 1500, last - 2999}) {
            std::vector<double> out(2 * 3000, -1);
            table.fill(first, 3000, out.data(), 2);
            for (std::size_t j = 0; j < 3000; ++j) {
                ASSERT_EQ(out[2 * j], table.of(first + j))
                    << "base " << base << ", index " << first + j;
                ASSERT_EQ(out[2 * j + 1], -1);
            }
        }
    }
}

}  // namespace stipple::testing::radical_inverse_test
