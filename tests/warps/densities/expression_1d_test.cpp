// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/chain.hpp"
#include "support/warping.hpp"

namespace stipple::testing::expression_1d_test {
namespace {

double place(const Mapping& map, double u) {
    std::vector<double> x(1);
    map.forward({&u, 1}, x, {});
    return x[0];
}

}  // namespace

// Distribution functions by hand: x^2, (1 - exp(-x)) / (1 - exp(-3)), (x^3 + 1) / 2.
TEST(Expression1d, InvertsKnownDistributionFunctions) {
    const auto line = mapping("expression-1d:density=x");
    const auto decay = mapping("expression-1d:density=exp(-x),range=[0,3]");
    const auto square = mapping("expression-1d:density=3*x^2/2,range=[-1,1]");
    for (const double u : {0.0, 1e-6, 0.1, 0.25, 0.5, 0.77, 0.999, one_minus_ulp}) {
        EXPECT_NEAR(place(*line, u), std::sqrt(u), 1e-14);
        EXPECT_NEAR(place(*decay, u), -std::log(1 - u * (1 - std::exp(-3))), 3e-8);
        const double x = place(*square, u);
        EXPECT_NEAR((x * x * x + 1) / 2, u, 1e-9) << u;
    }
}

TEST(Expression1d, DensityIsTheFormulaOverItsIntegral) {
    const auto map = mapping("expression-1d:density=5*exp(-x*x/2),range=[-8,8]");
    for (const double x : {-8.0, -1.0, 0.0, 0.3, 2.0})
        EXPECT_NEAR(map->density(std::vector{x}), std::exp(-x * x / 2) / std::sqrt(2 * M_PI),
                    1e-13);
    EXPECT_EQ(map->density(std::vector{8.1}), 0);
}

// Probabilities of cells are the formula's, regardless of the table: exp(-x) on [0, 3].
TEST(Expression1d, ProbabilityIsTheFormulas) {
    for (const std::string rough : {"1e-9", "0.1"}) {
        const DomainPtr domain =
            mapping("expression-1d:density=exp(-x),range=[0,3],tolerance=" + rough)->domain();
        EXPECT_FALSE(domain->even());
        double sum = 0;
        for (int k = 0; k < 7; ++k) {
            const Box cell{{k / 7.0}, {(k + 1) / 7.0}};
            const Estimate p = domain->probability(cell);
            EXPECT_LT(p.error, 1e-10);
            sum += p.value;
            EXPECT_NEAR(p.value, 1 / 7.0, rough == "0.1" ? 1e-4 : 1e-9);
        }
        EXPECT_NEAR(sum, 1, 1e-12);
    }
    const DomainPtr step =
        mapping("expression-1d:density=[x<1/3 ? 3 : 0],tolerance=1e-6")->domain();
    EXPECT_NEAR(step->probability({{0}, {1}}).value, 1, 1e-12);
    EXPECT_EQ(step->density(std::vector{0.5}), 0);
    EXPECT_NEAR(step->density(std::vector{0.2}), 3, 1e-5);
}

TEST(Expression1d, GoesThereAndBack) {
    for (const std::string spec :
         {"density=1+x", "density=sin(x)^2+0.1,range=[-3,40],tolerance=1e-6",
          "density=[x<0.3 ? 0 : 2]", "density=exp(-x*x/2),range=[-6,6]",
          "density=1,range=[1e6,1000001]"}) {
        const auto map = mapping("expression-1d:" + spec);
        for (std::uint64_t i = 0; i < 20'000; ++i) {
            const double u = i < 2 ? static_cast<double>(i) * one_minus_ulp : Rng(3).uniform(i);
            const double x = place(*map, u);
            ASSERT_TRUE(map->domain()->contains({&x, 1})) << spec << " " << u;
            const double back = inverse_of(*map, {x})[0];
            ASSERT_NEAR(back, u, spec.find("1e6") == std::string::npos ? 1e-13 : 2e-10) << spec;
            ASSERT_TRUE(back >= 0 && back <= 1);
        }
    }
}

// Moments of the density 2 - 2 x: 1/3 and 1/18. 10^5 midpoints of strata leave errors below 1e-8.
TEST(Expression1d, MomentsAreThoseOfTheFormula) {
    const auto map = mapping("expression-1d:density=2-2*x");
    double mean = 0;
    double square = 0;
    const int n = 100'000;
    for (int i = 0; i < n; ++i) {
        const double x = place(*map, (i + 0.5) / n);
        mean += x / n;
        square += x * x / n;
    }
    EXPECT_NEAR(mean, 1 / 3.0, 1e-8);
    EXPECT_NEAR(square - mean * mean, 1 / 18.0, 1e-8);
}

TEST(Expression1d, DomainSaysWhatItIsAndParsesBack) {
    const DomainPtr domain =
        mapping("expression-1d:density=[1 - x * x],range=[-1,1],breaks=[0.5,0.25]")->domain();
    EXPECT_EQ(domain->spec(), "expression-1d:density=1-x*x,range=[-1,1],breaks=[0.5,0.25]");
    EXPECT_EQ(parse_domain(domain->spec(), 1)->spec(), domain->spec());
    EXPECT_EQ(domain->measure(), 2);
}

TEST(Expression1d, RefusesBadOptions) {
    EXPECT_EQ(error_of([] { mapping("expression-1d"); }),
              "usage: --density: no formula given; expected one in x, such as 'exp(-x)'");
    EXPECT_EQ(error_of([] { mapping("expression-1d:density=y"); }),
              "usage: --density: 'y', column 1: 'y': expected a number, an operator, x, pi, e or a "
              "function such as exp");
    EXPECT_EQ(error_of([] { mapping("expression-1d:density=x-1"); }),
              "usage: --density: x-1 is -1 at x = 0; a density must be finite and not below 0");
    EXPECT_EQ(error_of([] { mapping("expression-1d:density=1/x"); }),
              "usage: --density: 1/x is inf at x = 0; a density must be finite and not below 0");
    EXPECT_EQ(error_of([] { mapping("expression-1d:density=0*x"); }),
              "usage: --density: 0*x is 0 at all points tried from 0 to 1");
    EXPECT_EQ(error_of([] { mapping("expression-1d:density=x,range=[1,0]"); }),
              "usage: --range: '1,0' is not a,b with a < b");
    EXPECT_EQ(
        error_of([] { mapping("expression-1d:density=1,range=[1,1.0000000000000002]"); }),
        "usage: --range: the range from 1 to 1.0000000000000002 is so narrow that it is lost in "
        "rounding");
    EXPECT_EQ(
        error_of([] { mapping("rejection:density=1,bounds=1..1.0000000000000002"); }),
        "usage: --bounds: the range from 1 to 1.0000000000000002 is so narrow that it is lost "
        "in rounding");
    EXPECT_EQ(error_of([] { mapping("expression-1d:density=x,breaks=2"); }),
              "usage: --breaks: 2 is outside (0, 1)");
    EXPECT_EQ(error_of([] { inverse_of(*mapping("expression-1d:density=x"), {1.5}); }),
              "input: the point (1.5) is outside the domain expression-1d:density=x");
}

// Sums of such masses overflowed or lost digits: probabilities were wrong by 1e-5.
TEST(Expression1d, RefusesIntegralsBeyondDoubles) {
    for (const std::string spec :
         {"expression-1d:density=[1e308*(x/10)^3],range=[0,10]",
          "expression-1d:density=[1e-310*(x/10)^3],range=[0,10]",
          "expression-1d:density=[1-x/1e-300],range=[0,1e-300]",
          "expression-2d:density=[x+y],bounds=0..1e-180", "expression-2d:density=[1e307*(x+y)]"})
        EXPECT_NE(error_of([&] { mapping(spec); }).find("the integral is about "),
                  std::string::npos)
            << spec;
    for (const std::string spec : {"rejection:density=[1e-320*x],bound=1e-300,bounds=[0..1]",
                                   "rejection:density=[1e300*x],bound=1e300,bounds=[0..1]"})
        EXPECT_NE(error_of([&] {
                      (void)mapping(spec)->domain()->moments();
                  }).find("the integral is about "),
                  std::string::npos)
            << spec;
}

}  // namespace stipple::testing::expression_1d_test
