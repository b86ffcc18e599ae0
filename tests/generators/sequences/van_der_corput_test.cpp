// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "math/digital/radical_inverse.hpp"
#include "support/exact.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::van_der_corput_test {

TEST(VanDerCorput, FirstPointsByHand) {
    EXPECT_EQ(make("van-der-corput", {.count = 5}), points_of({{0}, {.5}, {.25}, {.75}, {.125}}));
    EXPECT_EQ(make("van-der-corput", points(5, 1), {{"base", "4"}}),
              points_of({{0}, {.25}, {.5}, {.75}, {.0625}}));
    EXPECT_EQ(make("van-der-corput", points(12, 1, 9), {{"base", "10"}})[2][0], 11. / 100);
}

TEST(VanDerCorput, AlignedBlocksAreShiftedGrids) {
    for (const std::uint64_t b : {2U, 3U, 6U, 10U, 100U}) {
        const std::uint64_t block = b * b;
        for (const std::uint64_t number : {0U, 1U, 12345U}) {
            const PointSet set = make("van-der-corput", points(block, 1, number * block),
                                      {{"base", std::to_string(b)}});
            const auto side = static_cast<double>(block);
            // The digits above those of the block come after its own in the radical inverse.
            const double shift = RadicalInverse(static_cast<std::uint32_t>(b)).of(number) / side;
            std::set<std::int64_t> seen;
            for (const double x : set.flat()) {
                const double steps = (x - shift) * side;
                EXPECT_NEAR(steps, std::round(steps), 1e-9) << b << ", block " << number;
                seen.insert(std::llround(steps));
            }
            EXPECT_EQ(seen.size(), block);
            EXPECT_EQ(*seen.begin(), 0);
        }
    }
}

TEST(VanDerCorput, IsCorrectlyRoundedInLargeBases) {
    for (const std::uint64_t b : {65536U, 65535U, 32749U})
        for (const std::uint64_t i : {b - 1, b * b - 1, b * b * b - 5, std::uint64_t{1} << 52}) {
            const double x =
                make("van-der-corput", points(1, 1, i), {{"base", std::to_string(b)}})[0][0];
            Fraction exact = 0;
            Fraction weight(1, b);
            for (std::uint64_t rest = i; rest > 0; rest /= b, weight /= b)
                exact += weight * (rest % b);
            EXPECT_TRUE(is_nearest_double(x, exact)) << i << " in base " << b;
        }
}

TEST(VanDerCorput, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("van-der-corput", points(5000, 1), {{"base", "7"}}));
    EXPECT_TRUE(stretches_agree("van-der-corput", points(3000, 1), {{"base", "2000"}}));
}

TEST(VanDerCorput, RefusesBasesAndDimensionsThatItDoesNotHave) {
    EXPECT_EQ(error_of([] { make("van-der-corput", points(1, 2)); }),
              "usage: --dimension: 2 is outside [1, 1], the range of van-der-corput");
    for (const char* base : {"1", "0", "-2", "65537"})
        EXPECT_TRUE(error_of([&] {
                        make("van-der-corput", {}, {{"base", base}});
                    }).starts_with("usage: --base: " + std::string(base) + " is outside"));
}

}  // namespace stipple::testing::van_der_corput_test
