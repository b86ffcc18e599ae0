// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "support/designs.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::central_composite_test {
namespace {

constexpr const char* unit = "central-composite";

double alpha_of(std::size_t factors, const Settings& settings) {
    return std::stod(found_in(make(unit, {.dimension = factors}, settings), "alpha"));
}

}  // namespace

// Two factors, by hand: corners, axial runs at sqrt 2, centre.
TEST(CentralComposite, TwoFactorsByHand) {
    const PointSet set = coded_design(unit, {}, {{"center", "2"}});
    const double r = std::sqrt(2.0);
    const double expected[][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}, {-r, 0},
                                  {r, 0},   {0, -r}, {0, r},  {0, 0}, {0, 0}};
    ASSERT_EQ(set.count(), 10U);
    for (std::size_t i = 0; i < 10; ++i)
        for (std::size_t k = 0; k < 2; ++k)
            EXPECT_NEAR(set[i][k], expected[i][k], 1e-15) << i << " " << k;
    EXPECT_EQ(signs_of(coded_design(unit, {}, {{"type", "faced"}})),
              (std::vector<std::string>{"--", "+-", "-+", "++", "-0", "+0", "0-", "0+", "00"}));
}

// alpha = (2^k)^(1/4), as NIST's handbook tabulates: 1.414, 1.682, 2, 2.378 (2 for half of 2^5).
TEST(CentralComposite, RotatableAlphaIsTheFourthRootOfTheCorners) {
    EXPECT_NEAR(alpha_of(2, {}), 1.4142135623730951, 1e-15);
    EXPECT_NEAR(alpha_of(3, {}), 1.681792830507429, 1e-15);
    EXPECT_EQ(alpha_of(4, {}), 2);
    EXPECT_NEAR(alpha_of(5, {}), 2.378414230005442, 1e-15);
    EXPECT_EQ(alpha_of(5, {{"fraction", "true"}}), 2);
    EXPECT_EQ(make(unit, {.dimension = 5}, {{"fraction", "true"}}).count(), 16U + 10 + 1);
    EXPECT_EQ(make(unit, {.dimension = 8}, {{"fraction", "true"}}).count(), 64U + 16 + 1);
    EXPECT_EQ(make(unit, {.dimension = 3}, {{"fraction", "true"}}).count(), 8U + 6 + 1);
}

// A design is rotatable if its fourth moments satisfy [iiii] = 3 [iijj] (Box and Hunter 1957).
TEST(CentralComposite, RotatableDesignsHaveTheMomentsOfOne) {
    for (const std::size_t k : {2, 3, 4, 6}) {
        const PointSet set = coded_design(unit, {.dimension = k});
        double pure = 0;
        double mixed = 0;
        for (std::size_t i = 0; i < set.count(); ++i) {
            pure += std::pow(set[i][0], 4);
            mixed += std::pow(set[i][0] * set[i][1], 2);
        }
        EXPECT_NEAR(pure, 3 * mixed, 1e-12 * pure) << k;
    }
}

// Orthogonal: sum_i (x_i1^2 - mean)(x_i2^2 - mean) = 0.
TEST(CentralComposite, OrthogonalDesignsHaveUncorrelatedSquares) {
    for (const std::size_t k : {2, 3, 5})
        for (const char* center : {"0", "1", "6"}) {
            const PointSet set =
                coded_design(unit, {.dimension = k}, {{"alpha", "orthogonal"}, {"center", center}});
            const auto n = static_cast<double>(set.count());
            double a = 0;
            double ab = 0;
            for (std::size_t i = 0; i < set.count(); ++i) {
                a += set[i][0] * set[i][0];
                ab += std::pow(set[i][0] * set[i][1], 2);
            }
            EXPECT_NEAR(ab - a * a / n, 0, 1e-12 * n) << k << " " << center;
        }
}

TEST(CentralComposite, InscribedIsCircumscribedInAnotherBox) {
    const PointSet outside = make(unit, {.dimension = 3});
    const PointSet inside = make(unit, {.dimension = 3}, {{"type", "inscribed"}});
    EXPECT_EQ(outside, inside);
    const PointSet coded = coded_design(unit, {.dimension = 3}, {{"type", "inscribed"}});
    EXPECT_NEAR(coded[0][0], -1 / 1.681792830507429, 1e-15);
    EXPECT_EQ(coded[8][0], -1);
    EXPECT_EQ(coded[9][0], 1);
}

// Also if alpha is below 1, which it is without runs at the centre: the corners are then outside.
TEST(CentralComposite, InscribedAxialRunsAreAtOne) {
    const PointSet coded =
        coded_design(unit, {}, {{"type", "inscribed"}, {"alpha", "orthogonal"}, {"center", "0"}});
    EXPECT_NEAR(coded[4][0], -1, 1e-15);
    EXPECT_NEAR(coded[0][0], -1 / 0.9101797211244548, 1e-15);
}

TEST(CentralComposite, AxialRunsReachTheFacesWithEnds) {
    const PointSet set = make(unit, {.dimension = 3}, {{"ends", "true"}, {"alpha", "2"}});
    EXPECT_EQ(set[8][0], 0);
    EXPECT_EQ(set[9][0], 1 - 0x1p-53);
    EXPECT_EQ(set[0][0], 0.25);
    EXPECT_EQ(set[14][2], 0.5);
    EXPECT_TRUE(stretches_agree(unit, points(15, 3)));
}

TEST(CentralComposite, RefusesContradictions) {
    const auto error = [](const Request& request, const Settings& settings) {
        return error_of([&] { make(unit, request, settings); });
    };
    EXPECT_EQ(error(points(20, 3), {}),
              "usage: --count: 20 contradicts the central composite design of 8 corners and 6 "
              "axial runs, which has 14 runs and 1 at the centre | --center 6 gives that count");
    EXPECT_EQ(error({}, {{"alpha", "0.5"}}),
              "usage: --alpha: '0.5' is not rotatable, orthogonal or a number in [1, 1e6]");
    EXPECT_EQ(error({}, {{"type", "faced"}, {"alpha", "2"}}),
              "usage: --alpha: 2 contradicts --type faced, whose alpha is 1");
}

}  // namespace stipple::testing::central_composite_test
