// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::henyey_greenstein_test {
namespace {

const std::vector<std::string> lobes = {"0",   "1e-12", "1e-300", "-1e-9",   "0.5",     "-0.5",
                                        "0.9", "-0.9",  "0.9999", "-0.9999", "0.999999"};

}  // namespace

// The textbook's inverse for the fraction eta, counted from the back: cos theta = (1 + g^2 - ((1 -
// g^2) / (1 - g + 2 g eta))^2) / (2 g).
TEST(HenyeyGreenstein, CosineIsTheTextbooks) {
    for (const double g : {0.3, -0.3, 0.8, -0.8})
        for (const double xi : {0.0, 0.1, 0.5, 0.77, 1.0}) {
            const auto map = mapping("henyey-greenstein:g=" + std::to_string(g));
            const double ratio = (1 - g * g) / (1 - g + 2 * g * (1 - xi));
            EXPECT_NEAR(image_of(*map, {xi, 0.2})[2], (1 + g * g - ratio * ratio) / (2 * g), 1e-14)
                << g << " " << xi;
        }
}

TEST(HenyeyGreenstein, NumbersByHand) {
    const auto uniform = mapping("henyey-greenstein:g=0");
    EXPECT_EQ(image_of(*uniform, {0, 0.3}), (std::vector{0.0, 0.0, 1.0}));
    EXPECT_EQ(image_of(*uniform, {0.5, 0.25}), (std::vector{0.0, 1.0, 0.0}));
    EXPECT_EQ(image_of(*uniform, {1, 0.3}), (std::vector{0.0, 0.0, -1.0}));
    EXPECT_DOUBLE_EQ(uniform->density(std::vector{0.0, 1.0, 0.0}), 1 / (4 * std::numbers::pi));
    const auto half = mapping("henyey-greenstein:g=0.5");  // forward density (3/4) / (4 pi (1/2)^3)
    EXPECT_DOUBLE_EQ(half->density(std::vector{0.0, 0.0, 1.0}), 1.5 / std::numbers::pi);
    const auto along_x = mapping("henyey-greenstein:axis=[2,0,0]");
    EXPECT_EQ(image_of(*along_x, {0, 0.3}), (std::vector{1.0, 0.0, 0.0}));
}

TEST(HenyeyGreenstein, RoundTripOverTheWholeSquare) {
    for (const auto& g : lobes) {
        SCOPED_TRACE(g);
        expect_round_trip(*mapping("henyey-greenstein:g=" + g), 1e-14);
        expect_round_trip(*mapping("henyey-greenstein:axis=[1,-2,-3],g=" + g), 1e-14);
    }
}

TEST(HenyeyGreenstein, UnitCoordinatesComeBack) {
    const PointSet cube = telling_points();
    for (const auto& g : lobes) {
        const auto map = mapping("henyey-greenstein:g=" + g);
        for (std::size_t i = 0; i < cube.count(); ++i) {
            const auto back = inverse_of(*map, image_of(*map, {cube[i][0], cube[i][1]}));
            ASSERT_NEAR(back[0], cube[i][0], 1e-13) << g;
            if (cube[i][0] > 1e-290 && cube[i][0] < 1 && cube[i][1] < 1) {
                ASSERT_NEAR(back[1], cube[i][1], 1e-13) << g << " " << cube[i][0];
                ASSERT_NEAR(back[0] / cube[i][0], 1, 1e-13) << g << " " << cube[i][0];
            }
        }
    }
}

TEST(HenyeyGreenstein, DensityIsOneOverTheStretchAndIntegratesToOne) {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
    for (const auto& g : lobes) {
        SCOPED_TRACE(g);
        const auto map = mapping("henyey-greenstein:g=" + g);
        if (std::abs(std::stod(g)) < 0.99)
            expect_density_is_one_over_stretch(*mapping("henyey-greenstein:axis=[1,-2,-3],g=" + g),
                                               1e-4);
        const auto ring = [&](double angle) {
            return 2 * std::numbers::pi * std::sin(angle) *
                   map->density(std::vector{std::sin(angle), 0.0, std::cos(angle)});
        };
        EXPECT_NEAR(Rule::integrate(ring, 0.0, std::numbers::pi, 25, 1e-11), 1, 1e-8);
    }
}

// The mean cosine is g; its variance for g = 0.5 is (1 + 2 g^2) / 3 - g^2 = 1/4: 5 standard errors
// of 1e5 points are 0.008, false alarm 1e-6.
TEST(HenyeyGreenstein, MeanCosineIsG) {
    const PointSet w =
        warped(*mapping("henyey-greenstein:g=0.5"), make("random", points(100'000, 2)));
    double sum = 0;
    for (std::size_t i = 0; i < w.count(); ++i) sum += w[i][2];
    EXPECT_NEAR(sum / 1e5, 0.5, 0.008);
}

// False alarm 1e-4 each.
TEST(HenyeyGreenstein, ChiSquareAcceptsItAndRejectsWrongOnes) {
    const auto map = mapping("henyey-greenstein:g=0.7,axis=[0,1,1]");
    EXPECT_GT(p_of_random(*map, 200'000), 1e-4);
    PointSet other = warped(*mapping("henyey-greenstein:g=0.69,axis=[0,1,1]"),
                            make("random", points(200'000, 2)));
    other.domain = map->domain();
    EXPECT_LT(measure("chi-square", "p_upper", other), 1e-4);
    PointSet turned =
        warped(*mapping("henyey-greenstein:g=0.7"), make("random", points(200'000, 2)));
    turned.domain = map->domain();
    EXPECT_LT(measure("chi-square", "p_upper", turned), 1e-4);
}

TEST(HenyeyGreenstein, DomainSaysWhatItIsAndRefusesTheRest) {
    EXPECT_EQ(mapping("henyey-greenstein")->domain()->spec(), "henyey-greenstein");
    const DomainPtr law = mapping("henyey-greenstein:g=-0.2,axis=[0,0,-1]")->domain();
    EXPECT_EQ(law->spec(), "henyey-greenstein:g=-0.2,axis=[0,0,-1]");
    EXPECT_DOUBLE_EQ(law->measure(), 4 * std::numbers::pi);
    EXPECT_FALSE(law->contains(std::vector{0.0, 0.0, 1.001}));
    EXPECT_EQ(law->density(std::vector{0.0, 0.0, 0.5}), 0);
    EXPECT_EQ(error_of([] { mapping("henyey-greenstein:g=1"); }),
              "usage: --g: 1 is outside [-0.999999, 0.999999]");
    EXPECT_EQ(error_of([] { mapping("henyey-greenstein:axis=[0,0,0]"); }),
              "usage: --axis: 0,0,0 has no direction");
}

}  // namespace stipple::testing::henyey_greenstein_test
