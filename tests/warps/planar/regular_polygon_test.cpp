// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/planar.hpp"

namespace stipple::testing::regular_polygon_test {
namespace {

const std::vector<std::string> shapes = {
    "regular-polygon:sides=3",
    "regular-polygon:sides=4,rotation=45",
    "regular-polygon",
    "regular-polygon:sides=7,radius=3,rotation=11,center=[1,-2]",
    "regular-polygon:sides=1000",
};

}  // namespace

TEST(RegularPolygon, PointsByHand) {
    EXPECT_EQ(image_of("regular-polygon", {0, 0.3}), (std::vector{0.0, 0.0}));
    EXPECT_EQ(image_of("regular-polygon", {0.25, 0}), (std::vector{0.5, 0.0}));
    const auto at = [](double u, double v) {
        return image_of("regular-polygon:sides=4,radius=2,center=[10,20]", {u, v});
    };
    EXPECT_EQ(at(1, 0.25), (std::vector{10.0, 22.0}));
    EXPECT_EQ(at(1, 0.125), (std::vector{11.0, 21.0})) << "the middle of a side";
    EXPECT_EQ(at(0.25, 0.8125), (std::vector{10.25, 19.25})) << "a quarter of the way";
    EXPECT_EQ(at(1, 1), (std::vector{12.0, 20.0})) << "once around";
    const auto top = image_of("regular-polygon:sides=3,rotation=90", {1, 0});
    EXPECT_EQ(top, (std::vector{0.0, 1.0}));
}

TEST(RegularPolygon, IsContinuousWhereSidesMeet) {
    const auto map = mapping("regular-polygon:sides=5");
    for (int k = 1; k < 5; ++k) {
        const auto before = image_of(*map, {0.7, std::nextafter(k / 5.0, 0)});
        const auto behind = image_of(*map, {0.7, std::nextafter(k / 5.0, 1)});
        for (const int axis : {0, 1}) EXPECT_NEAR(before[axis], behind[axis], 1e-14) << k;
    }
}

TEST(RegularPolygon, RoundTripOverTheWholeSquare) {
    for (const auto& spec : shapes) {
        SCOPED_TRACE(spec);
        expect_round_trip(*mapping(spec), 6e-14);
        expect_stands_hostile_points(*mapping(spec), 6e-14, 20'000);
    }
    expect_round_trip(*mapping("regular-polygon:radius=1e-150"), 1e-164);
    expect_unit_coordinates_back(*mapping("regular-polygon:sides=5"), 1e-14, 1e-290);
}

TEST(RegularPolygon, DensityIsOneOverTheArea) {
    EXPECT_DOUBLE_EQ(mapping("regular-polygon")->domain()->measure(), 1.5 * std::sqrt(3));
    EXPECT_DOUBLE_EQ(mapping("regular-polygon:sides=4,radius=3")->domain()->measure(), 18);
    EXPECT_EQ(mapping("regular-polygon:sides=4")->density(std::vector{0.6, 0.6}), 0);
    for (const auto& spec : shapes) {
        if (spec != shapes.back()) expect_density_is_one_over_jacobian(*mapping(spec));
        expect_measure_is_share_of_box(*mapping(spec)->domain());
    }
}

TEST(RegularPolygon, IsUniformByArea) {
    expect_chi_square_can_tell(*mapping(shapes[3]));
    // The square |x| + |y| <= 1 has variances 1/6, a hexagon with side 1 has 5/24.
    for (const auto& [spec, variance] : {std::pair{"regular-polygon:sides=4", 1. / 6},
                                         std::pair{"regular-polygon:rotation=17", 5. / 24}}) {
        const PlaneMoments m = plane_moments(*mapping(spec));
        EXPECT_NEAR(m.x, 0, 0.0075) << spec;
        EXPECT_NEAR(m.y, 0, 0.0075) << spec;
        EXPECT_NEAR(m.xx, variance, 0.003) << spec;
        EXPECT_NEAR(m.yy, variance, 0.003) << spec;
        EXPECT_NEAR(m.xy, 0, 0.003) << spec;
    }
}

TEST(RegularPolygon, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("regular-polygon")->domain()->spec(), "regular-polygon");
    const DomainPtr domain = mapping(shapes[3])->domain();
    EXPECT_EQ(domain->spec(), shapes[3]);
    const DomainPtr square = mapping("regular-polygon:sides=4")->domain();
    EXPECT_EQ(square->bounding_box(), (Box{{-1, -1}, {1, 1}}));
    for (const auto& p : {std::vector{0.0, 0.0}, {1.0, 0.0}, {0.5, 0.5}, {-0.5, 0.5}, {0.0, -1.0}})
        EXPECT_TRUE(square->contains(p)) << p[0];
    for (const auto& p : {std::vector{1 + 1e-13, 0.0}, {0.5, 0.5 + 1e-13}, {NAN, 0.0}, {9.0, 9.0}})
        EXPECT_FALSE(square->contains(p)) << p[0];
    std::vector<double> cube(2);
    square->to_cube(std::vector{-0.25, 0.25}, cube);
    EXPECT_DOUBLE_EQ(cube[0], 0.25);
    EXPECT_DOUBLE_EQ(cube[1], 0.375);
}

TEST(RegularPolygon, RefusesWhatIsNoPolygon) {
    const auto error = [](std::string_view spec) { return error_of([&] { mapping(spec); }); };
    EXPECT_EQ(error("regular-polygon:sides=2"), "usage: --sides: 2 is outside [3, 10000]");
    EXPECT_NE(error("regular-polygon:radius=0"), "");
    EXPECT_NE(error("regular-polygon:center=[1e30,0]"), "");
    EXPECT_EQ(error_of([] {
                  inverse_of(*mapping("regular-polygon:sides=4"), {0.75, 0.75});
              }),
              "input: the point (0.75, 0.75) is outside the domain regular-polygon:sides=4");
}

}  // namespace stipple::testing::regular_polygon_test
