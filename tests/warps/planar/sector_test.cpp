// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/planar.hpp"

namespace stipple::testing::sector_test {
namespace {

const std::vector<std::string> shapes = {
    "sector",
    "sector:angles=[30,75],inner=0.5,radius=2,center=[1,-2]",
    "sector:angles=[-135,135]",
    "sector:angles=[45,405],inner=0.25",
    "sector:angles=[350,370],inner=0.9",
    "sector:angles=[90,90.01]",
};

}  // namespace

TEST(Sector, PointsByHand) {
    const double h = std::sqrt(0.5);
    EXPECT_EQ(image_of("sector", {0, 0.3}), (std::vector{0.0, 0.0}));
    EXPECT_EQ(image_of("sector", {0.25, 0}), (std::vector{0.5, 0.0}));
    EXPECT_EQ(image_of("sector", {0.25, 1}), (std::vector{0.0, 0.5}));
    EXPECT_EQ(image_of("sector", {1, 0.5}), (std::vector{h, h}));
    EXPECT_EQ(image_of("sector:angles=[90,270]", {1, 0.5}), (std::vector{-1.0, 0.0}));
    EXPECT_EQ(image_of("sector:angles=[-90,90],radius=2,center=[1,1]", {1, 0}),
              (std::vector{1.0, -1.0}));
    EXPECT_EQ(image_of("sector:inner=3,radius=5", {0.4375, 1}), (std::vector{0.0, 4.0}));
}

TEST(Sector, WholeTurnIsTheAnnulus) {
    const PointSet cube = telling_points();
    EXPECT_TRUE(std::ranges::equal(warped(*mapping("sector:angles=[0,360],inner=0.5"), cube).flat(),
                                   warped(*mapping("annulus"), cube).flat()));
}

TEST(Sector, RoundTripOverTheWholeSquare) {
    for (const auto& spec : shapes) {
        SCOPED_TRACE(spec);
        expect_round_trip(*mapping(spec), 6e-14);
        expect_stands_hostile_points(*mapping(spec), 6e-14, 20'000);
    }
    expect_round_trip(*mapping("sector:angles=[20,30],radius=1e150"), 1e136);
    expect_unit_coordinates_back(*mapping("sector:angles=[10,80],inner=0.5"), 1e-14);
    expect_unit_coordinates_back(*mapping("sector:angles=[10,80]"), 1e-14, 1e-290);
}

TEST(Sector, DensityIsOneOverTheArea) {
    EXPECT_DOUBLE_EQ(mapping("sector")->domain()->measure(), std::numbers::pi / 4);
    EXPECT_DOUBLE_EQ(mapping("sector:angles=[30,60],inner=1,radius=2")->domain()->measure(),
                     std::numbers::pi / 4);
    EXPECT_EQ(mapping("sector")->density(std::vector{-0.1, 0.5}), 0);
    for (const auto& spec : shapes) {
        expect_density_is_one_over_jacobian(*mapping(spec));
        expect_measure_is_share_of_box(*mapping(spec)->domain());
    }
}

TEST(Sector, IsUniformByArea) {
    expect_chi_square_can_tell(*mapping("sector:angles=[30,75],inner=0.5,radius=2,center=[1,-2]"));
    // A quarter disk has means 4 / (3 pi), variances 1/4 - (4 / (3 pi))^2, with standard errors
    // 8.4e-4 and 7e-4, and covariance 1 / (2 pi) - (4 / (3 pi))^2.
    const double mean = 4 / (3 * std::numbers::pi);
    const PlaneMoments m = plane_moments(*mapping("sector"));
    EXPECT_NEAR(m.x, mean, 4.2e-3);
    EXPECT_NEAR(m.y, mean, 4.2e-3);
    EXPECT_NEAR(m.xx, 0.25 - mean * mean, 3.5e-3);
    EXPECT_NEAR(m.xy, 0.5 * std::numbers::inv_pi - mean * mean, 3.5e-3);
}

TEST(Sector, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("sector")->domain()->spec(), "sector");
    for (const auto& spec : shapes) EXPECT_EQ(mapping(spec)->domain()->spec(), spec);
    const DomainPtr quarter = mapping("sector:angles=[90,180]")->domain();
    for (const auto& p : {std::vector{0.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {-0.5, 0.5}})
        EXPECT_TRUE(quarter->contains(p)) << p[0];
    for (const auto& p :
         {std::vector{1e-13, 0.5}, {-0.5, -1e-13}, {0.1, -0.1}, {-1.0 - 1e-13, 0.0}})
        EXPECT_FALSE(quarter->contains(p)) << p[0];
    const Box box = quarter->bounding_box();
    EXPECT_EQ(box, (Box{{-1, 0}, {0, 1}}));
    const Box bow = mapping("sector:angles=[-45,45],inner=0.5")->domain()->bounding_box();
    EXPECT_NEAR(bow.low[0], 0.5 * std::sqrt(0.5), 1e-15);
    EXPECT_DOUBLE_EQ(bow.high[0], 1);
}

TEST(Sector, RefusesWhatIsNoSector) {
    const auto error = [](std::string_view spec) { return error_of([&] { mapping(spec); }); };
    EXPECT_EQ(error("sector:angles=[90,45]"),
              "usage: --angles: from 90 to 45 are -45 degrees; expected [1e-9, 360]");
    EXPECT_NE(error("sector:angles=[0,0]"), "");
    EXPECT_NE(error("sector:angles=[0,361]"), "");
    EXPECT_EQ(error("sector:angles=90"),
              "usage: --angles: expected 2 numbers, first,last; 1 given");
    EXPECT_EQ(error("sector:angles=[700,800]"), "usage: --angles: 800 is outside [-720, 720]");
    EXPECT_NE(error("sector:inner=1"), "");
    EXPECT_EQ(error_of([] {
                  inverse_of(*mapping("sector"), {-0.25, 0});
              }),
              "input: the point (-0.25, 0) is outside the domain sector");
}

}  // namespace stipple::testing::sector_test
