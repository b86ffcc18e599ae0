// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/domain.hpp"
#include "support/warping.hpp"

namespace stipple::testing::mixture_test {
namespace {

const std::string lobes =
    "mixture:weights=[0.6,0.4],components=[von-mises-fisher:kappa=50,axis=[1,0,0]|"
    "henyey-greenstein:g=0.5]";
const std::string plane =
    "mixture:weights=[0.25,0.75],components=[normal:mean=3|normal:deviation=2]";

}  // namespace

TEST(Mixture, SelectsByWeightAndStretchesTheFirstCoordinate) {
    const auto map = mapping(lobes);
    const auto first = mapping("von-mises-fisher:kappa=50,axis=[1,0,0]");
    const auto second = mapping("henyey-greenstein:g=0.5");
    EXPECT_EQ(image_of(*map, {0, 0.3}), image_of(*first, {0, 0.3}));
    EXPECT_EQ(image_of(*map, {0.3, 0.7}), image_of(*first, {0.3 / 0.6, 0.7}));
    EXPECT_EQ(image_of(*map, {0.6, 0.7}), image_of(*second, {0, 0.7}));
    EXPECT_EQ(image_of(*map, {0.8, 0.7}), image_of(*second, {(0.8 - 0.6) / (1 - 0.6), 0.7}));
    EXPECT_EQ(image_of(*map, {1, 0.7}), image_of(*second, {one_minus_ulp, 0.7}));
}

TEST(Mixture, AComponentOfWeightZeroNeverComes) {
    const auto map =
        mapping("mixture:weights=[0,1,0],components=[normal:mean=100|normal|normal:mean=-100]");
    const PointSet cube = telling_points();
    for (std::size_t i = 0; i < cube.count(); ++i)
        ASSERT_LT(std::abs(image_of(*map, {cube[i][0], cube[i][1]})[0]), 38) << cube[i][0];
}

TEST(Mixture, DensityIsTheWeightedSum) {
    const auto map = mapping(plane);
    const double at = 1 / (2 * std::numbers::pi);
    EXPECT_DOUBLE_EQ(map->density(std::vector{3.0, 3.0}),
                     0.25 * at + 0.75 * at / 4 * std::exp(-9 / 4.));
    const auto sphere = mapping(lobes);
    const std::vector<double> x = {1, 0, 0};
    EXPECT_DOUBLE_EQ(sphere->density(x), 0.6 * mapping("vmf:kappa=50,axis=[1,0,0]")->density(x) +
                                             0.4 * mapping("henyey-greenstein:g=0.5")->density(x));
}

// 9 x 7 cells of the cube: the probabilities sum to 1, and random points fit them: 62 degrees of
// freedom, above 135 with probability 3e-7. A mixture with other weights does not fit.
TEST(Mixture, CellsHaveTheProbabilitiesOfThePoints) {
    for (const std::string& spec : {lobes, plane}) {
        const auto map = mapping(spec);
        const DomainPtr law = map->domain();
        EXPECT_FALSE(law->even());
        const auto statistic = [&](const PointSet& x) {
            std::vector<double> count(63), u(2);
            for (std::size_t i = 0; i < x.count(); ++i) {
                law->to_cube(x[i], u);
                const auto column = std::min(static_cast<std::size_t>(u[0] * 9), std::size_t{8});
                const auto row = std::min(static_cast<std::size_t>(u[1] * 7), std::size_t{6});
                count[7 * column + row] += 1;
            }
            double sum = 0, mass = 0;
            for (std::size_t c = 0; c < 63; ++c) {
                const auto i = static_cast<double>(c / 7);
                const auto j = static_cast<double>(c % 7);
                const auto p = law->probability({{i / 9, j / 7}, {(i + 1) / 9, (j + 1) / 7}});
                EXPECT_LT(p.error, 1e-5);
                mass += p.value;
                const double expected = std::max(p.value, 1e-12) * 1e5;
                if (expected > 5) sum += (count[c] - expected) * (count[c] - expected) / expected;
            }
            EXPECT_NEAR(mass, 1, 1e-6) << spec;
            return sum;
        };
        EXPECT_LT(statistic(warped(*map, make("random", points(100'000, 2)))), 135) << spec;
        const std::string other =
            "mixture:weights=[0.55,0.45]," + spec.substr(spec.find("components"));
        EXPECT_GT(statistic(warped(*mapping(other), make("random", points(100'000, 2)))), 135);
    }
}

/// Components of each kind of space that overlap, rotated and not centred.
const std::vector<std::string> overlapping = {
    "disk|disk:center=[1,0.25]",
    "triangle:vertices=[-1,-1 2,0 0,1]|disk",
    "annulus:inner=0.5|ellipse:axes=[2,0.5],rotation=30,center=[0.5,0]",
    "sector:angles=[20,120]|sector:angles=[-40,210],center=[1,1]",
    "regular-polygon:sides=5,rotation=10|parallelogram:corner=[0,0],edges=[1,0.5 -0.5,1]",
    "polygon:vertices=[0,0 2,0 2,2 1,0.5 0,2]|tent:radius=2",
    "normal:mean=[0,1],covariance=[1,0.8,0.8,2]|disk:center=[2,0]",
    "normal:mean=[3,0]|exponential",
    "power:exponent=2,range=[-1,1]|pixel:resolution=3x2",
    "cone:half-angle=40,axis=[1,1,0.5]|hemisphere:axis=[0,1,0.2]",
    "cone:half-angle=130,axis=[1,0,0]|hemisphere:method=cosine,axis=[1,2,3]",
    "spherical-triangle|spherical-rectangle",
    "hemisphere:method=cosine-power,exponent=7|von-mises-fisher:kappa=100,axis=[1,1,1]",
    "sphere|henyey-greenstein:g=0.8,axis=[1,0,0]"};

std::string half_and_half(const std::string& parts) { return "mixture:components=[" + parts + "]"; }

// Oracle: centres of 700 x 700 squares, half of which go to each component.
TEST(Mixture, MassesOfOverlappingShapesAreTheirShares) {
    constexpr std::size_t m = 700;
    PointSet centres(m * m, 2);
    for (std::size_t i = 0; i < m * m; ++i) {
        centres[i][0] = (static_cast<double>(i % m) + 0.5) / m;
        centres[i][1] = (static_cast<double>(i / m) + 0.5) / m;
    }
    for (const std::string& parts : overlapping) {
        const auto map = mapping(half_and_half(parts));
        const DomainPtr law = map->domain();
        std::vector<double> share(35), u(2);
        const PointSet x = warped(*map, centres);
        for (std::size_t i = 0; i < x.count(); ++i) {
            law->to_cube(x[i], u);
            const auto column = std::min(static_cast<std::size_t>(u[0] * 7), std::size_t{6});
            const auto row = std::min(static_cast<std::size_t>(u[1] * 5), std::size_t{4});
            share[5 * column + row] += 1.0 / (m * m);
        }
        double sum = 0;
        double error = 0;
        for (std::size_t c = 0; c < 35; ++c) {
            const auto i = static_cast<double>(c / 5);
            const auto j = static_cast<double>(c % 5);
            const auto p = law->probability({{i / 7, j / 5}, {(i + 1) / 7, (j + 1) / 5}});
            EXPECT_NEAR(p.value, share[c], 1.5e-3) << parts << ", cell " << c;
            sum += p.value;
            error += p.error;
        }
        EXPECT_LT(error, 1e-8) << parts;
        EXPECT_NEAR(sum, 1, error + 1e-13) << parts;
    }
}

TEST(Mixture, MassesOfSolidsAreTheirShares) {
    const DomainPtr one = mapping("mixture:weights=[1],components=ball")->domain();
    const auto mass = [&](std::vector<double> low, std::vector<double> high) {
        const Estimate p = one->box_mass({low, high}).value();
        EXPECT_LT(p.error, 1e-9);
        return p.value;
    };
    const double far = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(mass({-far, -far, -far}, {far, far, far}), 1, 1e-12);
    EXPECT_NEAR(mass({0, 0, 0}, {2, 2, 2}), 0.125, 1e-12);
    EXPECT_NEAR(mass({-2, -2, 0.5}, {2, 2, 1}), 5 / 32.0, 1e-12) << "a cap: h^2 (3 - h) / 4";
    EXPECT_NEAR(mass({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), 0.75 / std::numbers::pi, 1e-12);
    EXPECT_EQ(mass({1, 0, 0}, {2, 1, 1}), 0);
}

// False alarm 14 x 2e-6, by the level. The same points as samples of another mixture, 0.4 to 0.6,
// are rejected: noncentrality 2e5 (0.1 / 0.5)^2 times the fraction where the components differ, at
// least 0.02.
TEST(Mixture, ChiSquareTellsRightWeightsFromWrongOnes) {
    for (const std::string& parts : overlapping) {
        const auto verdict = [&](const std::string& spec) {
            PointSet x = warped(*mapping(spec), make("random", points(200'000, 2)));
            x.domain = mapping(half_and_half(parts))->domain();
            const Report found = analyze("chi-square", x, {{"level", "1e-6"}, {"cells", "11x7"}});
            EXPECT_LT(found.number("mass_error"), 1e-7) << parts;
            return found.text("verdict");
        };
        EXPECT_EQ(verdict(half_and_half(parts)), "uniform") << parts;
        EXPECT_EQ(verdict("mixture:weights=[0.4,0.6],components=[" + parts + "]"), "non-uniform")
            << parts;
    }
}

TEST(Mixture, DomainSpecParsesBackWithItsBrackets) {
    const DomainPtr law = mapping(lobes)->domain();
    EXPECT_EQ(law->spec(), lobes);
    EXPECT_EQ(mapping(law->spec())->domain()->spec(), law->spec());
    EXPECT_TRUE(law->contains(std::vector{0.0, 1.0, 0.0}));
    EXPECT_FALSE(law->contains(std::vector{0.0, 1.1, 0.0}));
}

TEST(Mixture, RefusesWhatCannotBeMixed) {
    EXPECT_EQ(error_of([] { mapping("mixture:components=[normal|vmf]"); }),
              "usage: --components: all must be of one kind; normal gives points that fill 2 "
              "dimensions, from 2 unit coordinates, but vmf gives directions in space, from 2");
    EXPECT_EQ(error_of([] { mapping("mixture:components=[disk:method=rejection|disk]"); }),
              "usage: --components: disk:method=rejection drops points, which would change the "
              "weights");
    EXPECT_EQ(error_of([] { mapping("mixture:components=[discrete|discrete]"); }),
              "usage: --components: discrete gives neither directions nor points that fill a "
              "space; expected one of these");
    EXPECT_EQ(
        error_of([] { mapping("mixture:weights=[0.5,0.4]"); }),
        "usage: --weights: the sum is 0.9; expected 1 | --normalize divides them by their sum");
    EXPECT_EQ(error_of([] { mapping("mixture:weights=1"); }),
              "usage: --weights: 1 given for 2 components; expected one for each");
    EXPECT_EQ(error_of([] {
                  inverse_of(*mapping("mixture"), {0, 0, 1});
              }),
              "usage: --inverse: this warp has no inverse");
}

TEST(Mixture, EndsWhereAllOfItsShapesDo) {
    const auto disks = mapping("mixture:components=[disk|disk:center=[2,0]]")->domain();
    const auto holds = [&](double x, double y) {
        const std::array<double, 2> point = {x, y};
        return disks->contains(point);
    };
    EXPECT_TRUE(holds(1, 0)) << "of both";
    EXPECT_TRUE(holds(-1, 0));
    EXPECT_TRUE(holds(2, 1));
    EXPECT_FALSE(holds(1, 0.9)) << "in the box, between them";
    EXPECT_FALSE(holds(3 + 1e-9, 0));
    EXPECT_FALSE(holds(std::nan(""), 0));
    const auto caps = mapping("mixture:components=[cone:half-angle=20|hemisphere]")->domain();
    const std::array<double, 3> below = {0, 0.6, -0.8};
    EXPECT_FALSE(caps->contains(below));
}

// Rounding of the rims of thin or small components is part of the stated error.
TEST(Mixture, ProbabilitiesOfThinComponentsSumTo1WithinTheirError) {
    for (const std::string components :
         {"annulus:inner=0.9999999|disk:radius=10",
          "spherical-triangle:vertices=[1,0,0 1,0.001,0 1,0,0.001]|sphere"}) {
        const DomainPtr domain =
            mapping("mixture:weights=[0.5,0.5],components=[" + components + "]")->domain();
        Estimate sum;
        for (int i = 0; i < 11; ++i)
            for (int j = 0; j < 11; ++j)
                sum +=
                    domain->probability({{i / 11.0, j / 11.0}, {(i + 1) / 11.0, (j + 1) / 11.0}});
        EXPECT_LE(std::abs(sum.value - 1), sum.error + 1e-13) << components;
        EXPECT_LT(sum.error, 1e-6) << components;
    }
}

}  // namespace stipple::testing::mixture_test
