// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

#include "math/densities/quadrature.hpp"
#include "math/distributions/laws.hpp"
#include "math/distributions/marginal.hpp"
#include "support/units.hpp"

namespace stipple::testing::truncated_test {
namespace {

using Big = boost::multiprecision::cpp_bin_float_50;
constexpr double endless = std::numeric_limits<double>::infinity();

/// P(Z > z) to 50 digits.
Big beyond(double z) {
    return std::isinf(z) ? Big(z > 0 ? 0 : 1) : Big(boost::math::erfc(Big(z) / sqrt(Big(2))) / 2);
}

/// P(a < Z < b), from the nearer tail.
Big between(double a, double b) {
    return a + b < 0 ? beyond(-b) - beyond(-a) : beyond(a) - beyond(b);
}

struct Ends {
    double low;
    double high;
};

}  // namespace

TEST(Truncated, NormalIsRightAlsoFarOutInATail) {
    for (const auto& [low, high] :
         {Ends{30, endless}, Ends{-endless, -33}, Ends{36, 36.5}, Ends{-36, -35}, Ends{-1, 2},
          Ends{0, endless}, Ends{5, endless}, Ends{-8, 8}, Ends{-endless, 1}, Ends{2, 2.001}}) {
        const MarginalPtr law = truncated(normal_law(0, 1), low, high);
        const Big mass = between(low, high);
        for (const double p : {1e-20, 0.001, 0.1, 0.5, 0.9, 1 - 0x1p-53})
            for (const Tail tail : {Tail::lower, Tail::upper}) {
                const double x = law->quantile(p, tail);
                EXPECT_TRUE(x >= low && x <= high);
                const Big part = tail == Tail::lower ? between(low, x) : between(x, high);
                // Effect of rounding x, as a fraction of the mass.
                const double density = law->density(x);
                const double rounding = 1e-15 * (1 + std::abs(x)) * density;
                EXPECT_NEAR(static_cast<double>(part / mass), p, rounding + 2e-13 * p)
                    << low << ".." << high << ", p = " << p << ", x = " << x;
                EXPECT_NEAR(law->probability(x, tail), static_cast<double>(part / mass),
                            1e-13 + rounding);
                const Big right =
                    exp(-Big(x) * x / 2) / sqrt(2 * boost::math::constants::pi<Big>()) / mass;
                EXPECT_NEAR(density / static_cast<double>(right), 1, 3e-13) << x;
            }
    }
}

// Beyond a, an exponential distribution is the same shifted by a.
TEST(Truncated, ExponentialForgets) {
    const MarginalPtr law = truncated(exponential_law(2), 300, endless);
    for (const double p : {0.01, 0.5, 0.99})
        EXPECT_NEAR(law->quantile(p), 300 + exponential_law(2)->quantile(p), 1e-12);
    const auto [mean, variance, skewness] = law->moments();
    EXPECT_NEAR(mean, 300.5, 1e-8);
    EXPECT_NEAR(variance, 0.25, 1e-8);
    EXPECT_NEAR(skewness, 2, 1e-7);
}

// The half-normal distribution has mean sqrt(2 / pi) and variance 1 - 2 / pi.
TEST(Truncated, HalfNormalHasItsMoments) {
    const auto [mean, variance, skewness] = truncated(normal_law(0, 1), 0, endless)->moments();
    EXPECT_NEAR(mean, std::sqrt(2 / M_PI), 1e-9);
    EXPECT_NEAR(variance, 1 - 2 / M_PI, 1e-9);
    EXPECT_NEAR(skewness, std::sqrt(2.0) * (4 - M_PI) / std::pow(M_PI - 2, 1.5), 1e-8);
}

// With nu degrees of freedom, E T^n is infinite for n >= nu. Existing moments by incomplete beta
// functions to 50 digits.
TEST(Truncated, HeavyTailsHaveNoMomentsThatTheyDoNotHave) {
    const auto moments = [](double degrees, double low, double high) {
        return truncated(student_t_law(degrees, 0, 1), low, high)->moments();
    };
    const auto none = [](double x) { return !std::isfinite(x); };
    EXPECT_TRUE(none(moments(1, 1, endless).mean));
    EXPECT_TRUE(none(moments(1, -endless, 3).mean));
    EXPECT_NEAR(moments(2, 1, endless).mean, 2.7320508075688773, 1e-9);
    EXPECT_TRUE(none(moments(2, 1, endless).variance));
    EXPECT_NEAR(moments(3, 0, endless).variance, 1.7841457962919, 1e-9);
    EXPECT_TRUE(none(moments(3, 0, endless).skewness));
    // Truncated at both ends, so all exist.
    const auto [mean, variance, skewness] = moments(1, -2, 5);
    EXPECT_NEAR(mean, 0.33231722159350, 1e-11);
    EXPECT_NEAR(variance, 1.71152065881957, 1e-11);
    EXPECT_NEAR(skewness, 0.96360791588232, 1e-10);
    // Third powers in units of the middle half would overflow.
    EXPECT_NEAR(moments(0.5, 1, 1e120).skewness / 1.007007487745e+30, 1, 1e-10);
}

// Beyond 30 standard deviations, where quantiles end long before p = 1e-300; gamma of shape 1e6.
TEST(Truncated, MomentsFarOut) {
    const auto [mean, variance, skewness] = truncated(normal_law(0, 1), 30, endless)->moments();
    EXPECT_NEAR(mean, 30.033259667433677, 1e-11);
    EXPECT_NEAR(variance, 0.0011037715118900912, 1e-13);
    EXPECT_NEAR(skewness, 1.9934171521426809, 1e-9);
}

TEST(Truncated, OfWhatHasEndsAnywayTheNearerCount) {
    const MarginalPtr law = truncated(uniform_law(0, 1), -5, 0.5);
    EXPECT_EQ(law->support(), (std::pair{0.0, 0.5}));
    EXPECT_EQ(law->quantile(0.5), 0.25);
    EXPECT_EQ(law->density(0.3), 2);
    EXPECT_EQ(law->density(0.6), 0);
}

// Poisson with mean 3, truncated to 1..3: probabilities 3/12, 4.5/12, 4.5/12.
TEST(Truncated, DiscreteOnesAreCutExactly) {
    const MarginalPtr law = truncated(poisson_law(3), 0.5, 3.5);
    EXPECT_EQ(law->support(), (std::pair{1.0, 3.0}));
    EXPECT_DOUBLE_EQ(law->density(1), 0.25);
    EXPECT_DOUBLE_EQ(law->density(2), 0.375);
    EXPECT_EQ(law->density(4), 0);
    EXPECT_EQ(law->quantile(0.26), 2);
    const MarginalPtr die = truncated(integers_law(1, 6), 2.5, endless);
    EXPECT_EQ(die->support(), (std::pair{3.0, 6.0}));
    EXPECT_EQ(die->density(3), 0.25);
}

TEST(Truncated, RefusesWhatCannotBeDividedBy) {
    const auto error = [](const MarginalPtr& law, double low, double high) {
        return error_of([&] { truncated(law, low, high, "--"); });
    };
    EXPECT_EQ(error(normal_law(0, 1), 2, 1), "usage: --low: 2 is not below --high, 1");
    EXPECT_EQ(error(normal_law(0, 1), 40, 50),
              "usage: --low: normal has the probability 0 from 40 to 50; expected above 1e-290");
    EXPECT_EQ(error(uniform_law(0, 1), 3, 4),
              "usage: --low: uniform has the probability 0 from 3 to 4; expected above 1e-290");
    EXPECT_EQ(error(normal_law(0, 1), 0, 1e-8),
              "usage: --low: the range from 0 to 1e-08 is too narrow for float64; the probability "
              "of normal in it is less than 1e-6 of that beyond it");
    EXPECT_EQ(
        error(poisson_law(3), 0.2, 0.8),
        "usage: --low: poisson has no outcome with a probability above 1e-290 from 0.2 to 0.8");
}

}  // namespace stipple::testing::truncated_test
