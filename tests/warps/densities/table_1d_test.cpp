// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "support/temporary_file.hpp"
#include "support/warping.hpp"

namespace stipple::testing::table_1d_test {
namespace {

// Masses 1, 0, 3 and 2 sixths: a ramp, a gap, a jump to a plateau, a fall.
const std::string mixed = "table-1d:rows=[0,0 1,2 1,0 2,0 2,3 3,3 4,1]";
const std::string steps = "table-1d:interpolation=constant,rows=[-1,2 0,0 2,6 3,0]";

double at(const std::string& spec, double u) { return image_of(*mapping(spec), {u, 0.5})[0]; }

}  // namespace

// Default: p = 2 - 2 x, x = 1 - sqrt(1 - xi).
TEST(Table1d, NumbersByHand) {
    EXPECT_EQ(at("table-1d", 0), 0);
    EXPECT_DOUBLE_EQ(at("table-1d", 0.75), 0.5);
    EXPECT_EQ(at("table-1d", 1), 1);
    EXPECT_DOUBLE_EQ(at("table-1d", 1e-20), 5e-21);
    EXPECT_DOUBLE_EQ(at(mixed, 0.25 / 6), 0.5);
    EXPECT_DOUBLE_EQ(at(mixed, 2.5 / 6), 2.5);
    EXPECT_DOUBLE_EQ(at(mixed, 4 / 6. + 1.25 / 6), 3.5);
    EXPECT_DOUBLE_EQ(at(steps, 0.125), -0.5);
    EXPECT_DOUBLE_EQ(at(steps, 0.25 + 0.375), 2.5);
    EXPECT_EQ(at(steps, 0.25), 2) << "the piece without mass is skipped";
}

TEST(Table1d, RoundTripOverTheWholeSquare) {
    for (const std::string& spec : {std::string("table-1d"), mixed, steps,
                                    std::string("table-1d:rows=[1e-9,1 5,1e-9 6,1e9]")}) {
        SCOPED_TRACE(spec);
        const auto map = mapping(spec);
        const PointSet cube = telling_points();
        for (std::size_t i = 0; i < cube.count(); ++i) {
            const auto x = image_of(*map, {cube[i][0], cube[i][1]});
            ASSERT_TRUE(map->domain()->contains(x)) << cube[i][0];
            ASSERT_NEAR(inverse_of(*map, x)[0], cube[i][0], 1e-14) << x[0];
        }
    }
}

TEST(Table1d, NothingFallsIntoGaps) {
    const PointSet cube = telling_points();
    for (std::size_t i = 0; i < cube.count(); ++i) {
        const double x = at(mixed, cube[i][0]);
        ASSERT_TRUE(x <= 1 || x >= 2) << cube[i][0] << ": " << x;
        const double y = at(steps, cube[i][0]);
        ASSERT_TRUE(y <= 0 || y >= 2) << cube[i][0] << ": " << y;
    }
}

TEST(Table1d, DensityIsOneOverTheStretchAndIntegratesToOne) {
    expect_density_is_one_over_stretch(*mapping("table-1d"), 1e-4);
    EXPECT_DOUBLE_EQ(mapping("table-1d")->density(std::vector{0.25, 0.5}), 1.5);
    const auto map = mapping(mixed);
    const auto density = [&](double x) { return map->density(std::vector{x, 2.5}) / 0.5; };
    EXPECT_DOUBLE_EQ(density(0.5), 1 / 6.);
    EXPECT_EQ(density(1.5), 0);
    EXPECT_EQ(density(4.5), 0);
    double mass = 0;
    for (const double left : {0.0, 1.0, 2.0, 3.0})
        mass += boost::math::quadrature::gauss_kronrod<double, 15>::integrate(density, left,
                                                                              left + 1, 0);
    EXPECT_NEAR(mass, 1, 1e-13);
}

// False alarm 1e-4 each. Wrong: xi -> 1 - sqrt(xi), and a table with an error of 2 %.
TEST(Table1d, ChiSquareAcceptsItAndRejectsWrongOnes) {
    for (const std::string& spec : {std::string("table-1d"), mixed, steps})
        EXPECT_GT(p_of_random(*mapping(spec), 100'000), 1e-4) << spec;
    PointSet wrong =
        warped(*mapping("table-1d:rows=[0,2 1,0.1]"), make("random", points(200'000, 2)));
    wrong.domain = mapping("table-1d")->domain();
    EXPECT_LT(measure("chi-square", "p_upper", wrong), 1e-4);
}

// Uniform halves of any height, and a ramp: squares of these densities would overflow or underflow.
TEST(Table1d, TakesDensitiesOfAnySize) {
    for (const char* f : {"1e-285", "1e-200", "1e-160", "1", "1e150"}) {
        const std::string size = f;
        for (const char* kind : {"linear", "constant"}) {
            const std::string spec = "table-1d:interpolation=" + std::string(kind) + ",rows=[0," +
                                     size + " 1," + size + "]";
            for (const double u : {0.25, 0.5, 0.75}) {
                EXPECT_DOUBLE_EQ(at(spec, u), u) << spec;
                EXPECT_DOUBLE_EQ(inverse_of(*mapping(spec), {u, 0.5})[0], u) << spec;
            }
        }
        EXPECT_DOUBLE_EQ(at("table-1d:rows=[0,0 1," + size + "]", 0.25), 0.5) << size;
    }
    // Next to a density of 1, one of 1e-200 or 1e-300, which has that fraction of the mass.
    for (const char* f : {"1e-200", "1e-300"}) {
        const std::string beside =
            "table-1d:interpolation=constant,rows=[0," + std::string(f) + " 1,1 2,0]";
        EXPECT_DOUBLE_EQ(at(beside, 0.25 * std::stod(f)), 0.25) << f;
        EXPECT_DOUBLE_EQ(mapping(beside)->density(std::vector{0.5, 1.5}), std::stod(f)) << f;
    }
}

TEST(Table1d, ReadsFiles) {
    const TemporaryFile file("x,density\n0,0\n1,2\n2,0\n");
    EXPECT_DOUBLE_EQ(at("table-1d:file=" + file.path(), 0.125), 0.5);
    EXPECT_EQ(mapping("table-1d:file=" + file.path())->domain()->spec(),
              "table-1d:file=" + file.path());
    EXPECT_EQ(error_of([&] { mapping("table-1d:rows=[0,1 1,1],file=" + file.path()); }),
              "usage: --rows: cannot be combined with --file; give one of them");
    const TemporaryFile named("x,pdf\n0,0\n1,2\n2,0\n");
    EXPECT_DOUBLE_EQ(at("table-1d:file=" + named.path(), 0.125), 0.5);
    const TemporaryFile two("0,1\n1,1\n#\n0,1\n1,1\n");
    EXPECT_EQ(error_of([&] { mapping("table-1d:file=" + two.path()); }),
              "input: " + two.path() + ": 2 sets of points; expected one");
    EXPECT_EQ(error_of([] { mapping("table-1d:file=-"); }),
              "usage: --file: standard input cannot be read again; give a file");
    const TemporaryFile bad("0,1\n1,-2\n");
    EXPECT_EQ(error_of([&] { mapping("table-1d:file=" + bad.path()); }),
              "input: " + bad.path() + ": row 2 has the density -2; expected [0, 1e150]");
}

TEST(Table1d, RefusesWhatIsNoDensity) {
    EXPECT_EQ(error_of([] { mapping("table-1d:rows=[0,1 1,-1]"); }),
              "usage: --rows: row 2 has the density -1; expected [0, 1e150]");
    EXPECT_EQ(error_of([] { mapping("table-1d:rows=[0,1 2,1 1,1]"); }),
              "usage: --rows: row 3 has x = 1 after 2; x must increase");
    EXPECT_EQ(error_of([] { mapping("table-1d:rows=[0,0 2,0]"); }),
              "usage: --rows: the integral of the density is 0; expected [1e-290, 1e290]");
    EXPECT_EQ(error_of([] { mapping("table-1d:rows=[0,1]"); }),
              "usage: --rows: the table has 1 row; expected 2 to 2^28");
    EXPECT_EQ(error_of([] { mapping("table-1d:rows=[0,1,2 1,1,1]"); }),
              "usage: --rows: rows of 3 numbers; expected 2, x,density");
    EXPECT_NE(error_of([] { mapping("table-1d:interpolation=constant,rows=[0,1 0,1 1,1]"); }), "");
    EXPECT_EQ(mapping("table-1d")->domain()->spec(), "table-1d");
}

}  // namespace stipple::testing::table_1d_test
