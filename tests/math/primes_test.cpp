// SPDX-License-Identifier: MIT
#include "math/primes.hpp"

#include <gtest/gtest.h>

using namespace stipple;

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
