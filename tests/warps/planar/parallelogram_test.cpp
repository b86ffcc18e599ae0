// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "support/planar.hpp"

namespace stipple::testing::parallelogram_test {
namespace {

const char* skew = "parallelogram:corner=[10,20],edges=[3,1 -1,2]";
const char* in_space = "parallelogram:corner=[1,0,0],edges=[-1,2,0 -1,0,3]";

}  // namespace

TEST(Parallelogram, PointsByHand) {
    EXPECT_EQ(image_of("parallelogram", {0.25, 0.75}), (std::vector{0.25, 0.75}));
    EXPECT_EQ(image_of(skew, {0, 0}), (std::vector{10.0, 20.0}));
    EXPECT_EQ(image_of(skew, {1, 1}), (std::vector{12.0, 23.0}));
    EXPECT_EQ(image_of(skew, {0.5, 0.25}), (std::vector{11.25, 21.0}));
    EXPECT_EQ(image_of(in_space, {0.5, 0.25}), (std::vector{0.25, 1.0, 0.75}));
    EXPECT_EQ(image_of("parallelogram:edges=[1,0,0 0,0,1]", {0.5, 0.25}),
              (std::vector{0.5, 0.0, 0.25}))
        << "the origin of space, when the corner is not given";
}

TEST(Parallelogram, RoundTripOverTheWholeSquare) {
    expect_round_trip(*mapping("parallelogram"), 1e-15);
    expect_round_trip(*mapping(skew), 25e-14);
    expect_round_trip(*mapping(in_space), 3e-14);
    expect_round_trip(*mapping("parallelogram:edges=[1,0 0.999,1e-3]"), 1e-11);
    expect_round_trip(*mapping("parallelogram:edges=[1e149,0 0,1e149]"), 1e135);
    expect_round_trip(*mapping("parallelogram:edges=[1e-130,0 0,1e-130]"), 1e-144);
    expect_unit_coordinates_back(*mapping("parallelogram:edges=[3,1 -1,2]"), 1e-14);
    expect_unit_coordinates_back(*mapping(in_space), 1e-14);
    expect_stands_hostile_points(*mapping(skew), 25e-14);
    expect_stands_hostile_points(*mapping(in_space), 3e-14);
}

TEST(Parallelogram, DensityIsOneOverTheArea) {
    EXPECT_DOUBLE_EQ(mapping(skew)->domain()->measure(), 7);      // 3 2 - 1 (-1)
    EXPECT_DOUBLE_EQ(mapping(in_space)->domain()->measure(), 7);  // |(6, 3, 2)|
    EXPECT_EQ(mapping("parallelogram")->density(std::vector{1.1, 0.5}), 0);
    expect_density_is_one_over_jacobian(*mapping(skew));
    expect_density_is_one_over_jacobian(*mapping(in_space));
    expect_measure_is_share_of_box(*mapping(skew)->domain());
}

TEST(Parallelogram, IsUniformByArea) {
    expect_chi_square_can_tell(*mapping(skew));
    expect_chi_square_can_tell(*mapping(in_space));
    // Covariance (a a' + b b') / 12 of edges (3, 1) and (-1, 2).
    const PlaneMoments m = plane_moments(*mapping(skew));
    EXPECT_NEAR(m.x, 11, 0.0145);
    EXPECT_NEAR(m.y, 21.5, 0.0103);
    EXPECT_NEAR(m.xx, 10. / 12, 0.012);
    EXPECT_NEAR(m.yy, 5. / 12, 0.006);
    EXPECT_NEAR(m.xy, 1. / 12, 0.01);
}

TEST(Parallelogram, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("parallelogram")->domain()->spec(), "parallelogram");
    for (const char* spec : {skew, in_space}) EXPECT_EQ(mapping(spec)->domain()->spec(), spec);
    const DomainPtr domain = mapping(skew)->domain();
    EXPECT_EQ(domain->bounding_box(), (Box{{9, 20}, {13, 23}}));
    for (const auto& p : {std::vector{10.0, 20.0}, {13.0, 21.0}, {9.0, 22.0}, {12.0, 23.0}})
        EXPECT_TRUE(domain->contains(p)) << p[0];
    for (const auto& p : {std::vector{10.0, 20.0 - 1e-12}, {12.0, 23.0 + 1e-12}, {NAN, 21.0}})
        EXPECT_FALSE(domain->contains(p)) << p[0];
    const DomainPtr space = mapping(in_space)->domain();
    EXPECT_EQ(space->dimension(), 3U);
    EXPECT_TRUE(space->contains(std::vector{0.25, 1.0, 0.75}));
    EXPECT_FALSE(space->contains(std::vector{0.25, 1.0, 0.75 + 1e-12})) << "off the plane";
}

TEST(Parallelogram, RefusesWhatIsNoParallelogram) {
    const auto error = [](std::string_view spec) { return error_of([&] { mapping(spec); }); };
    EXPECT_EQ(error("parallelogram:edges=[1,1 2,2]"),
              "usage: --edges: the area of the parallelogram 1,1 2,2 is 0 or lost in rounding");
    EXPECT_NE(error("parallelogram:edges=[0.1,0.1 0.3,0.3]"), "") << "flat but for rounding";
    EXPECT_NE(error("parallelogram:edges=[0,0 1,0]"), "");
    EXPECT_EQ(error("parallelogram:edges=[1,0]"),
              "usage: --edges: 1 vectors of dimension 2; expected 2 vectors of dimension 2 or 3");
    EXPECT_EQ(error("parallelogram:corner=[0,0,0]"),
              "usage: --corner: expected 2 numbers, as many as the edges have; 3 given");
    EXPECT_NE(error("parallelogram:corner=[1e30,0]"), "") << "lost in rounding";
    EXPECT_NE(error("parallelogram:edges=[1e200,0 0,1]"), "");
    EXPECT_EQ(error_of([] {
                  inverse_of(*mapping("parallelogram"), {1.5, 0});
              }),
              "input: the point (1.5, 0) is outside the domain parallelogram");
}

}  // namespace stipple::testing::parallelogram_test
