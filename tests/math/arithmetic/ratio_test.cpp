// SPDX-License-Identifier: MIT
#include "math/arithmetic/ratio.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"
#include "support/exact.hpp"

namespace stipple::testing::ratio_test {

TEST(Ratio, IsTheNearestDoubleForAllSizes) {
    const Rng rng(1);
    for (std::uint64_t i = 0; i < 4000; ++i) {
        const int bits = 2 + static_cast<int>(i % 71);
        const Wide mask = (Wide{1} << bits) - 1;
        const Wide b = 1 + (((Wide{rng.bits(4 * i)} << 64) | rng.bits(4 * i + 1)) & mask);
        const Wide a = ((Wide{rng.bits(4 * i + 2)} << 64) | rng.bits(4 * i + 3)) % b;
        using boost::multiprecision::cpp_int;
        const Fraction exact{cpp_int(a), cpp_int(b)};
        if (exact > exactly(one_minus_ulp)) continue;
        EXPECT_TRUE(is_nearest_double(ratio(a, b), exact)) << exact;
    }
}

TEST(Ratio, RoundsTiesToEven) {
    const std::uint64_t big = std::uint64_t{1} << 54;
    EXPECT_EQ(ratio(big / 2 + 1, big), 0.5);
    EXPECT_EQ(ratio(big / 2 + 3, big), 0.5 + 0x1p-52);
    EXPECT_EQ(ratio(Wide{big} * 8 - 17, Wide{big} * 8), 1 - 0x1p-53);
}

TEST(Ratio, NeverReachesOne) {
    for (int bits = 1; bits <= 72; ++bits) {
        const Wide b = Wide{1} << bits;
        EXPECT_LT(ratio(b - 1, b), 1) << bits;
        EXPECT_GE(ratio(b - 1, b), 1 - std::ldexp(1.0, -std::min(bits, 53))) << bits;
        EXPECT_EQ(ratio(0, b), 0) << bits;
    }
}

}  // namespace stipple::testing::ratio_test
