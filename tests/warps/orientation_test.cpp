// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "support/warping.hpp"

namespace stipple::testing::orientation_test {

TEST(Orientation, TakesCoordinatesInAnotherOrderAndDirection) {
    for (const char* warp :
         {"disk", "disk:method=concentric", "triangle", "sphere", "hemisphere"}) {
        const auto plain = mapping(warp);
        const std::string text = std::string(warp).find(':') == std::string::npos ? ":" : ",";
        const auto swapped = mapping(warp + text + "orientation=[2,1]");
        const auto mirrored = mapping(warp + text + "orientation=[-1,2]");
        const auto both = mapping(warp + text + "orientation=[-2,-1]");
        EXPECT_EQ(image_of(*swapped, {0.125, 0.75}), image_of(*plain, {0.75, 0.125})) << warp;
        EXPECT_EQ(image_of(*mirrored, {0.125, 0.75}), image_of(*plain, {0.875, 0.75})) << warp;
        EXPECT_EQ(image_of(*both, {0.125, 0.75}), image_of(*plain, {0.25, 0.875})) << warp;
        for (const auto* map : {&swapped, &mirrored, &both}) {
            expect_round_trip(**map, 1e-14);
            const auto point = image_of(**map, {0.3, 0.6});
            EXPECT_EQ((*map)->density(point), plain->density(point));
            EXPECT_EQ((*map)->domain()->spec(), plain->domain()->spec());
        }
        // 1 - 0 becomes the largest double below 1, because warps need coordinates below 1.
        EXPECT_EQ(image_of(*mirrored, {0, 0.5}), image_of(*plain, {1 - 0x1p-53, 0.5})) << warp;
    }
}

TEST(Orientation, HoldsForPointsThatAreDropped) {
    const auto plain = mapping("disk:method=rejection");
    const auto mirrored = mapping("disk:method=rejection,orientation=[-1,-2]");
    const PointSet set = make("random", points(1000, 2));
    PointSet turned = set;
    for (double& x : turned.flat()) x = 1 - x;
    EXPECT_TRUE(mirrored->drops());
    EXPECT_EQ(warped(*mirrored, set), warped(*plain, turned));
    EXPECT_LT(warped(*mirrored, set).count(), 900U);
}

TEST(Orientation, NamesEachCoordinateOnce) {
    const char* wanted =
        "usage: --orientation: expected each of the unit coordinates 1 to 2 once, such as 2,1 or "
        "-1,2";
    for (const char* wrong : {"1", "1,1", "1,3", "0,1", "1.5,2", "1,-1", "1,2,3", "1e300,1"})
        EXPECT_EQ(error_of([&] { mapping("disk:orientation=[" + std::string(wrong) + "]"); }),
                  wanted)
            << wrong;
    const Warp& sphere = find_warp("sphere");
    const Spec spec = parse_spec("sphere:method=rejection,orientation=[3,-1,2]");
    EXPECT_EQ(sphere.make(spec.values(sphere.options), 3, {})->cube_dimension(), 3U);
}

}  // namespace stipple::testing::orientation_test
