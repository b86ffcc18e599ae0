// SPDX-License-Identifier: MIT
#include "math/distributions/outcomes.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "math/distributions/families.hpp"
#include "math/distributions/laws.hpp"

namespace stipple::testing::outcomes_test {
namespace {

using Big = boost::multiprecision::cpp_bin_float_50;

/// Probabilities of 0, 1, ... from the first one and their ratios, to 50 digits.
template <class Ratio>
std::vector<Big> probabilities(Big first, std::size_t count, const Ratio& up) {
    std::vector<Big> p = {first};
    for (std::size_t k = 0; k + 1 < count; ++k) p.push_back(p.back() * up(k));
    return p;
}
std::vector<Big> poisson(double mean, std::size_t count) {
    return probabilities(exp(-Big(mean)), count,
                         [=](std::size_t k) { return Big(Big(mean) / (k + 1)); });
}
std::vector<Big> binomial(int n, double p) {
    return probabilities(pow(1 - Big(p), n), static_cast<std::size_t>(n) + 1, [=](std::size_t k) {
        return Big((Big(n) - k) / (k + 1) * Big(p) / (1 - Big(p)));
    });
}

/// Expects cells to have the right ends, to the last digits from both tails.
void expect_cells(const Marginal& law, const std::vector<Big>& p) {
    Big below = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
        const auto x = static_cast<double>(k);
        below += p[k];
        if (p[k] < 1e-290) continue;
        EXPECT_NEAR(law.density(x) / static_cast<double>(p[k]), 1, 1e-15) << k;
        Big above = 0;
        for (std::size_t j = p.size(); j-- > k + 1;) above += p[j];
        EXPECT_NEAR(law.probability(x) / static_cast<double>(below), 1, 4e-16) << k;
        if (above > 1e-290) {
            EXPECT_NEAR(law.probability(x, Tail::upper) / static_cast<double>(above), 1, 1e-15);
        }
        const double end = law.probability(x);
        if (end < law.probability(x + 1)) {
            EXPECT_EQ(law.quantile(end), x + 1) << "F(x) itself is the next outcome's";
            EXPECT_LE(law.quantile(std::nextafter(end, 0)), x);
        }
        const double rest = law.probability(x, Tail::upper);
        if (rest > 1e-290 && rest < 0.5) {
            EXPECT_EQ(law.quantile(rest, Tail::upper), x + 1) << rest;
            EXPECT_EQ(law.quantile(std::nextafter(rest, 1), Tail::upper), x);
        }
    }
}

}  // namespace

TEST(Outcomes, PoissonsCellsAreRightFromBothEnds) {
    expect_cells(*poisson_law(4), poisson(4, 400));
    expect_cells(*poisson_law(0.01), poisson(0.01, 200));
    expect_cells(*poisson_law(150.5), poisson(150.5, 1200));
}

TEST(Outcomes, BinomialCellsAreRightFromBothEnds) {
    expect_cells(*binomial_law(10, 0.5), binomial(10, 0.5));
    expect_cells(*binomial_law(1, 0.3), binomial(1, 0.3));
    expect_cells(*binomial_law(400, 0.1), binomial(400, 0.1));
    expect_cells(*binomial_law(50, 1 - 1e-9), binomial(50, 1 - 1e-9));
}

// Ten tosses of a coin: 1, 10, 45, 120, 210, 252, ... of 1024.
TEST(Outcomes, TenCoinsByHand) {
    const MarginalPtr law = binomial_law(10, 0.5);
    EXPECT_EQ(law->outcomes(), 11);
    EXPECT_EQ(law->density(2), 45 / 1024.0);
    EXPECT_EQ(law->density(2.5), 0);
    EXPECT_EQ(law->density(-1), 0);
    EXPECT_EQ(law->probability(1), 11 / 1024.0);
    EXPECT_EQ(law->probability(1.7), 11 / 1024.0);
    EXPECT_EQ(law->quantile(11 / 1024.0), 2);
    EXPECT_EQ(law->quantile(std::nextafter(11 / 1024.0, 0)), 1);
    EXPECT_EQ(law->quantile(0), 0);
    EXPECT_EQ(law->quantile(1), 10);
    EXPECT_EQ(law->quantile(0, Tail::upper), 10);
    EXPECT_EQ(law->quantile(1e-300, Tail::upper), 10);
    EXPECT_EQ(law->quantile(1.0 / 1024, Tail::upper), 10);
    EXPECT_EQ(law->quantile(1.5 / 1024, Tail::upper), 9);
}

TEST(Outcomes, ProbabilitiesSumToOneAndMomentsAreThoseOfTheFormulas) {
    for (const double mean : {1e-12, 0.3, 4.0, 1234.5, 1e6}) {
        const MarginalPtr law = poisson_law(mean);
        const auto [m, variance, skewness] = law->moments();
        EXPECT_NEAR(m / mean, 1, 1e-12);
        EXPECT_NEAR(variance / mean, 1, 1e-12);
        EXPECT_NEAR(skewness * std::sqrt(mean), 1, 1e-7);
        EXPECT_EQ(law->probability(law->support().second), 1);
    }
    const auto [m, variance, skewness] = binomial_law(1000, 0.2)->moments();
    EXPECT_NEAR(m, 200, 1e-10);
    EXPECT_NEAR(variance, 160, 1e-9);
    EXPECT_NEAR(skewness, 0.6 / std::sqrt(160), 1e-12);
}

// Far out with a large mean, by Stirling's series:
//     log p(k) = k log(mean / k) - mean + k - log(2 pi k) / 2 - 1 / (12 k) + 1 / (360 k^3).
TEST(Outcomes, KeepsItsDigitsFarFromALargeMean) {
    const MarginalPtr law = poisson_law(1e6);
    for (const double k : {970'000.0, 1'000'000.0, 1'034'000.0}) {
        const Big n = k;
        const Big log_p = n * log(Big(1e6) / n) - 1e6 + n -
                          log(2 * boost::math::constants::pi<Big>() * n) / 2 - 1 / (12 * n) +
                          1 / (360 * n * n * n);
        EXPECT_NEAR(law->density(k) / static_cast<double>(Big(exp(log_p))), 1, 1e-14) << k;
    }
}

TEST(Outcomes, ManyQuantilesAreThoseOfOneEach) {
    const MarginalPtr law = poisson_law(7);
    std::vector<double> many = {0, 1e-300, 0.1, 0.5, 0.999, 1 - 0x1p-53, 1};
    const std::vector<double> p = many;
    law->quantiles(many);
    for (std::size_t i = 0; i < p.size(); ++i) EXPECT_EQ(many[i], law->quantile(p[i]));
    EXPECT_EQ(many[5], many[6]);
}

TEST(Integers, ADieByHand) {
    const MarginalPtr die = integers_law(1, 6);
    EXPECT_EQ(die->quantile(0), 1);
    EXPECT_EQ(die->quantile(0.5), 4);
    EXPECT_EQ(die->quantile(1), 6);
    EXPECT_EQ(die->quantile(0.5, Tail::upper), 4);
    EXPECT_EQ(die->quantile(1e-300, Tail::upper), 6);
    EXPECT_EQ(die->quantile(1, Tail::upper), 1);
    EXPECT_EQ(die->probability(2), 2 / 6.0);
    EXPECT_EQ(die->probability(2.5, Tail::upper), 4 / 6.0);
    EXPECT_EQ(die->density(3), 1 / 6.0);
    EXPECT_EQ(die->density(3.5), 0);
    EXPECT_EQ(die->density(7), 0);
    const auto [mean, variance, skewness] = die->moments();
    EXPECT_EQ(mean, 3.5);
    EXPECT_EQ(variance, 35 / 12.0);
    EXPECT_EQ(skewness, 0);
    EXPECT_EQ(die->outcomes(), 6);
}

TEST(Empirical, StepsByHand) {
    const MarginalPtr law = empirical_law({5, 1, 5, -2});
    EXPECT_EQ(law->support(), (std::pair{-2.0, 5.0}));
    EXPECT_EQ(law->outcomes(), 3);
    EXPECT_EQ(law->density(5), 0.5);
    EXPECT_EQ(law->quantile(0), -2);
    EXPECT_EQ(law->quantile(0.25), 1);
    EXPECT_EQ(law->quantile(0.5), 5);
    EXPECT_EQ(law->probability(1), 0.5);
    EXPECT_EQ(law->probability(4), 0.5);
}

// Definition 7 of Hyndman and Fan, as in numpy.quantile: [1, 2, 4, 8] has 1.75, 3 and 5 at 1/4, 1/2
// and 3/4.
TEST(Empirical, InterpolationByHand) {
    const MarginalPtr law = interpolated_law({8, 1, 4, 2});
    EXPECT_EQ(law->quantile(0), 1);
    EXPECT_EQ(law->quantile(0.25), 1.75);
    EXPECT_EQ(law->quantile(0.5), 3);
    EXPECT_EQ(law->quantile(0.75), 5);
    EXPECT_EQ(law->quantile(1), 8);
    EXPECT_EQ(law->quantile(0.25, Tail::upper), 5);
    EXPECT_DOUBLE_EQ(law->probability(3), 0.5);
    EXPECT_DOUBLE_EQ(law->probability(3, Tail::upper), 0.5);
    EXPECT_DOUBLE_EQ(law->density(3), 1 / 6.0);
    EXPECT_DOUBLE_EQ(law->density(7), 1 / 12.0);
    EXPECT_EQ(law->density(9), 0);
    // Pieces [1, 2], [2, 4], [4, 8] with probability 1/3 each: E x = 3.5, E x^2 = (7/3 + 28/3 +
    // 112/3) / 3.
    const auto [mean, variance, skewness] = law->moments();
    EXPECT_DOUBLE_EQ(mean, 3.5);
    EXPECT_DOUBLE_EQ(variance, 49 / 3.0 - 3.5 * 3.5);
    const MarginalMoments sums = moments_by_quadrature(*law);
    EXPECT_NEAR(sums.skewness, skewness, 1e-8);
}

}  // namespace stipple::testing::outcomes_test
