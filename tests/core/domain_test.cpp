// SPDX-License-Identifier: MIT
#include "core/domain.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/rng.hpp"
#include "pipeline/chain.hpp"
#include "support/units.hpp"

namespace stipple::testing::domain_test {

TEST(Domain, UnitCubeIsClosed) {
    const auto cube = unit_cube(2);
    EXPECT_TRUE(cube->contains(std::vector<double>{0, 1}));
    EXPECT_FALSE(cube->contains(std::vector<double>{0, 1.0000001}));
    EXPECT_FALSE(cube->contains(std::vector<double>{-1e-300, 0.5}));
    EXPECT_EQ(cube->measure(), 1);
}

TEST(Domain, BoxMapsToTheCube) {
    const auto box = box_domain(parse_box("-1..3,10..10.5", 2));
    EXPECT_EQ(box->measure(), 2);
    EXPECT_EQ(box->spec(), "box:bounds=[-1..3,10..10.5]");
    std::vector<double> cube(2);
    box->to_cube(std::vector<double>{0, 10.5}, cube);
    EXPECT_EQ(cube, (std::vector<double>{0.25, 1}));
    EXPECT_EQ(parse_domain(box->spec(), 2)->spec(), box->spec());
}

TEST(Domain, OneRangeStandsForAllCoordinates) {
    EXPECT_EQ(format_box(parse_box("0..2", 3)), "0..2,0..2,0..2");
    for (const char* text : {"", "1", "1..1", "2..1", "0..inf", "nan..1", "0..1,0..1", "a..b"})
        EXPECT_TRUE(error_of([&] { parse_box(text, 3); }).starts_with("usage: --bounds")) << text;
}

// The upper face is not part of a half-open box, even after rounding.
TEST(Domain, ScalingStaysBelowTheUpperFace) {
    const Box box = parse_box("1e15..1000000000000001", 1);
    std::vector<double> rows = {0, 0.5, one_minus_ulp};
    scale_into(box, rows);
    EXPECT_EQ(rows[0], 1e15);
    EXPECT_LT(rows[2], 1e15 + 1);
}

TEST(Domain, VolumesAreThoseOfAllSides) {
    for (const char* text :
         {"0..1e-200,0..1e-200,0..1e200,0..1e200", "0..1e200,0..1e200,0..1e-200,0..1e-200"})
        EXPECT_NEAR(box_domain(parse_box(text, 4))->measure(), 1, 1e-15);
    EXPECT_EQ(box_domain(parse_box("0..1e-200", 2))->measure(), 0);
}

TEST(Domain, ProductsTakeTheirCoordinates) {
    const auto product = parse_domain("disk@3,1 x unit-cube@2", 3);
    EXPECT_EQ(product->spec(), "disk@3,1 x unit-cube@2");
    EXPECT_EQ(product->dimension(), 3U);
    EXPECT_NEAR(product->measure(), 3.14159265358979, 1e-12);
    EXPECT_TRUE(product->contains(std::vector<double>{-0.9, 1, 0.1}));
    EXPECT_FALSE(product->contains(std::vector<double>{0.9, 1, 0.9}));
    for (const char* text : {"disk@1,2", "disk@1,2 x unit-cube@2", "disk@1,2 x unit-cube@4"})
        EXPECT_NE(error_of([&] { parse_domain(text, 3); }), "") << text;
    EXPECT_TRUE(error_of([] { parse_domain("dsik", 2); }).find("disk") != std::string::npos);
}

// The axes of a product's cube have the order of the row's coordinates, not that of the factors.
TEST(Domain, AxesOfAProductStandInTheOrderOfTheCoordinates) {
    const auto product =
        parse_domain("power@4:exponent=1 x unit-cube@1,3 x power@2:exponent=3,range=[0,2]", 4);
    std::vector<double> cube(4);
    product->to_cube(std::vector<double>{0.1, 1, 0.3, 0.5}, cube);
    EXPECT_DOUBLE_EQ(cube[0], 0.1);
    EXPECT_DOUBLE_EQ(cube[1], 1 / 16.0);  // (1/2)^4
    EXPECT_DOUBLE_EQ(cube[2], 0.3);
    EXPECT_DOUBLE_EQ(cube[3], 0.25);  // (1/2)^2
    EXPECT_EQ(product->cube_axes()[0], "x1");
    EXPECT_EQ(product->cube_axes()[1], "probability below x of power@2");
    EXPECT_EQ(product->cube_axes()[2], "x3");
}

// A sphere has three coordinates and two axes; cells are products of its cells and those of the
// others.
TEST(Domain, ProbabilitiesOfAProductAreThoseOfTheFactors) {
    const auto product = parse_domain(
        "sphere@2,3,5 x rejection@4:density=2*x,bounds=0..1 x "
        "unit-cube@1",
        5);
    EXPECT_EQ(product->cube_dimension(), 4U);
    EXPECT_NEAR(product->probability({{0, 0, 0.5, 0}, {0.5, 0.25, 1, 1}}).value, 0.0625, 1e-9);
    EXPECT_NEAR(product->probability({{0, 0, 0, 0.5}, {1, 1, 1, 1}}).value, 0.75, 1e-9);
}

}  // namespace stipple::testing::domain_test
