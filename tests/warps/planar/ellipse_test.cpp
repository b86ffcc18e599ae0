// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "math/functions/trigonometry.hpp"
#include "support/planar.hpp"

namespace stipple::testing::ellipse_test {
namespace {

const std::vector<std::string> methods = {"polar", "concentric"};

std::string tilted(const std::string& method) {
    return "ellipse:method=" + method + ",axes=[1,3],rotation=30,center=[5,-7]";
}

}  // namespace

TEST(Ellipse, PointsByHand) {
    EXPECT_EQ(image_of("ellipse", {0, 0.3}), (std::vector{0.0, 0.0}));
    EXPECT_EQ(image_of("ellipse", {1, 0}), (std::vector{1.0, 0.0}));
    EXPECT_EQ(image_of("ellipse", {0.25, 0.25}), (std::vector{0.0, 0.25}));
    EXPECT_EQ(image_of("ellipse:axes=[4,2],center=[10,20]", {0.25, 0.5}), (std::vector{8.0, 20.0}));
    EXPECT_EQ(image_of("ellipse:axes=[4,2],rotation=90", {0.25, 0.5}), (std::vector{0.0, -2.0}));
    EXPECT_EQ(image_of("ellipse:axes=[4,2],rotation=90", {0.25, 0.25}), (std::vector{-1.0, 0.0}));
    EXPECT_EQ(image_of("ellipse:method=concentric", {0.5, 1}), (std::vector{0.0, 0.5}));
    EXPECT_EQ(image_of("ellipse:method=concentric,axes=[2,3]", {0, 0.5}), (std::vector{-2.0, 0.0}));
}

TEST(Ellipse, WithEqualAxesIsTheDisk) {
    const PointSet cube = telling_points();
    for (const auto& method : methods)
        EXPECT_TRUE(std::ranges::equal(
            warped(*mapping("ellipse:axes=[3,3],center=[1,2],method=" + method), cube).flat(),
            warped(*mapping("disk:radius=3,center=[1,2],method=" + method), cube).flat()));
}

TEST(Ellipse, RoundTripOverTheWholeSquare) {
    for (const auto& method : methods) {
        SCOPED_TRACE(method);
        expect_round_trip(*mapping("ellipse:method=" + method), 1e-14);
        expect_round_trip(*mapping(tilted(method)), 3e-13);
        expect_round_trip(*mapping("ellipse:axes=[1e150,1e149],method=" + method), 1e137);
        expect_round_trip(*mapping("ellipse:axes=[1e-3,1],rotation=77,method=" + method), 1e-11);
        expect_stands_hostile_points(*mapping(tilted(method)), 3e-13);
    }
    expect_unit_coordinates_back(*mapping("ellipse:method=concentric"), 1e-14);
    expect_unit_coordinates_back(*mapping("ellipse"), 1e-14, 1e-290);
}

TEST(Ellipse, DensityIsOneOverTheArea) {
    EXPECT_DOUBLE_EQ(mapping("ellipse:axes=[2,3]")->domain()->measure(), 6 * std::numbers::pi);
    EXPECT_EQ(mapping("ellipse")->density(std::vector{0.0, 0.6}), 0);
    for (const auto& method : methods) {
        expect_density_is_one_over_jacobian(*mapping(tilted(method)));
        expect_measure_is_share_of_box(*mapping(tilted(method))->domain());
    }
}

TEST(Ellipse, IsUniformByArea) {
    for (const auto& method : methods) expect_chi_square_can_tell(*mapping(tilted(method)));
    // Along the axes, variances are a^2 / 4 = 1 and b^2 / 4 = 1/4; rotated by 30 degrees, 3/4 +
    // 1/16 and 1/4 + 3/16, with the covariance (1 - 1/4) sqrt(3) / 4. Standard errors below 4e-3.
    const PlaneMoments m = plane_moments(*mapping("ellipse:axes=[2,1],rotation=30"));
    EXPECT_NEAR(m.x, 0, 0.015);
    EXPECT_NEAR(m.y, 0, 0.011);
    EXPECT_NEAR(m.xx, 13. / 16, 0.015);
    EXPECT_NEAR(m.yy, 7. / 16, 0.01);
    EXPECT_NEAR(m.xy, 0.1875 * std::sqrt(3), 0.01);
}

TEST(Ellipse, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("ellipse:method=concentric")->domain()->spec(), "ellipse");
    const DomainPtr domain = mapping(tilted("concentric"))->domain();
    EXPECT_EQ(domain->spec(), "ellipse:axes=[1,3],rotation=30,center=[5,-7]");
    EXPECT_EQ(mapping(domain->spec())->domain()->spec(), domain->spec());
    const DomainPtr upright = mapping("ellipse:axes=[4,1],rotation=90,center=[1,1]")->domain();
    EXPECT_EQ(upright->bounding_box(), (Box{{0, -3}, {2, 5}}));
    EXPECT_TRUE(upright->contains(std::vector{1.0, 5.0}));
    EXPECT_TRUE(upright->contains(std::vector{2.0, 1.0}));
    EXPECT_FALSE(upright->contains(std::vector{1.0, 5.0 + 1e-13}));
    EXPECT_FALSE(upright->contains(std::vector{2.0 + 1e-13, 1.0}));
    EXPECT_FALSE(upright->contains(std::vector{NAN, 1.0}));
}

TEST(Ellipse, RefusesWhatIsNoEllipse) {
    const auto error = [](std::string_view spec) { return error_of([&] { mapping(spec); }); };
    EXPECT_EQ(error("ellipse:axes=[1,2,3]"), "usage: --axes: expected 2 numbers, a,b; 3 given");
    EXPECT_EQ(error("ellipse:axes=[1,0]"), "usage: --axes: 0 is outside [1e-150, 1e150]");
    EXPECT_EQ(error("ellipse:axes=[1,1e-20]"), "usage: --axes: 1e-20 is lost in rounding beside 1");
    EXPECT_EQ(
        error("ellipse:center=[0,1e30]"),
        "usage: --center: 1e+30 is so far from 0 that a semi-axis of 0.5 is lost in rounding");
    EXPECT_NE(error("ellipse:method=naive"), "");
}

// GCC 12 contracts a c - b s next to a s + b c to fused multiply-adds despite the flags, so that
// points would differ between processors. Here the formula is evaluated for one point at a time.
TEST(Ellipse, IsTurnedByPlainMultiplicationsAndAdditions) {
    const PointSet cube = make("random", points(1000, 2));
    const PointSet level = warped(*mapping("ellipse"), cube);
    const PointSet turned = warped(*mapping("ellipse:rotation=30"), cube);
    const auto [c, s] = cos_sin_turns(30 / 360.0);
    for (std::size_t i = 0; i < cube.count(); ++i) {
        const double x = level[i][0];
        const double y = level[i][1];
        ASSERT_EQ(turned[i][0], c * x - s * y) << i;
        ASSERT_EQ(turned[i][1], s * x + c * y) << i;
    }
}

}  // namespace stipple::testing::ellipse_test
