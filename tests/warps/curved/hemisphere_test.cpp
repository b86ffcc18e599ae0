// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::hemisphere_test {
namespace {

constexpr double pi = std::numbers::pi;
using Point = std::vector<double>;

const std::string all_methods[] = {"hemisphere:method=uniform",
                                   "hemisphere:method=cosine",
                                   "hemisphere:method=cosine,disk=concentric",
                                   "hemisphere:method=cosine-power,exponent=0",
                                   "hemisphere:method=cosine-power,exponent=0.5",
                                   "hemisphere:method=cosine-power,exponent=20",
                                   "hemisphere:method=cosine-power,exponent=1e6"};

void expect_near(const Point& p, const Point& q, double tolerance) {
    for (std::size_t k = 0; k < p.size(); ++k) EXPECT_NEAR(p[k], q[k], tolerance) << k;
}

/// Mean of the cosine of the angle from z.
double mean_cosine(const std::string& spec) {
    const PointSet image = warped(*mapping(spec), make("random", points(100'000, 2)));
    double sum = 0;
    for (std::size_t i = 0; i < image.count(); ++i) sum += image[i][2];
    return sum / 1e5;
}

}  // namespace

TEST(Hemisphere, PointsByHand) {
    const double h = std::sqrt(0.75);
    EXPECT_EQ(image_of(*mapping("hemisphere"), {0, 0.3}), (Point{0, 0, 1}));
    EXPECT_EQ(image_of(*mapping("hemisphere"), {0.5, 0.25}), (Point{0, h, 0.5}));
    EXPECT_EQ(image_of(*mapping("hemisphere"), {1, 0}), (Point{1, 0, 0}));
    EXPECT_EQ(image_of(*mapping(all_methods[1]), {0.75, 0.5}), (Point{-h, 0, 0.5}));
    EXPECT_EQ(image_of(*mapping(all_methods[1]), {1, 0}), (Point{1, 0, 0}));
    EXPECT_EQ(image_of(*mapping(all_methods[2]), {0.5, 0.5}), (Point{0, 0, 1}));
    EXPECT_EQ(image_of(*mapping(all_methods[2]), {0.75, 0.5}), (Point{0.5, 0, h}));
    EXPECT_EQ(image_of(*mapping(all_methods[2]), {0, 0.5}), (Point{-1, 0, 0}));
    // cos theta = (1 - xi0)^(1/3)
    expect_near(image_of(*mapping("hemisphere:method=cosine-power,exponent=2"), {0.875, 0.25}),
                {0, h, 0.5}, 2e-16);
    EXPECT_EQ(image_of(*mapping(all_methods[6]), {1, 0}), (Point{1, 0, 0}));
    expect_near(image_of(*mapping("hemisphere:axis=[0,3,0]"), {0, 0}), {0, 1, 0}, 1e-16);
    expect_near(image_of(*mapping("hemisphere:axis=[0,0,-1]"), {0.5, 0}), {h, 0, -0.5}, 1e-16);
}

TEST(Hemisphere, PowersZeroAndOneAreTheOtherMethods) {
    const Rng rng(3);
    for (std::uint64_t i = 0; i < 200; i += 2) {
        const Point xi = {rng.uniform(i), rng.uniform(i + 1)};
        expect_near(image_of(*mapping(all_methods[3]), xi), image_of(*mapping("hemisphere"), xi),
                    3e-16);
        expect_near(image_of(*mapping("hemisphere:method=cosine-power,exponent=1"), xi),
                    image_of(*mapping("hemisphere:method=cosine"), xi), 3e-16);
    }
}

TEST(Hemisphere, RoundTripOverTheWholeSquare) {
    for (const auto& spec : all_methods) {
        SCOPED_TRACE(spec);
        expect_round_trip(*mapping(spec), 1e-14);
        expect_round_trip(*mapping(spec + ",axis=[1,2,-3]"), 1e-14);
    }
}

TEST(Hemisphere, UnitCoordinatesComeBackAboutZ) {
    const PointSet cube = telling_points();
    for (const auto& spec : all_methods) {
        const auto map = mapping(spec);
        for (std::size_t i = 0; i < cube.count(); ++i) {
            const Point xi(cube[i].begin(), cube[i].end());
            const Point image = image_of(*map, xi);
            const Point back = inverse_of(*map, image);
            EXPECT_NEAR(back[0], xi[0], 1e-14) << spec << " " << xi[1];
            const bool polar = spec.find("concentric") == std::string::npos;
            if (!polar || (xi[1] < 1 && xi[0] > 1e-250)) {
                EXPECT_NEAR(back[1], xi[1], 1e-14) << spec << " " << xi[0];
            }
        }
    }
}

TEST(Hemisphere, DensityByHandAndByStretch) {
    for (const auto& spec : all_methods)
        if (spec != all_methods[6])  // too narrow for differences of 1e-5
            expect_density_is_one_over_stretch(*mapping(spec + ",axis=[1,2,-3]"), 1e-5);
    const Point tilted = {std::sqrt(0.75), 0, 0.5};
    EXPECT_DOUBLE_EQ(mapping("hemisphere")->density(tilted), 1 / (2 * pi));
    EXPECT_DOUBLE_EQ(mapping(all_methods[1])->density(tilted), 0.5 / pi);
    EXPECT_DOUBLE_EQ(mapping("hemisphere:method=cosine-power,exponent=3")->density(tilted),
                     4 / (2 * pi) / 8);
    EXPECT_EQ(mapping("hemisphere")->density(Point{0, 0, -1}), 0);
    EXPECT_EQ(mapping("hemisphere")->density(Point{0, 0, 0.5}), 0);
}

// E cos theta: 1/2 uniform, 2/3 cosine, (k + 1)/(k + 2) for a power; standard errors of 1e5 points
// are below 9.2e-4; 5 of them, false alarm 6e-7 each.
TEST(Hemisphere, MeanCosine) {
    EXPECT_NEAR(mean_cosine(all_methods[0]), 1. / 2, 4.6e-3);
    EXPECT_NEAR(mean_cosine(all_methods[1]), 2. / 3, 4.6e-3);
    EXPECT_NEAR(mean_cosine(all_methods[2]), 2. / 3, 4.6e-3);
    EXPECT_NEAR(mean_cosine(all_methods[5]), 21. / 22, 4.6e-3);
}

// False alarm 1e-5 for each right one. Wrong: uniform directions instead of cosine, and another
// power.
TEST(Hemisphere, ChiSquareAcceptsTheRightLawAndRejectsOthers) {
    for (const auto& spec : all_methods) {
        EXPECT_GT(p_of_random(*mapping(spec), 50'000), 1e-5) << spec;
        EXPECT_GT(p_of_random(*mapping(spec + ",axis=[1,2,-3]"), 50'000), 1e-5) << spec;
    }
    const auto of_another_law = [](const std::string& points_of, const std::string& law) {
        PointSet image = warped(*mapping(points_of), make("random", points(100'000, 2)));
        image.domain = mapping(law)->domain();
        return measure("chi-square", "p_value", image);
    };
    EXPECT_LT(of_another_law(all_methods[0], all_methods[1]), 1e-100);
    EXPECT_LT(of_another_law("hemisphere:method=cosine-power,exponent=21", all_methods[5]), 1e-5);
    EXPECT_LT(of_another_law(all_methods[5] + ",axis=[0.03,0,1]", all_methods[5]), 1e-5);
}

TEST(Hemisphere, DomainSaysItsLawAndParsesBack) {
    EXPECT_EQ(mapping("hemisphere:exponent=3")->domain()->spec(), "hemisphere");
    EXPECT_EQ(mapping(all_methods[2])->domain()->spec(), all_methods[1]);
    const std::string power = "hemisphere:method=cosine-power,exponent=20,axis=[1,0,0]";
    EXPECT_EQ(mapping(power)->domain()->spec(), power);
    const DomainPtr domain = mapping("hemisphere:axis=[1,0,0]")->domain();
    EXPECT_DOUBLE_EQ(domain->measure(), 2 * pi);
    EXPECT_EQ(domain->bounding_box(), (Box{{0, -1, -1}, {1, 1, 1}}));
    EXPECT_TRUE(domain->contains(Point{0, 1, 0}));
    EXPECT_FALSE(domain->contains(Point{-1e-13, 1, 0}));
    EXPECT_FALSE(domain->contains(Point{std::nan(""), 0, 0}));
    EXPECT_EQ(error_of([&] {
                  inverse_of(*mapping("hemisphere"), {0, 0, -1});
              }),
              "input: the point (0, 0, -1) is outside the domain hemisphere");
}

TEST(Hemisphere, RefusesOptionsOutOfRange) {
    EXPECT_EQ(error_of([] { mapping("hemisphere:exponent=-1"); }),
              "usage: --exponent: -1 is outside [0, 1000000]");
    EXPECT_EQ(error_of([] { mapping("hemisphere:axis=[0,0,0]"); }),
              "usage: --axis: 0,0,0 has no direction");
    EXPECT_NE(error_of([] { mapping("hemisphere:method=sine"); }), "");
}

}  // namespace stipple::testing::hemisphere_test
