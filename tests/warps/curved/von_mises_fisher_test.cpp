// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::von_mises_fisher_test {
namespace {

const std::vector<std::string> concentrations = {"0",  "1e-300", "1e-18", "1e-9", "1e-3", "1",
                                                 "10", "20",     "20.01", "40",   "1e4",  "1e8"};

}  // namespace

// cos theta = 1 + log(1 - xi (1 - exp(-2 kappa))) / kappa, in long double.
TEST(VonMisesFisher, CosineIsTheTextbooks) {
    for (const long double kappa : {1e-3L, 0.5L, 1.0L, 10.0L, 25.0L, 1000.0L})
        for (const double xi : {0.0, 0.1, 0.5, 0.77, 0.999}) {
            const auto map = mapping("vmf:kappa=" + std::to_string(kappa));
            const long double cosine = 1 + std::log1p(-xi * (1 - std::exp(-2 * kappa))) / kappa;
            EXPECT_NEAR(image_of(*map, {xi, 0.2})[2], static_cast<double>(cosine), 4e-15)
                << kappa << " " << xi;
        }
}

TEST(VonMisesFisher, NumbersByHand) {
    const auto uniform = mapping("vmf:kappa=0");
    EXPECT_EQ(image_of(*uniform, {0, 0.3}), (std::vector{0.0, 0.0, 1.0}));
    EXPECT_EQ(image_of(*uniform, {0.5, 0.25}), (std::vector{0.0, 1.0, 0.0}));
    EXPECT_EQ(image_of(*uniform, {1, 0.3}), (std::vector{0.0, 0.0, -1.0}));
    EXPECT_DOUBLE_EQ(uniform->density(std::vector{0.0, 1.0, 0.0}), 1 / (4 * std::numbers::pi));
    EXPECT_EQ(image_of(*mapping("vmf:kappa=1"), {1, 0.3})[2], -1);
    EXPECT_EQ(image_of(*mapping("vmf:axis=[0,-5,0]"), {0, 0.3}), (std::vector{0.0, -1.0, 0.0}));
    const double e = std::numbers::e;
    EXPECT_DOUBLE_EQ(mapping("vmf:kappa=1")->density(std::vector{0.0, 0.0, 1.0}),
                     e / (2 * std::numbers::pi * (e - 1 / e)));
    const auto last = image_of(*mapping("vmf:kappa=1e8"), {1, 0});
    EXPECT_NEAR(1 - last[2], 55 * std::numbers::ln2 / 1e8, 1e-15);
    EXPECT_NEAR(last[0], std::sqrt(110 * std::numbers::ln2 / 1e8), 1e-9);
}

TEST(VonMisesFisher, RoundTripOverTheWholeSquare) {
    for (const auto& kappa : concentrations) {
        SCOPED_TRACE(kappa);
        expect_round_trip(*mapping("vmf:kappa=" + kappa), 1e-14);
        expect_round_trip(*mapping("vmf:axis=[1,-2,-3],kappa=" + kappa), 1e-14);
    }
}

TEST(VonMisesFisher, UnitCoordinatesComeBack) {
    const PointSet cube = telling_points();
    for (const auto& kappa : concentrations) {
        const auto map = mapping("vmf:kappa=" + kappa);
        for (std::size_t i = 0; i < cube.count(); ++i) {
            const auto back = inverse_of(*map, image_of(*map, {cube[i][0], cube[i][1]}));
            ASSERT_NEAR(back[0], cube[i][0], 1e-13) << kappa;
            if (cube[i][0] > 1e-290 && cube[i][0] < 1 && cube[i][1] < 1) {
                ASSERT_NEAR(back[1], cube[i][1], 1e-13) << kappa << " " << cube[i][0];
                ASSERT_NEAR(back[0] / cube[i][0], 1, 1e-13) << kappa;
            }
        }
    }
}

TEST(VonMisesFisher, DensityIsOneOverTheStretchAndIntegratesToOne) {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
    for (const auto& kappa : concentrations) {
        SCOPED_TRACE(kappa);
        const auto map = mapping("vmf:kappa=" + kappa);
        if (std::stod(kappa) < 1e3)
            expect_density_is_one_over_stretch(*mapping("vmf:axis=[1,-2,-3],kappa=" + kappa), 1e-4);
        const auto ring = [&](double angle) {
            return 2 * std::numbers::pi * std::sin(angle) *
                   map->density(std::vector{std::sin(angle), 0.0, std::cos(angle)});
        };
        const double far = std::min(std::numbers::pi, 10 / std::sqrt(std::stod(kappa) + 1e-9));
        EXPECT_NEAR(Rule::integrate(ring, 0.0, far, 15, 1e-11), 1, 1e-8);
    }
}

// The mean cosine is coth kappa - 1 / kappa; for kappa = 2 its variance is
// 1 - (mean)^2 - 2 mean / kappa = 0.174: 5 standard errors of 1e5 points are 0.0067.
TEST(VonMisesFisher, MeanCosineIsLangevins) {
    const PointSet w = warped(*mapping("vmf:kappa=2"), make("random", points(100'000, 2)));
    double sum = 0;
    for (std::size_t i = 0; i < w.count(); ++i) sum += w[i][2];
    EXPECT_NEAR(sum / 1e5, 1 / std::tanh(2.0) - 0.5, 0.0067);
}

// False alarm 1e-4 each.
TEST(VonMisesFisher, ChiSquareAcceptsItAndRejectsWrongOnes) {
    const auto map = mapping("vmf:kappa=100,axis=[0,1,1]");
    EXPECT_GT(p_of_random(*map, 200'000), 1e-4);
    for (const char* spec : {"vmf:kappa=105,axis=[0,1,1]", "vmf:kappa=100,axis=[0,1,1.01]"}) {
        PointSet other = warped(*mapping(spec), make("random", points(200'000, 2)));
        other.domain = map->domain();
        EXPECT_LT(measure("chi-square", "p_upper", other), 1e-4) << spec;
    }
}

TEST(VonMisesFisher, DomainSaysWhatItIsAndRefusesTheRest) {
    EXPECT_EQ(mapping("vmf")->domain()->spec(), "von-mises-fisher");
    EXPECT_EQ(mapping("vmf:kappa=3,axis=[0,0,-1]")->domain()->spec(),
              "von-mises-fisher:kappa=3,axis=[0,0,-1]");
    EXPECT_EQ(error_of([] { mapping("vmf:kappa=-1"); }),
              "usage: --kappa: -1 is outside [0, 100000000]");
    EXPECT_EQ(error_of([] {
                  inverse_of(*mapping("vmf"), {0, 0, 2});
              }),
              "input: the point (0, 0, 2) is outside the domain von-mises-fisher");
}

}  // namespace stipple::testing::von_mises_fisher_test
