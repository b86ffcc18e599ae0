// SPDX-License-Identifier: MIT
#include "experiments/parameters/linear_correlation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "math/distributions/laws.hpp"
#include "math/distributions/outcomes.hpp"

namespace stipple::testing::linear_correlation_test {
namespace {

using parameters::Scored;
using ::testing::HasSubstr;

MarginalPtr levels(std::vector<double> values, std::vector<double> weights) {
    return std::make_shared<const Outcomes>("levels", std::move(values), std::move(weights));
}

const std::map<std::string, MarginalPtr> laws = {
    {"bit", levels({0, 1}, {1, 1})},
    {"rare", levels({0, 1}, {0.9, 0.1})},
    {"levels", levels({0, 1, 5}, {0.2, 0.5, 0.3})},
    {"integers", integers_law(1, 8)},
    {"million", integers_law(1, 1e6)},
    {"normal", normal_law(3, 2)},
    {"uniform", uniform_law(-1, 4)},
    {"lognormal", lognormal_law(1, 2)},
    {"exponential", exponential_law(5)},
    {"weibull", weibull_law(0.4, 1)},
    {"gamma", gamma_law(0.1, 1)},
    {"student", student_t_law(3, 0, 1)},
    {"linear", interpolated_law({0, 1, 1.5, 9, 20})},
};

double scores(const std::string& a, const std::string& b, double r, Scored::Of of) {
    return Scored(laws.at(a), of).scores_for(Scored(laws.at(b), of), r);
}

double linear(const std::string& a, const std::string& b, double r) {
    return scores(a, b, r, Scored::Of::numbers);
}

double spearman(const std::string& a, const std::string& b, double r) {
    return scores(a, b, r, Scored::Of::ranks);
}

}  // namespace

// Two coins: 2 asin(r) / pi, W. F. Sheppard 1899. A coin and a normal number: r sqrt(2 / pi).
TEST(LinearCorrelation, OfCoinsHasAClosedForm) {
    for (const double r : {-0.9999, -0.5, 1e-3, 0.3, 0.9, 0.99, 0.999999}) {
        const double of_scores = std::sin(std::numbers::pi / 2 * r);
        EXPECT_NEAR(linear("bit", "bit", r), of_scores, 1e-10) << r;
        EXPECT_NEAR(spearman("bit", "bit", r), of_scores, 1e-10) << r;
        const double reach = std::sqrt(2 / std::numbers::pi);
        EXPECT_NEAR(linear("bit", "normal", r * reach), r, 1e-6) << r;
        EXPECT_NEAR(linear("normal", "normal", r), r, 1e-6) << r;
    }
}

TEST(LinearCorrelation, OfSmoothDistributionsHasAClosedForm) {
    for (const double r : {-0.99, -0.4, 0.75, 0.9999}) {
        EXPECT_NEAR(linear("uniform", "normal", r * std::sqrt(3 / std::numbers::pi)), r, 1e-6) << r;
        EXPECT_NEAR(linear("uniform", "uniform", 6 / std::numbers::pi * std::asin(r / 2)), r, 1e-6)
            << r;
        EXPECT_NEAR(linear("lognormal", "lognormal", std::expm1(4 * r) / std::expm1(4)), r, 1e-6)
            << r;
        EXPECT_NEAR(linear("lognormal", "normal", 2 * r / std::sqrt(std::expm1(4))), r, 1e-6) << r;
        // A million values are nearly continuous.
        EXPECT_NEAR(spearman("million", "normal", 6 / std::numbers::pi * std::asin(r / 2)), r, 1e-5)
            << r;
    }
}

// Values computed with NumPy and SciPy by sums and integrals of bivariate normal probabilities.
TEST(LinearCorrelation, OfOthersIsThatOfAnotherProgram) {
    struct Case {
        const char* a;
        const char* b;
        double of_scores;
        double linear;
    };
    const Case cases[] = {{"rare", "levels", 0.6, 0.321676372617},
                          {"levels", "levels", -0.7, -0.483195814743},
                          {"integers", "integers", 0.9, 0.876033070268},
                          {"exponential", "exponential", -0.8, -0.542453229269},
                          {"exponential", "exponential", 0.5, 0.453075020206},
                          {"student", "student", 0.6, 0.527598060358},
                          {"weibull", "exponential", 0.7, 0.490527204471},
                          {"gamma", "normal", 0.5, 0.294800342955},
                          {"levels", "exponential", 0.8, 0.642035471417}};
    for (const auto& [a, b, of_scores, r] : cases)
        EXPECT_NEAR(linear(a, b, r), of_scores, 1e-9) << a << ' ' << b;
    EXPECT_NEAR(spearman("integers", "levels", 0.861097810747), 0.95, 1e-9);
    EXPECT_NEAR(spearman("rare", "integers", -0.276418778785), -0.5, 1e-9);
    EXPECT_NEAR(spearman("levels", "uniform", 0.818096567048), 0.9, 1e-9);
}

// By Whitt's theorem, the extremes are reached by one common uniform number u, and by u and 1 - u.
TEST(LinearCorrelation, NamesTheEndsOfWhatIsPossible) {
    const auto says = [](const std::string& a, const std::string& b, double r, const char* range) {
        try {
            static_cast<void>(linear(a, b, r));
            ADD_FAILURE() << a << ' ' << b;
        } catch (const Error& e) {
            EXPECT_THAT(std::string(e.what()), HasSubstr(range)) << a << ' ' << b;
        }
    };
    // With p = .1 and .5: (p - p / 2) / sqrt(p (1 - p) / 4).
    says("rare", "bit", 0.34, "[-0.333333, 0.333333]");
    says("bit", "normal", 0.8, "[-0.797885, 0.797885]");                 // sqrt(2 / pi)
    says("exponential", "exponential", -0.65, "[-0.644934, 1.000000]");  // 1 - pi^2 / 6
    says("lognormal", "lognormal", -0.1, "[-0.018316, 1.000000]");       // -exp(-4)
    says("uniform", "exponential", 0.87, "[-0.866025, 0.866025]");       // sqrt(3) / 2
}

TEST(LinearCorrelation, RisesFromEndToEnd) {
    for (const std::string a : {"rare", "levels", "lognormal", "linear"})
        for (const std::string b : {"rare", "integers", "linear"}) {
            const Scored x(laws.at(a), Scored::Of::numbers), y(laws.at(b), Scored::Of::numbers);
            const double low = x.extreme(y, -1), high = x.extreme(y, 1);
            double before = -1;
            for (const double share : {1e-4, 0.3, 0.97, 0.9999}) {
                const double r = x.scores_for(y, low + share * (high - low));
                EXPECT_GT(r, before) << a << ' ' << b << ' ' << share;
                EXPECT_LT(std::abs(r), 1);
                before = r;
            }
        }
}

}  // namespace stipple::testing::linear_correlation_test
