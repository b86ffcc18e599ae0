// SPDX-License-Identifier: MIT
#include "math/geometry/law_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/temporary_file.hpp"
#include "support/warping.hpp"

namespace stipple::testing::law_moments_test {
namespace {

Moments exact(const std::string& spec) {
    const auto found = mapping(spec)->domain()->moments();
    EXPECT_TRUE(found.has_value()) << spec;
    return found.value_or(Moments{{0}, {0}, {0}});
}

void expect_relative(double x, double wanted, double error, const std::string& spec) {
    EXPECT_NEAR(x / wanted, 1, error) << spec;
}

}  // namespace

// The triangle density on [0, s] has the mean s / 3, the variance s^2 / 18 and the skewness
// 2 sqrt(2) / 5.
TEST(LawMoments, SkewnessDoesNotDependOnTheUnit) {
    const double skewness = 0.4 * std::sqrt(2);
    for (const std::string s : {"1e-120", "1e-60", "1", "1e110"})
        for (const std::string& spec :
             {"table-1d:rows=[0,2 " + s + ",0]", "triangular:high=" + s + ",mode=0",
              "triangle:vertices=[0,0 " + s + ",0 0," + s + "]",
              "expression-1d:density=[1-x/" + s + "],range=[0," + s + "]"}) {
            const Moments m = exact(spec);
            const double size = std::stod(s);
            expect_relative(m.mean[0], size / 3, 1e-12, spec);
            expect_relative(m.covariance[0], size * size / 18, 1e-8, spec);
            EXPECT_NEAR(m.skewness[0], skewness, 1e-8) << spec;
        }
    for (const std::string s : {"1e-120", "1", "1e120"}) {
        EXPECT_NEAR(exact("power:range=[0," + s + "]").skewness[0], -0.8606629658238704, 1e-13);
        const std::string spec =
            "discrete:probabilities=[0.5,0.25,0.25],values=[0," + s + ",3" + s.substr(1) + "]";
        EXPECT_NEAR(exact(spec).skewness[0], std::sqrt(2 / 3.0), 1e-15) << spec;
    }
}

TEST(LawMoments, VariancesTooSmallForADoubleAreUnknown) {
    const Moments m = exact("expression-1d:density=[1-x/1e-170],range=[0,1e-170]");
    EXPECT_FALSE(std::isfinite(m.covariance[0]));
    EXPECT_NEAR(m.skewness[0], 0.4 * std::sqrt(2), 1e-8);
}

// Values are 8/2^23 apart: the variance is 2/3 of that squared.
TEST(LawMoments, FarFrom0NoDigitsAreLost) {
    const Moments m = exact(
        "discrete:probabilities=[1,1,1],normalize,values=[1e9,1000000000.00000095367431640625,"
        "1000000000.0000019073486328125]");
    expect_relative(m.covariance[0], 0x1p-39 / 3, 1e-12, "discrete");
    EXPECT_NEAR(m.skewness[0], 0, 1e-9);
    for (const std::string far : {"0", "1e6", "1e8"}) {
        const double at = std::stod(far);
        const auto spec = fmt::format(
            "mixture:weights=[0.3,0.7],components=[normal:mean={:.0f}|normal:mean={:.0f}]", at,
            at + 1);
        const Moments mixed = exact(spec);
        EXPECT_NEAR(mixed.covariance[0], 1.21, 1e-12) << spec;
        EXPECT_NEAR(mixed.skewness[0], -0.084 / std::pow(1.21, 1.5), 1e-12) << spec;
    }
}

// References by exact fractions.
TEST(LawMoments, ATinyPartFarAwayTakesNoDigits) {
    const TemporaryFile file(
        "v -1e6 0 0\nv -999999.9999999 0 0\nv -1e6 1e-7 0\nv 0 0 0\nv 1 0 0\n"
        "v 0 1 0\nf 1 2 3\nf 4 5 6\n",
        ".obj");
    const Moments m = exact("mesh:file=" + file.path());
    EXPECT_NEAR(m.mean[0], 0.33333332333325383, 1e-16);
    EXPECT_NEAR(m.covariance[0], 0.06555563836720638, 1e-15);
    expect_relative(m.skewness[0], -595783.3242265224, 1e-12, "mesh");
}

// x = y^(1/p) has a beta distribution.
TEST(LawMoments, OfSteepPowers) {
    const double p = 1001;
    const double variance = p / ((p + 1) * (p + 1) * (p + 2));
    const double skewness = 2 * (1 - p) * std::sqrt(p + 2) / ((p + 3) * std::sqrt(p));
    for (const std::string range : {"0,1", "0.5,1", "-0.5,1", "-1,0.5", "-1,0"}) {
        const Moments m = exact("power:exponent=1000,range=[" + range + "]");
        const double sign = range.substr(0, 3) == "-1," ? -1 : 1;
        expect_relative(m.mean[0], sign * p / (p + 1), 1e-14, range);
        expect_relative(m.covariance[0], variance, 1e-12, range);
        EXPECT_NEAR(m.skewness[0], sign * skewness, 1e-12) << range;
    }
    // By mpmath, from the density x^-1000 on [1, 2].
    EXPECT_NEAR(exact("power:exponent=-1000,range=[1,2]").skewness[0], 2.0060211, 1e-7);
}

// References by mpmath with 40 digits.
TEST(LawMoments, OfThinRingsAndNarrowSectors) {
    const Moments thin = exact("sector:inner=0.999999,angles=[0,1e-4]");
    expect_relative(thin.covariance[0], 8.333333333344798e-14, 1e-9, "variance of x");
    expect_relative(thin.covariance[3], 2.538475959743658e-13, 1e-12, "variance of y");
    expect_relative(thin.covariance[1], -1.488017652348699e-19, 1e-9, "covariance");
    EXPECT_NEAR(thin.skewness[0], -3.464103348544252e-7, 1e-13);
    const Moments narrow = exact("sector:angles=[0,1e-7]");
    expect_relative(narrow.mean[1], 5.817764173314432e-10, 1e-13, "mean of y");
    expect_relative(narrow.covariance[3], 1.692318998815048e-19, 1e-13, "variance of y");
    EXPECT_NEAR(narrow.skewness[1], 0.565685424949238, 1e-13);
    const Moments part = exact("sector:inner=0.9,angles=[20,30]");
    EXPECT_NEAR(part.skewness[0], 0.006187531342763921, 1e-13);
    EXPECT_NEAR(part.skewness[1], 0.01962332114469448, 1e-13);
    const Moments most = exact("sector:inner=0.25,angles=[45,400]");
    EXPECT_NEAR(most.covariance[1], -0.003770618000697465, 1e-15);
    EXPECT_NEAR(most.skewness[0], 0.02470694605333228, 1e-14);
    EXPECT_NEAR(most.skewness[1], 0.02522194370545052, 1e-14);
}

// References by mpmath, by Gauss's rule in the plane that touches the sphere.
TEST(LawMoments, OfSmallSphericalTriangles) {
    const Moments m = exact("spherical-triangle:vertices=[1,0,0 1,0.05,0 1,0.01,0.05]");
    expect_relative(m.covariance[0], 8.018339496267625e-08, 1e-12, "variance of x");
    EXPECT_NEAR(m.skewness[0], -0.26605069814076204, 1e-11);
    EXPECT_NEAR(m.skewness[1], 0.47542790480692887, 1e-12);
    EXPECT_NEAR(m.skewness[2], 0.5650465989047438, 1e-12);
    // A flat triangle, as small as may be.
    const Moments flat = exact("spherical-triangle:vertices=[0,0,1 1e-4,0,1 0,1e-4,1]");
    EXPECT_NEAR(flat.skewness[0], 0.4 * std::sqrt(2), 1e-7);
}

TEST(LawMoments, OfNarrowPeaksOfFormulas) {
    for (const std::string width : {"1e-2", "1e-3", "1e-5"}) {
        const auto spec =
            "rejection:density=[exp(-((x-0.9)/" + width + ")^2)],bounds=[0..1],bound=1";
        const Moments m = exact(spec);
        EXPECT_NEAR(m.mean[0], 0.9, 1e-12) << spec;
        expect_relative(m.covariance[0], 0.5 * std::pow(std::stod(width), 2), 1e-9, spec);
        EXPECT_NEAR(m.skewness[0], 0, 1e-6) << spec;
    }
}

}  // namespace stipple::testing::law_moments_test
