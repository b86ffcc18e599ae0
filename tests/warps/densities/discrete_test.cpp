// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/text.hpp"
#include "support/warping.hpp"

namespace stipple::testing::discrete_test {
namespace {

const std::string four = "discrete:probabilities=[0.2,0.5,0,0.3]";
const std::string edges = "discrete:probabilities=[0,0.25,0,0,0.75,0]";

double at(const std::string& spec, double u) { return image_of(*mapping(spec), {u, 0.5})[0]; }

/// Fraction of the unit interval for each outcome, by 7919 x 64 equal steps.
std::map<double, double> shares(const std::string& spec) {
    const auto map = mapping(spec);
    const int n = 7919 * 64;
    std::map<double, double> share;
    for (int i = 0; i < n; ++i) share[image_of(*map, {(i + 0.5) / n, 0})[0]] += 1.0 / n;
    return share;
}

}  // namespace

TEST(Discrete, OutcomesByHand) {
    EXPECT_EQ(at(four, 0), 0);
    EXPECT_EQ(at(four, std::nextafter(0.2, 0)), 0);
    EXPECT_EQ(at(four, 0.2), 1);
    EXPECT_EQ(at(four, std::nextafter(0.7, 0)), 1);
    EXPECT_EQ(at(four, std::nextafter(0.7, 1)), 3);
    EXPECT_EQ(at(four, one_minus_ulp), 3);
    EXPECT_EQ(at(four, 1), 3);
    EXPECT_EQ(at("discrete:probabilities=[0.25,0.75],values=[-2.5,7]", 0.3), 7);
}

TEST(Discrete, OutcomesOfProbabilityZeroNeverCome) {
    for (const std::string how : {"inversion", "alias"})
        for (const std::string& spec : {four, edges}) {
            const auto map = mapping(spec + ",method=" + how);
            const PointSet cube = telling_points();
            for (std::size_t i = 0; i < cube.count(); ++i) {
                const auto x = image_of(*map, {cube[i][0], cube[i][1]});
                ASSERT_TRUE(map->domain()->contains(x));
                ASSERT_GT(map->density(x), 0) << how << " " << cube[i][0] << ": " << x[0];
            }
        }
}

TEST(Discrete, BothMethodsGiveEachOutcomeItsShare) {
    for (const std::string how : {"inversion", "alias"})
        for (const std::string& p :
             {std::string("0.2,0.5,0,0.3"), std::string("0.01,0.02,0.9,0.07"),
              std::string("0.125,0.125,0.125,0.125,0.25,0.25"), std::string("1")}) {
            auto found = shares("discrete:probabilities=[" + p + "],method=" + how);
            double i = 0;
            for (const auto part : split(p, ','))
                EXPECT_NEAR(found[i++], *parse_number(part), 3e-5) << how << " " << p;
        }
}

TEST(Discrete, InversionComesBackAliasDoesNot) {
    expect_round_trip(*mapping(four), 0);
    EXPECT_DOUBLE_EQ(inverse_of(*mapping(four), {1, 3})[0], 0.45);
    EXPECT_EQ(error_of([] {
                  inverse_of(*mapping(four + ",method=alias"), {1, 3});
              }),
              "usage: --inverse: discrete by method alias has no inverse");
    EXPECT_EQ(error_of([] {
                  inverse_of(*mapping(four), {1, 3.5});
              }),
              "input: the point (1, 3.5) is outside the domain " + four);
}

TEST(Discrete, TwoDiceAreIndependent) {
    const auto dice =
        mapping("discrete:probabilities=[1,1,1,1,1,1],normalize=true,values=[1,2,3,4,5,6]");
    EXPECT_DOUBLE_EQ(dice->density(std::vector{6.0, 1.0}), 1 / 36.);
    EXPECT_EQ(dice->density(std::vector{6.0, 7.0}), 0);
    EXPECT_EQ(dice->domain()->measure(), 36);
}

TEST(Discrete, CellsHaveTheProbabilitiesOfTheirOutcomes) {
    const DomainPtr law = mapping(four)->domain();
    EXPECT_FALSE(law->even());
    std::vector<double> place(2);
    law->to_cube(std::vector{1.0, 3.0}, place);
    EXPECT_EQ(place, (std::vector{0.375, 0.875}));
    EXPECT_DOUBLE_EQ(law->probability({{0.25, 0}, {0.5, 1}}).value, 0.5);
    EXPECT_DOUBLE_EQ(law->probability({{0.25, 0.75}, {0.75, 1}}).value, 0.15);
    EXPECT_EQ(law->probability({{0.5, 0}, {0.75, 1}}).value, 0);
    EXPECT_EQ(law->probability({{0.5, 0}, {0.75, 1}}).error, 0);
}

// Pearson's statistic by hand, 2 degrees of freedom: above 23 with probability 1e-5.
TEST(Discrete, CountsOfRandomNumbersFit) {
    for (const std::string how : {"inversion", "alias"}) {
        const PointSet x =
            warped(*mapping(four + ",method=" + how), make("random", points(50'000, 2)));
        std::map<double, double> count;
        for (const double v : x.flat()) count[v] += 1;
        const auto statistic = [&](double a, double b, double c) {
            const auto term = [](double seen, double p) {
                return (seen - 1e5 * p) * (seen - 1e5 * p) / (1e5 * p);
            };
            return term(count[0], a) + term(count[1], b) + term(count[3], c);
        };
        EXPECT_LT(statistic(0.2, 0.5, 0.3), 23) << how;
        EXPECT_GT(statistic(0.21, 0.49, 0.3), 23) << how;
    }
}

TEST(Discrete, DomainSaysWhatItIsAndRefusesTheRest) {
    EXPECT_EQ(mapping("discrete")->domain()->spec(), "discrete");
    EXPECT_EQ(mapping(four + ",method=alias")->domain()->spec(), four);
    EXPECT_EQ(error_of([] { mapping("discrete:probabilities=[0.2,0.5]"); }),
              "usage: --probabilities: the sum is 0.7; expected 1 | --normalize divides them by "
              "their sum");
    EXPECT_EQ(error_of([] { mapping("discrete:probabilities=[-0.2,1.2]"); }),
              "usage: --probabilities: -0.2 is outside [0, 1]");
    EXPECT_EQ(error_of([] { mapping("discrete:probabilities=[0,0],normalize=true"); }),
              "usage: --probabilities: the sum is 0; expected a finite number above 0");
    EXPECT_EQ(error_of([] { mapping("discrete:values=[1,2,3]"); }),
              "usage: --values: 3 numbers for 2 probabilities; expected as many");
    EXPECT_EQ(error_of([] { mapping("discrete:values=[1,1]"); }),
              "usage: --values: 1 is given twice");
}

TEST(Discrete, InverseStaysInOneStepOfDoubles) {
    const std::string spec =
        "discrete:probabilities=[0.5000000000000001,1.1102230246251565e-16,0.4999999999999998]";
    const auto map = mapping(spec);
    for (const double x : {0.0, 1.0, 2.0})
        EXPECT_EQ(image_of(spec, inverse_of(*map, {x, x})), (std::vector{x, x}));
}

}  // namespace stipple::testing::discrete_test
