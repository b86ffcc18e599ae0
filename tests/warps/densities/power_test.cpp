// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "support/warping.hpp"

namespace stipple::testing::power_test {
namespace {

std::unique_ptr<Mapping> on_line(std::string_view text) {
    const Spec spec = parse_spec(text);
    const Warp& warp = find_warp(spec.name);
    return warp.make(spec.values(warp.options), 1, {});
}

double at(std::string_view spec, double u) { return image_of(*on_line(spec), {u})[0]; }

const std::vector<std::string> specs = {
    "power",
    "power:exponent=2,range=[-1,1]",
    "power:exponent=0,range=[-3,5]",
    "power:exponent=4,range=[-1,2]",
    "power:exponent=1,range=[0,2]",
    "power:exponent=0.5,range=[0,2]",
    "power:exponent=-0.5,range=[0,4]",
    "power:exponent=7.25,range=[1,3]",
    "power:exponent=-1,range=[1,10]",
    "power:exponent=-1.000001,range=[0.5,10]",
    "power:exponent=-2,range=[-3,-1]",
    "power:exponent=2,range=[-3,-1]",
    "power:exponent=-3.5,range=[0.01,1]",
    "power:exponent=300,range=[0.5,1]",
    "power:exponent=-300,range=[0.5,1]",
    "power:exponent=1000,range=[0,1e-3]",
    "power:exponent=1,range=[1,1.0001]",
};

}  // namespace

// 3 x^2 / 2 on [-1, 1]: x = cbrt(2 xi - 1).
TEST(Power, CubeRootByHand) {
    const std::string spec = "power:exponent=2,range=[-1,1]";
    EXPECT_EQ(at(spec, 0), -1);
    EXPECT_EQ(at(spec, 0.5), 0);
    EXPECT_FALSE(std::signbit(at(spec, 0.5)));
    EXPECT_EQ(at(spec, 0.5625), 0.5);
    EXPECT_EQ(at(spec, 0.4375), -0.5);
    EXPECT_EQ(at(spec, 1), 1);
    EXPECT_DOUBLE_EQ(at(spec, 0.5 + 1e-10), std::cbrt(2 * (0.5 + 1e-10) - 1));
    EXPECT_DOUBLE_EQ(on_line(spec)->density(std::vector{0.5}), 0.375);
}

TEST(Power, OtherNumbersByHand) {
    EXPECT_EQ(at("power", 0.125), 0.5);
    EXPECT_EQ(at("power:exponent=1", 0.25), 0.5);
    EXPECT_EQ(at("power:exponent=0,range=[2,6]", 0.25), 3);
    EXPECT_DOUBLE_EQ(at("power:exponent=-0.5,range=[0,4]", 0.5), 1);     // 4 xi^2
    EXPECT_DOUBLE_EQ(at("power:exponent=-1,range=[1,16]", 0.25), 2);     // 16^xi
    EXPECT_DOUBLE_EQ(at("power:exponent=-2,range=[1,2]", 0.5), 4 / 3.);  // 1 / (1 - xi / 2)
    EXPECT_DOUBLE_EQ(at("power:exponent=-2,range=[-2,-1]", 0.5), -4 / 3.);
    EXPECT_DOUBLE_EQ(at("power:exponent=1,range=[1,3]", 0.375), 2);  // sqrt(1 + 8 xi)
    EXPECT_DOUBLE_EQ(on_line("power:exponent=-1,range=[1,16]")->density(std::vector{2.0}),
                     0.5 / std::log(16));
}

TEST(Power, RoundTripOverTheWholeInterval) {
    for (const auto& spec : specs) {
        SCOPED_TRACE(spec);
        const auto map = on_line(spec);
        const PointSet cube = telling_points(1);
        const auto box = map->domain()->bounding_box();
        const bool hard =
            spec.find("1.0001") != std::string::npos || spec.find("00,") != std::string::npos;
        const double tolerance = hard ? 1e-11 : 1e-13;
        double last = box.low[0];
        for (const double edge : {0.0, 1.0})
            EXPECT_NEAR(image_of(*map, {edge})[0], edge == 0 ? box.low[0] : box.high[0],
                        1e-14 * (box.high[0] - box.low[0]) + 1e-15 * box.high[0]);
        for (std::size_t i = 0; i < cube.count(); ++i) {
            const auto x = image_of(*map, {cube[i][0]});
            ASSERT_TRUE(map->domain()->contains(x)) << cube[i][0] << " " << x[0];
            const auto back = inverse_of(*map, x);
            ASSERT_NEAR(back[0], cube[i][0], tolerance) << x[0];
        }
        for (int k = 0; k <= 1000; ++k) {
            const double x = image_of(*map, {k / 1000.0})[0];
            ASSERT_GE(x, last) << k;
            last = x;
        }
    }
}

TEST(Power, DensityIsOneOverTheStretchAndIntegratesToOne) {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
    for (const auto& spec : specs) {
        SCOPED_TRACE(spec);
        const auto map = on_line(spec);
        const auto box = map->domain()->bounding_box();
        const auto density = [&](double x) { return map->density(std::vector{x}); };
        if (spec.find("0.001") == std::string::npos) expect_density_is_one_over_stretch(*map, 1e-3);
        if (spec.find("-0.5") == std::string::npos) {  // infinite at 0
            EXPECT_NEAR(Rule::integrate(density, box.low[0], box.high[0], 12, 1e-12), 1, 1e-9);
        }
    }
}

// E x^2 = 3/5, P(|x| < 1/2) = 1/8. 2e5 numbers, var x^2 = 3/7 - 9/25: 5 standard errors are 0.003
// and 0.0037: false alarm 1e-6 each.
TEST(Power, MomentsAreRight) {
    const PointSet x =
        warped(*mapping("power:exponent=2,range=[-1,1]"), make("random", points(100'000, 2)));
    double square = 0, inner = 0;
    for (const double v : x.flat()) {
        square += v * v / 2e5;
        inner += std::abs(v) < 0.5;
    }
    EXPECT_NEAR(square, 0.6, 0.003);
    EXPECT_NEAR(inner / 2e5, 0.125, 0.0037);
}

// False alarm 1e-4 each.
TEST(Power, ChiSquareAcceptsItAndRejectsTheSlidesMistake) {
    for (const char* spec :
         {"power", "power:exponent=2,range=[-1,1]", "power:exponent=-1,range=[1,9]"})
        EXPECT_GT(p_of_random(*mapping(spec), 100'000), 1e-4) << spec;
    PointSet wrong = warped(*mapping("power:exponent=1"), make("random", points(100'000, 2)));
    wrong.domain = mapping("power")->domain();  // sqrt xi has density 2 x, not 3 x^2
    EXPECT_LT(measure("chi-square", "p_upper", wrong), 1e-4);
}

TEST(Power, DomainSaysWhatItIs) {
    const DomainPtr law = mapping("power:range=[-1,1]")->domain();
    EXPECT_EQ(law->spec(), "power:range=[-1,1]");
    EXPECT_EQ(law->measure(), 4);
    EXPECT_TRUE(law->contains(std::vector{-1.0, 1.0}));
    EXPECT_FALSE(law->contains(std::vector{-1.0, 1.0000001}));
    EXPECT_EQ(mapping("power")->domain()->spec(), "power");
}

TEST(Power, RefusesWhatHasNoDensity) {
    EXPECT_EQ(error_of([] { mapping("power:exponent=3,range=[-1,1]"); }),
              "usage: --exponent: x^3 is not positive on [-1, 1]; expected an even exponent for "
              "negative x");
    EXPECT_NE(error_of([] { mapping("power:exponent=0.5,range=[-2,-1]"); }), "");
    EXPECT_EQ(error_of([] { mapping("power:exponent=-1"); }),
              "usage: --exponent: x^-1 has no finite integral over [0, 1], which contains 0; "
              "expected an exponent above -1");
    EXPECT_NE(error_of([] { mapping("power:exponent=-2,range=[-1,1]"); }), "");
    EXPECT_EQ(error_of([] { mapping("power:exponent=-0.99"); }),
              "usage: --exponent: with x^-0.99 on a range that ends at 0, 0.000838 of the mass is "
              "below 2.2e-308, the smallest double; expected at least -0.9544 | or a range that "
              "starts above 0, such as at 1e-150");
    EXPECT_EQ(error_of([] { mapping("power:range=[1,1]"); }), "usage: --range: 1 is not below 1");
    EXPECT_EQ(error_of([] { mapping("power:range=[1,2,3]"); }),
              "usage: --range: expected 2 numbers, a,b; 3 given");
    EXPECT_NE(error_of([] { mapping("power:range=[1e-200,1]"); }), "");
    EXPECT_EQ(error_of([] { mapping("power:exponent=1e9"); }),
              "usage: --exponent: 1e9 is outside [-1000, 1000]");
}

// Near exponent -1 half of the mass is within a few decades of the lower end; nothing may
// underflow.
TEST(Power, ExponentsNearMinusOneKeepPointsAndDensities) {
    for (const char* spec :
         {"power:exponent=-0.99,range=[1e-150,1]", "power:exponent=-0.95", "power:exponent=-0.954",
          "power:exponent=-1.01,range=[1e-150,1]", "power:exponent=-1000,range=[1e-3,1]",
          "power:exponent=-5,range=[1e-100,1e100]"}) {
        const auto law = on_line(spec);
        for (const double u : {1e-12, 1e-3, 0.25, 0.5, 0.9, one_minus_ulp}) {
            const double x = image_of(*law, {u})[0];
            EXPECT_GT(x, 0) << spec << " at " << u;
            EXPECT_TRUE(law->domain()->contains(std::vector{x})) << spec << " at " << u;
            const double p = law->density(std::vector{x});
            EXPECT_TRUE(std::isfinite(p)) << spec << " at " << u;
            EXPECT_NEAR(inverse_of(*law, {x})[0], u, 1e-11) << spec << " at " << u;
        }
    }
    // 4 x^-5 / (a^-4 - b^-4) at a = 1e-100 is 4e100.
    EXPECT_NEAR(on_line("power:exponent=-5,range=[1e-100,1e100]")->density(std::vector{1e-100}),
                4e100, 1e88);
}

}  // namespace stipple::testing::power_test
