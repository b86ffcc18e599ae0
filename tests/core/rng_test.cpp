// SPDX-License-Identifier: MIT
#include "core/rng.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace stipple::testing::rng_test {

// Known-answer vectors published by Random123 for philox4x32 with 10 rounds (kat_vectors).
TEST(Rng, PhiloxMatchesThePublishedKnownAnswers) {
    using Words = std::array<std::uint32_t, 4>;
    struct Case {
        Words counter;
        std::array<std::uint32_t, 2> key;
        Words expected;
    };
    const std::vector<Case> cases = {
        {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
        {{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
         {0xffffffff, 0xffffffff},
         {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
        {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
         {0xa4093822, 0x299f31d0},
         {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}}};
    for (const auto& [counter, key, expected] : cases)
        EXPECT_EQ(philox_block(counter, key), expected);
}

TEST(Rng, NumberIsHalfABlockOfSeedStreamAndIndex) {
    const Rng rng(0x1122334455667788, 0x99aabbccddeeff00);
    const auto block =
        philox_block({0x2468ace0, 0x1, 0xddeeff00, 0x99aabbcc}, {0x55667788, 0x11223344});
    const std::uint64_t pair = 0x12468ace0;
    EXPECT_EQ(rng.bits(2 * pair), block[0] | static_cast<std::uint64_t>(block[1]) << 32);
    EXPECT_EQ(rng.bits(2 * pair + 1), block[2] | static_cast<std::uint64_t>(block[3]) << 32);
}

// Most numbers are computed in groups, those at the ends one by one. Tests ranges of every length
// and start, one in which the counter's low word overflows, with 64-bit key and stream.
TEST(Rng, FillGivesTheNumbersOneByOne) {
    constexpr std::uint64_t overflow = std::uint64_t{1} << 33;  // two numbers per counter value
    for (const Rng& rng : {Rng(7, 3), Rng(0xfedcba9876543210, 0xf123456789abcdef)})
        for (const std::uint64_t start : {std::uint64_t{0}, overflow - 40, 3 * overflow - 64})
            for (std::uint64_t first = start; first < start + 18; ++first)
                for (std::size_t size = 0; size < 300; size += size < 40 ? 1 : 29) {
                    std::vector<double> filled(size + 1, -1);
                    rng.fill(first, std::span(filled).first(size));
                    for (std::size_t k = 0; k < size; ++k)
                        ASSERT_EQ(filled[k], rng.uniform(first + k)) << first << " + " << k;
                    ASSERT_EQ(filled[size], -1) << "wrote beyond " << size;
                }
}

TEST(Rng, FillTakesAnyAlignment) {
    const Rng rng(11);
    std::vector<double> room(64);
    for (std::size_t at = 0; at < 8; ++at) {
        rng.fill(2, std::span(room).subspan(at, 50));
        for (std::size_t k = 0; k < 50; ++k) ASSERT_EQ(room[at + k], rng.uniform(2 + k)) << at;
    }
}

TEST(Rng, UnitTakesTheHighBitsAndStaysBelowOne) {
    EXPECT_EQ(to_unit(0), 0);
    EXPECT_EQ(to_unit(~std::uint64_t{0}), one_minus_ulp);
    EXPECT_EQ(to_unit(std::uint64_t{1} << 63), 0.5);
    EXPECT_EQ(to_unit((std::uint64_t{1} << 11) - 1), 0);
}

TEST(Rng, StreamsAndSeedsDiffer) {
    EXPECT_NE(Rng(1, 0).bits(0), Rng(1, 1).bits(0));
    EXPECT_NE(Rng(1, 0).bits(0), Rng(2, 0).bits(0));
}

TEST(Rng, BelowMeetsEveryValueAndNoOther) {
    const Rng rng(1);
    std::vector<int> hits(6);
    for (std::uint64_t i = 0; i < 600; ++i) ++hits.at(rng.below(i, 6));
    for (const int h : hits) EXPECT_GT(h, 60);
}

}  // namespace stipple::testing::rng_test
