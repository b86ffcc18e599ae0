// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/chain.hpp"
#include "support/planar.hpp"

namespace stipple::testing::pixel_test {

TEST(Pixel, PointsByHand) {
    EXPECT_EQ(image_of("pixel", {0.25, 0.75}), (std::vector{0.25, 0.75})) << "one pixel";
    EXPECT_EQ(image_of("pixel:resolution=640x480", {0.5, 0.25}), (std::vector{320.0, 120.0}));
    EXPECT_EQ(image_of("pixel:resolution=640x480,pixel=[639,0]", {0.5, 0.25}),
              (std::vector{639.5, 0.25}));
}

// A 6 x 4 grid of strata on 3 x 2 pixels has 2 x 2 strata in each pixel.
TEST(Pixel, GridOfStrataIsAGridInEachPixel) {
    const auto map = mapping("pixel:resolution=3x2");
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 4; ++j) {
            const auto p = image_of(*map, {(i + 0.5) / 6, (j + 0.5) / 4});
            EXPECT_NEAR(p[0], i / 2 + (i % 2 == 0 ? 0.25 : 0.75), 1e-15);
            EXPECT_NEAR(p[1], j / 2 + (j % 2 == 0 ? 0.25 : 0.75), 1e-15);
        }
}

TEST(Pixel, NeverReachesTheNextPixel) {
    for (const std::string side : {"1", "2", "3", "640", "1920", "65537", "2147483648"}) {
        const double size = std::stod(side);
        const auto p =
            image_of("pixel:resolution=" + side + "x" + side, {one_minus_ulp, one_minus_ulp});
        EXPECT_LT(p[0], size);
        for (const double at : {0.0, 1.0, std::floor(size / 2), size - 1}) {
            if (at >= size) continue;
            const auto map = mapping("pixel:resolution=" + side + "x" + side + ",pixel=[" +
                                     std::to_string(static_cast<long long>(at)) + ",0]");
            for (const double u : {0.0, 5e-324, 0x1p-60, 0.1, 0.7, one_minus_ulp}) {
                const double x = image_of(*map, {u, 0})[0];
                EXPECT_EQ(std::floor(x), at) << side << " " << u;
                EXPECT_NEAR(x - at, u, at * 0x1p-52) << side;
            }
        }
    }
}

TEST(Pixel, RoundTripOverTheWholeSquare) {
    expect_round_trip(*mapping("pixel"), 0);
    expect_round_trip(*mapping("pixel:resolution=640x480"), 1e-12);
    expect_round_trip(*mapping("pixel:resolution=640x480,pixel=[17,479]"), 1e-12);
    expect_stands_hostile_points(*mapping("pixel:resolution=3x7"), 1e-14);
    expect_stands_hostile_points(*mapping("pixel:resolution=3x7,pixel=[2,6]"), 1e-14);
}

TEST(Pixel, DensityIsOneOverTheArea) {
    EXPECT_DOUBLE_EQ(mapping("pixel:resolution=4x5")->density(std::vector{3.5, 4.5}), 0.05);
    const auto one = mapping("pixel:resolution=4x5,pixel=[3,4]");
    EXPECT_EQ(one->density(std::vector{3.5, 4.5}), 1);
    EXPECT_EQ(one->density(std::vector{2.5, 4.5}), 0);
    expect_density_is_one_over_jacobian(*mapping("pixel:resolution=4x5"));
    expect_density_is_one_over_jacobian(*one);
}

TEST(Pixel, IsUniform) {
    expect_chi_square_can_tell(*mapping("pixel:resolution=4x5"));
    expect_chi_square_can_tell(*mapping("pixel:resolution=4x5,pixel=[3,4]"));
}

// One row has the samples of pixel, time and lens.
TEST(Pixel, StandsBesideTimeAndLens) {
    const std::vector<Spec> specs = {parse_spec("disk@4,5"),
                                     parse_spec("pixel@1,2:resolution=640x480")};
    const WarpChain chain(specs, 5);
    const auto row = chain.forward({0.5, 0.25, 0.375, 0.25, 0.5});
    EXPECT_EQ(row, (std::vector{320.0, 120.0, 0.375, -0.5, 0.0}));
    EXPECT_TRUE(chain.domain()->contains(row));
}

TEST(Pixel, DomainParsesBack) {
    EXPECT_EQ(parse_domain("pixel:resolution=4x5", 2)->bounding_box(), (Box{{0, 0}, {4, 5}}));
    EXPECT_EQ(parse_domain("pixel:resolution=4x5,pixel=[3,4]", 2)->bounding_box(),
              (Box{{3, 4}, {4, 5}}));
}

TEST(Pixel, RefusesWhatIsNoPixel) {
    const auto error = [](std::string_view spec) { return error_of([&] { mapping(spec); }); };
    EXPECT_EQ(error("pixel:resolution=640"),
              "usage: --resolution: expected 2 numbers, WxH; 1 given");
    EXPECT_NE(error("pixel:resolution=0x5"), "");
    EXPECT_EQ(error("pixel:resolution=1x4294967296"),
              "usage: --resolution: 4294967296 is outside [1, 2147483648]");
    EXPECT_EQ(error("pixel:resolution=4x5,pixel=[4,0]"),
              "usage: --pixel: 4,0 is outside the image of 4x5 pixels, which start at 0,0 | "
              "--resolution WxH sets the size of the image");
    EXPECT_NE(error("pixel:pixel=[-1,0]"), "");
    EXPECT_EQ(error("pixel:pixel=[0.5,0]"), "usage: --pixel: 0.5 is not a whole number");
    EXPECT_EQ(error("pixel:pixel=3"), "usage: --pixel: expected 2 numbers, i,j; 1 given");
}

}  // namespace stipple::testing::pixel_test
