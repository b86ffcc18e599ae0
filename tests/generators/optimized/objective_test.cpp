// SPDX-License-Identifier: MIT
#include "generators/optimized/objective.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/l2/squares.hpp"
#include "support/units.hpp"

namespace stipple::testing::objective_test {
namespace {

using namespace stipple::optimized;
using discrepancy::Family;

PointSet random_set(std::size_t n, std::size_t d, std::uint64_t seed) {
    return make("random", points(n, d), {}, {.seed = seed});
}

/// Derivative of the value by a central difference.
double slope_of(Objective& objective, PointSet set, std::size_t i, double sharpness) {
    std::vector<double> gradient(set.flat().size());
    const double step = 1e-6;
    set.flat()[i] += step;
    const double up = objective.value(set.flat(), sharpness, gradient, {});
    set.flat()[i] -= 2 * step;
    return (up - objective.value(set.flat(), sharpness, gradient, {})) / (2 * step);
}

/// Compares all derivatives with differences, within `error`.
void expect_gradient(Objective& objective, const PointSet& set, double sharpness, double error) {
    std::vector<double> gradient(set.flat().size());
    objective.value(set.flat(), sharpness, gradient, {});
    for (std::size_t i = 0; i < gradient.size(); ++i)
        EXPECT_NEAR(gradient[i], slope_of(objective, set, i, sharpness), error) << i;
}

}  // namespace

TEST(L2Objective, IsTheSquareAndItsGradient) {
    const l2::AxisWeights weights{0.5, 2, 1};
    for (const l2::Kind kind : l2::all_kinds)
        for (const std::size_t d : {1, 2, 3})
            for (const bool weighted : {false, true}) {
                const PointSet set = random_set(70, d, d);
                const auto mine = weighted ? l2::AxisWeights(weights.begin(), weights.begin() + d)
                                           : l2::AxisWeights();
                const auto objective = l2_objective(kind, mine, 70, d);
                std::vector<double> gradient(70 * d);
                const double exact = l2::pair_square(set, kind, mine, {}).squared;
                EXPECT_NEAR(objective->value(set.flat(), 1, gradient, {}) / exact, 1, 1e-10);
                expect_gradient(*objective, set, 1, 1e-6);
            }
}

// The gradient of a maximum is that of the worst box, if no other one is close.
TEST(AnchoredObjective, IsTheStarDiscrepancyAndItsGradient) {
    for (const std::size_t d : {2, 3})
        for (const std::uint64_t seed : {1, 2, 3, 4}) {
            const PointSet set = random_set(40, d, seed);
            const auto objective = anchored_objective({}, 40, d);
            std::vector<double> gradient(40 * d);
            EXPECT_NEAR(objective->value(set.flat(), 100, gradient, {}),
                        measure("star-discrepancy", "value", set), 1e-6);
            expect_gradient(*objective, set, 1e7, 0.15);  // in float
        }
}

// With weights of at least 1, a box that ends just below 1 on an axis counts with that axis'
// weight, too: every box has all weights.
TEST(AnchoredObjective, CountsBoxesThatEndJustBelowOneWithTheirWeight) {
    for (const std::size_t d : {2, 3}) {
        const PointSet set = random_set(20, d, d);
        const std::vector<double> weights(d, 2);
        std::vector<double> gradient(20 * d);
        const double value = std::pow(2, d) * measure("star-discrepancy", "value", set);
        EXPECT_NEAR(anchored_objective(weights, 20, d)->value(set.flat(), 100, gradient, {}), value,
                    1e-5);
        const auto boxes = box_objective(Family::anchored, false, weights, 20, d);
        const double known = boxes->value(set.flat(), 1000, gradient, {});
        EXPECT_NEAR(boxes->certain_value(set.flat(), known, {}), value, 1e-12);
    }
}

TEST(AnchoredObjective, OfOnePointAndOfPointsAtOnePlaceIsRight) {
    for (const PointSet& set :
         {points_of({{0, 0}}), points_of({{1, 1}}), points_of({{1, 2}, {1, 2}, {1, 2}})}) {
        PointSet small = set;
        for (double& x : small.flat()) x /= 4;
        const auto objective = anchored_objective({}, small.count(), 2);
        std::vector<double> gradient(small.flat().size());
        EXPECT_NEAR(objective->value(small.flat(), 100, gradient, {}),
                    measure("star-discrepancy", "value", small), 1e-6);
    }
}

TEST(BoxObjective, FindsTheWorstBoxOfEveryFamily) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const PointSet set = random_set(30, 2, seed);
        const auto value_of = [&](Family family, bool empty) {
            const auto objective = box_objective(family, empty, {}, 30, 2);
            std::vector<double> gradient(60);
            const double found = objective->value(set.flat(), 1000, gradient, {});
            EXPECT_DOUBLE_EQ(objective->certain_value(set.flat(), found, {}),
                             bounds_of(set, family, empty, {}).upper);
            expect_gradient(*objective, set, 1e7, 1e-3);
            return found;
        };
        const auto kind = [&](const char* name) {
            return measure("star-discrepancy", "value", set, {{"kind", name}});
        };
        EXPECT_NEAR(value_of(Family::anchored, false), kind("star"), 1e-12);
        EXPECT_NEAR(value_of(Family::cube, false), kind("extreme"), 1e-12);
        EXPECT_NEAR(value_of(Family::torus, false), kind("periodic"), 1e-12);
        EXPECT_NEAR(value_of(Family::cube, true), measure("dispersion", "value", set), 1e-12);
    }
}

// On the torus 1 is 0, and boxes around a whole axis have no side at a point.
TEST(BoxObjective, OfFewPointsAndOfPointsAtOneIsRight) {
    for (const Family family : {Family::anchored, Family::cube, Family::torus})
        for (const std::size_t n : {1, 2, 3, 4})
            for (const std::uint64_t seed : {1, 2, 3}) {
                PointSet set = random_set(n, 3, seed);
                if (seed > 1) set[0][seed % 3] = 1;
                if (seed > 2) set[n - 1][2] = 0;
                const auto objective = box_objective(family, false, {}, n, 3);
                std::vector<double> gradient(3 * n);
                for (const double sharpness : {1., 20., 1000.}) {
                    const double found = objective->value(set.flat(), sharpness, gradient, {});
                    const double worst = bounds_of(set, family, false, {}).upper;
                    EXPECT_LE(found, worst * (1 + 1e-12));
                    EXPECT_DOUBLE_EQ(objective->certain_value(set.flat(), found, {}), worst);
                }
            }
}

}  // namespace stipple::testing::objective_test
