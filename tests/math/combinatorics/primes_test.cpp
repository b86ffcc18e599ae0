// SPDX-License-Identifier: MIT
#include "math/combinatorics/primes.hpp"

#include <gtest/gtest.h>

namespace stipple::testing::primes_test {

// The thousandth prime is 7919.
TEST(Primes, AreAllPrimesUpTo7919) {
    std::size_t next = 0;
    for (std::uint32_t candidate = 2; candidate <= 7919; ++candidate) {
        bool prime = true;
        for (std::uint32_t q = 2; q < candidate; ++q) prime &= candidate % q != 0;
        if (prime) {
            EXPECT_EQ(primes.at(next++), candidate);
        }
    }
    EXPECT_EQ(next, primes.size());
}

TEST(Primes, KnowsThemAndTheSmallestFactorOfOthers) {
    std::size_t next = 0;
    for (std::uint64_t n = 0; n < 7920; ++n) {
        const bool listed = next < primes.size() && primes[next] == n;
        EXPECT_EQ(is_prime(n), listed) << n;
        if (next < primes.size()) {
            EXPECT_EQ(next_prime(n), primes[next]) << n;
        }
        next += listed;
    }
    EXPECT_EQ(smallest_factor(9), 3U);
    EXPECT_EQ(smallest_factor(65521), 65521U);
    EXPECT_EQ(smallest_factor(65521ULL * 7919), 7919U);
}

}  // namespace stipple::testing::primes_test
