// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::truncated_test {
namespace {

std::string refusal(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

}  // namespace

TEST(TruncatedWarp, NumbersByHand) {
    EXPECT_EQ(image_of("truncated:of=uniform,high=0.5", {0.5, 1}), (std::vector{0.25, 0.5}));
    EXPECT_DOUBLE_EQ(image_of("truncated:of=[exponential:rate=2],low=100", {0.5, 0})[0],
                     100 + std::numbers::ln2 / 2);
    EXPECT_EQ(image_of("truncated:low=-1,high=1", {0.5, 0}), (std::vector{0.0, -1.0}));
}

TEST(TruncatedWarp, EachCoordinateByItself) {
    const auto map = mapping("truncated:of=[normal:mean=[0,5]],low=[1,5]");
    const auto p = image_of(*map, {0, 0.5});
    EXPECT_EQ(p[0], 1);
    EXPECT_NEAR(p[1], 5 + 0.6744897501960817, 1e-14);
    EXPECT_EQ(map->domain()->spec(), "truncated:of=[normal:mean=[0,5]],low=[1,5]");
    EXPECT_EQ(mapping(map->domain()->spec())->domain()->spec(), map->domain()->spec());
}

TEST(TruncatedWarp, BothWaysAndDensity) {
    for (const char* spec : {"truncated:low=-1,high=2", "truncated:low=30,high=31",
                             "truncated:of=[gamma:shape=3],low=1"}) {
        expect_round_trip(*mapping(spec), 2e-12);
        expect_density_is_one_over_stretch(*mapping(spec), 2e-6);
    }
}

TEST(TruncatedWarp, OfDiscreteOnes) {
    const auto map = mapping("truncated:of=[integers:high=6],low=3");
    EXPECT_EQ(image_of(*map, {0, 0.99}), (std::vector{3.0, 6.0}));
    EXPECT_EQ(map->domain()->measure(), 16);
    EXPECT_EQ(map->density(std::vector{3.0, 6.0}), 1 / 16.0);
}

TEST(TruncatedWarp, RefusesWhatIsNoPartOfADistribution) {
    EXPECT_EQ(refusal("truncated"),
              "usage: --low: neither --low nor --high is given; expected one or both");
    EXPECT_EQ(refusal("truncated:low=3,high=1"), "usage: --low: 3 is not below --high, 1");
    EXPECT_EQ(refusal("truncated:low=45"),
              "usage: --low: normal has the probability 0 from 45 to inf; expected above 1e-290");
    EXPECT_EQ(refusal("truncated:of=sphere,low=0").substr(0, 42),
              "usage: there is no distribution 'sphere' |");
    EXPECT_EQ(refusal("truncated:of=[gamma:shape=0],low=0"),
              "usage: --shape: 0 is outside [0.05, 1000000]");
    EXPECT_EQ(refusal("truncated:of=normal@1,low=0"),
              "usage: --of: 'normal@1' has coordinates; expected a name and its options");
    EXPECT_EQ(refusal("truncated:low=[0,1],high=[2,3,4]"),
              "usage: --low: 2 lower and 3 upper ends for 3 coordinates; expected one for all, or "
              "one for each");
}

}  // namespace stipple::testing::truncated_test
