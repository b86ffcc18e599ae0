// SPDX-License-Identifier: MIT
#include "math/distributions/families.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/units.hpp"

namespace stipple::testing::families_test {
namespace {

std::string refusal(std::string_view family, const NamedNumbers& numbers) {
    return error_of([&] { make_marginal(family, numbers, "x2."); });
}

}  // namespace

TEST(MarginalFamilies, AreInOrderAndMakeWhatTheyAreNamedFor) {
    EXPECT_TRUE(std::ranges::is_sorted(marginal_families(), {}, &MarginalFamily::name));
    for (const MarginalFamily& family : marginal_families()) {
        const MarginalPtr law = make_marginal(family.name, {});
        EXPECT_EQ(law->name(), family.name);
        EXPECT_GT(law->density(law->quantile(0.3)), 0);
        for (const MarginalParameter& parameter : family.parameters) {
            EXPECT_FALSE(parameter.help.empty());
            const double x = parameter.fallback.value_or(parameter.low);
            EXPECT_TRUE(x >= parameter.low && x <= parameter.high) << parameter.name;
        }
    }
}

TEST(MarginalFamilies, TakeParametersByName) {
    EXPECT_EQ(make_marginal("uniform", {{"high", 4}, {"low", 2}})->quantile(0.25), 2.5);
    EXPECT_EQ(make_marginal("uniform", {{"low", -1}})->quantile(0.5), 0);
    EXPECT_EQ(make_marginal("normal", {{"mean", 3}})->quantile(0.5), 3);
    EXPECT_EQ(make_marginal("integers", {{"low", 0}, {"high", 0}})->quantile(0.5), 0);
}

TEST(MarginalFamilies, LognormalByItsOwnMeanAndDeviation) {
    const MarginalPtr law = make_marginal("lognormal", {{"mean", 5}, {"deviation", 2}});
    const auto [mean, variance, skewness] = law->moments();
    EXPECT_NEAR(mean, 5, 1e-14);
    EXPECT_NEAR(variance, 4, 1e-13);
    EXPECT_NEAR(law->quantile(0.5), 5 / std::sqrt(1 + 0.16), 1e-14);  // the median
}

TEST(MarginalFamilies, SayWhatIsWrong) {
    EXPECT_EQ(refusal("gamma", {{"shape", -1}}), "usage: x2.shape: -1 is outside [0.05, 1000000]");
    EXPECT_EQ(refusal("gamma", {{"shape", NAN}}),
              "usage: x2.shape: nan is outside [0.05, 1000000]");
    EXPECT_EQ(refusal("gamma", {{"rate", 1}}),
              "usage: gamma has no parameter 'rate' | known: shape, scale");
    EXPECT_EQ(refusal("gama", {}),
              "usage: there is no distribution 'gama' | did you mean 'gamma'?");
    EXPECT_EQ(refusal("uniform", {{"low", 2}}), "usage: x2.low: 2 is not below x2.high, 1");
    EXPECT_EQ(refusal("triangular", {{"mode", 2}}), "usage: x2.mode: 2 is outside [0, 1]");
    EXPECT_EQ(refusal("binomial", {{"trials", 2.5}}),
              "usage: x2.trials: 2.5 is not a whole number");
    EXPECT_EQ(refusal("integers", {{"low", 7}}), "usage: x2.low: 7 is above x2.high, 6");
    EXPECT_EQ(refusal("lognormal", {{"mean", 2}}),
              "usage: x2.mean: x2.deviation is needed as well");
    EXPECT_EQ(refusal("lognormal", {{"mean", 2}, {"deviation", 1}, {"mu", 0}}),
              "usage: x2.mean: cannot be combined with x2.mu or x2.sigma; give mu and sigma, or "
              "mean and deviation");
    EXPECT_EQ(refusal("lognormal", {{"sigma", 100}}),
              "usage: x2.sigma: mu = 0 and sigma = 100 give numbers that are too small or too "
              "large; expected sigma of at least 1e-9 and |mu| + 38 sigma of at most 650");
}

TEST(MarginalFamilies, RefuseScalesThatVanishBesideTheirPlace) {
    // All points of such a distribution would be the same number, or a few.
    EXPECT_EQ(refusal("gumbel", {{"location", 1e100}}),
              "usage: x2.location: 1e+100 is so far from 0 that a scale of 1 is lost in rounding");
    EXPECT_EQ(refusal("normal", {{"mean", -1e20}, {"deviation", 10}}),
              "usage: x2.mean: -1e+20 is so far from 0 that a deviation of 10 is lost in rounding");
    EXPECT_FALSE(refusal("student-t", {{"location", 1e15}}).empty());
    EXPECT_TRUE(refusal("student-t", {{"location", 1e13}}).empty());
    EXPECT_EQ(refusal("uniform", {{"low", 1}, {"high", 1 + 1e-14}}),
              "usage: x2.low: the range from 1 to 1.00000000000001 is so narrow that it is lost in "
              "rounding");
    for (const char* family : {"beta", "triangular", "uniform"})
        EXPECT_FALSE(refusal(family, {{"low", -1e-320}, {"high", 1e-320}}).empty()) << family;
    EXPECT_FALSE(refusal("log-uniform", {{"low", 1}, {"high", std::nextafter(1, 2)}}).empty());
}

}  // namespace stipple::testing::families_test
