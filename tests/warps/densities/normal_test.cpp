// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/warping.hpp"

namespace stipple::testing::normal_test {
namespace {

// L = [2 0; 1 3].
const char* correlated = "normal:mean=[1,-2],covariance=[4,2,2,10]";

}  // namespace

// Phi^-1(0.975) = 1.95996398454005423552, Phi^-1(0.84134474606854...) = 1.
TEST(Normal, NumbersByHand) {
    EXPECT_EQ(image_of(*mapping("normal"), {0.5, 0.5}), (std::vector{0.0, 0.0}));
    EXPECT_EQ(image_of(*mapping("normal:mean=[3,4]"), {0.5, 0.5}), (std::vector{3.0, 4.0}));
    const auto p = image_of(*mapping("normal:deviation=[2,10],mean=1"), {0.975, 0.025});
    EXPECT_NEAR(p[0], 1 + 2 * 1.95996398454005423552, 5e-15);
    EXPECT_NEAR(p[1], 1 - 10 * 1.95996398454005423552, 3e-14);
    const auto q = image_of(*mapping(correlated), {0.8413447460685429486, 0.5});
    EXPECT_NEAR(q[0], 1 + 2, 1e-14);
    EXPECT_NEAR(q[1], -2 + 1, 1e-14);
    const auto r = image_of(*mapping(correlated), {0.5, 0.8413447460685429486});
    EXPECT_NEAR(r[0], 1, 1e-14);
    EXPECT_NEAR(r[1], -2 + 3, 1e-14);
}

TEST(Normal, EndsAreFiniteAndSymmetric) {
    const auto map = mapping("normal");
    const auto low = image_of(*map, {0, 5e-324});
    EXPECT_NEAR(low[0], -8.292361075813596, 1e-14);
    EXPECT_NEAR(low[1], -37.0470962993612, 1e-13);
    EXPECT_NEAR(image_of(*map, {1, 1})[0], 8.3744, 1e-3);
    EXPECT_LT(image_of(*map, {one_minus_ulp, 1})[0], -low[0]);
    EXPECT_EQ(image_of(*map, {one_minus_ulp, 0x1p-53})[0], -image_of(*map, {0x1p-53, 0x1p-53})[0]);
}

TEST(Normal, RoundTripOverTheWholeSquare) {
    expect_round_trip(*mapping("normal"), 4e-14);
    expect_round_trip(*mapping("normal:mean=[5,-7],deviation=[1e-3,2]"), 1e-13);
    expect_round_trip(*mapping(correlated), 4e-13);
}

TEST(Normal, UnitCoordinatesComeBackInBothTails) {
    const auto map = mapping("normal");
    const PointSet cube = telling_points();
    for (std::size_t i = 0; i < cube.count(); ++i) {
        const double u = cube[i][0];
        const auto back = inverse_of(*map, image_of(*map, {u, 0.25}));
        ASSERT_NEAR(back[0], u, 1e-15 + 5.6e-17) << u;
        if (u >= 1e-300 && u < 1) {
            const double z = image_of(*map, {u, 0.25})[0];
            ASSERT_NEAR(back[0] / u, 1, 2e-15 * std::max(50.0, z * z)) << u;
            ASSERT_NEAR((1 - back[0]) / (1 - u), 1, 1e-13 + 2e-16 / (1 - u)) << u;
        }
    }
}

TEST(Normal, DensityIsOneOverTheStretchAndIntegratesToOne) {
    expect_density_is_one_over_stretch(*mapping("normal"), 1e-5);
    expect_density_is_one_over_stretch(*mapping(correlated), 1e-5);
    EXPECT_DOUBLE_EQ(mapping("normal")->density(std::vector{0.0, 0.0}), 1 / (2 * std::numbers::pi));
    EXPECT_DOUBLE_EQ(mapping(correlated)->density(std::vector{3.0, -1.0}),
                     std::exp(-0.5) / (12 * std::numbers::pi));
    using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;
    const auto map = mapping(correlated);
    const double mass = Rule::integrate(
        [&](double x) {
            return Rule::integrate(
                [&](double y) {
                    return map->density(std::vector{x, y});
                },
                -40.0, 36.0, 5, 1e-9);
        },
        -19.0, 21.0, 5, 1e-9);
    EXPECT_NEAR(mass, 1, 1e-9);
}

// Covariances [4 2; 2 10]; standard errors of 1e5 points: means 0.0063, 0.01; second moments
// sqrt((C_ii C_jj + C_ij^2) / n) = 0.018, 0.021, 0.045. Five of each: false alarm 3e-6.
TEST(Normal, CovarianceIsTheOneAskedFor) {
    const PointSet x = warped(*mapping(correlated), make("random", points(100'000, 2)));
    double mean[2] = {}, cov[3] = {};
    for (std::size_t i = 0; i < x.count(); ++i) {
        const double a = x[i][0] - 1;
        const double b = x[i][1] + 2;
        mean[0] += a / 1e5;
        mean[1] += b / 1e5;
        cov[0] += a * a / 1e5;
        cov[1] += a * b / 1e5;
        cov[2] += b * b / 1e5;
    }
    EXPECT_NEAR(mean[0], 0, 0.032);
    EXPECT_NEAR(mean[1], 0, 0.05);
    EXPECT_NEAR(cov[0], 4, 0.09);
    EXPECT_NEAR(cov[1], 2, 0.105);
    EXPECT_NEAR(cov[2], 10, 0.225);
}

// False alarm 1e-4 each. Wrong: 1 % too wide, and swapped axes.
TEST(Normal, ChiSquareAcceptsItAndRejectsWrongOnes) {
    const auto map = mapping(correlated);
    EXPECT_GT(p_of_random(*map, 200'000), 1e-4);
    PointSet wide = warped(*mapping("normal"), make("random", points(1'000'000, 2)));
    for (double& x : wide.flat()) x *= 1.01;
    EXPECT_LT(measure("chi-square", "p_upper", wide), 1e-4);
    PointSet swapped = warped(*map, make("random", points(100'000, 2)));
    for (std::size_t i = 0; i < swapped.count(); ++i) std::swap(swapped[i][0], swapped[i][1]);
    EXPECT_LT(measure("chi-square", "p_upper", swapped), 1e-4);
}

// x_k depends only on xi_1 ... xi_k.
TEST(Normal, FactorIsLower) {
    const auto map = mapping(correlated);
    EXPECT_EQ(image_of(*map, {0.3, 0.1})[0], image_of(*map, {0.3, 0.9})[0]);
    EXPECT_NE(image_of(*map, {0.3, 0.1})[1], image_of(*map, {0.4, 0.1})[1]);
}

TEST(Normal, DomainSaysWhatItIs) {
    EXPECT_EQ(mapping("normal")->domain()->spec(), "normal");
    const DomainPtr law = mapping(correlated)->domain();
    EXPECT_EQ(law->spec(), correlated);
    EXPECT_EQ(law->measure(), std::numeric_limits<double>::infinity());
    EXPECT_TRUE(law->contains(std::vector{1e300, -1e300}));
    EXPECT_FALSE(law->contains(std::vector{1.0, double{NAN}}));
    const Box box = law->bounding_box();
    EXPECT_EQ(box.low[0], -7);
    EXPECT_EQ(box.high[0], 9);
    EXPECT_DOUBLE_EQ(box.high[1], -2 + 4 * std::sqrt(10));
    EXPECT_EQ(find_warp("gaussian").name, "normal");
}

TEST(Normal, TakesAnyDimension) {
    const Warp& unit = find_warp("normal");
    const auto map = unit.make(unit.options.defaults(), 5, {});
    EXPECT_EQ(map->cube_dimension(), 5U);
    EXPECT_EQ(image_of(*map, std::vector<double>(5, 0.5)), std::vector<double>(5, 0.0));
    EXPECT_EQ(mapping("normal:mean=[1,2,3]")->cube_dimension(), 3U);
}

TEST(Normal, RefusesWhatIsNoCovariance) {
    EXPECT_EQ(error_of([] { mapping("normal:covariance=[1,2,2,1]"); }),
              "usage: --covariance: not positive definite: its leading 2 x 2 minor is -3");
    EXPECT_EQ(error_of([] { mapping("normal:covariance=[1,2,3,9]"); }),
              "usage: --covariance: not symmetric: row 1 has 2, but row 2 has 3");
    EXPECT_EQ(error_of([] { mapping("normal:covariance=[1,2,3]"); }),
              "usage: --covariance: expected 2 x 2 numbers, row after row; 3 given");
    EXPECT_EQ(error_of([] { mapping("normal:deviation=0"); }),
              "usage: --deviation: 0 is outside [1e-150, 1e+150]");
    EXPECT_EQ(
        error_of([] { mapping("normal:mean=[1,2,3],deviation=[1,2]"); }),
        "usage: --deviation: 2 numbers for 3 coordinates; expected one for all, or one for each");
    EXPECT_EQ(error_of([] { mapping("normal:covariance=[1,0,0,1],deviation=2"); }),
              "usage: --deviation: cannot be combined with --covariance; give one of them");
    EXPECT_EQ(error_of([] { mapping("normal:mean=[0,1e100],deviation=[1,2]"); }),
              "usage: --mean: 1e+100 is so far from 0 that a deviation of 2 is lost in rounding");
    EXPECT_EQ(error_of([] {
                  inverse_of(*mapping("normal"), {NAN, 0});
              }),
              "input: the point (nan, 0) is outside the domain normal");
}

}  // namespace stipple::testing::normal_test
