// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "math/digital/binary_scramble.hpp"
#include "support/nets.hpp"
#include "support/scrambling.hpp"

namespace stipple::testing::digital_shift_test {

TEST(DigitalShift, AddsTheSameBitsToAll) {
    const PointSet plain = make("hammersley", points(256, 2));
    const PointSet moved = scrambled(plain, "digital-shift", 3);
    for (std::size_t i = 0; i < plain.count(); ++i)
        for (std::size_t k = 0; k < 2; ++k)
            EXPECT_EQ(unit_to_fraction(moved[i][k]) ^ unit_to_fraction(plain[i][k]),
                      unit_to_fraction(moved[0][k]));
}

TEST(DigitalShift, KeepsTheNetProperty) {
    const PointSet plain = make("hammersley", points(256, 2));
    for (const std::uint64_t seed : {1, 2, 3})
        EXPECT_TRUE(is_net(scrambled(plain, "digital-shift", seed), 2, 0));
}

// 3^5 consecutive points of the radical inverse in base 3 fill the intervals of length 3^-5. A
// digital shift in base 3 preserves that; one in base 2 does not.
TEST(DigitalShift, WorksInAnyBase) {
    const PointSet base_three = part_of(make("halton", points(243, 2)), 0, 243, {1});
    EXPECT_TRUE(is_net(scrambled(base_three, "digital-shift:base=3"), 3, 0));
    EXPECT_FALSE(is_net(scrambled(base_three, "digital-shift"), 3, 0));
}

TEST(DigitalShift, RefusesWhatIsNoBase) {
    const PointSet two = points_of({{0.5, 0.5}});
    const auto error = [&](const char* base) {
        return error_of([&] { scrambled(two, std::string("digital-shift:base=") + base); });
    };
    EXPECT_EQ(error("1"), "usage: --base: 1 is not a whole number in [2, 65536]");
    EXPECT_EQ(error("2.5"), "usage: --base: 2.5 is not a whole number in [2, 65536]");
    EXPECT_EQ(error("[2,3,5]"),
              "usage: --base: 3 numbers for 2 coordinates; give one, or one for each");
    EXPECT_EQ(error("4"), "");
}

}  // namespace stipple::testing::digital_shift_test
