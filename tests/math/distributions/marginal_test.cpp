// SPDX-License-Identifier: MIT
#include "math/distributions/marginal.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "math/densities/quadrature.hpp"
#include "math/distributions/families.hpp"

namespace stipple::testing::marginal_test {
namespace {

using Big = boost::multiprecision::cpp_bin_float_50;

/// A distribution with its tails to 50 digits.
struct Case {
    std::string family;
    NamedNumbers numbers;
    std::function<Big(const Big&)> below;
    std::function<Big(const Big&)> above;

    MarginalPtr law() const { return make_marginal(family, numbers); }
    Big tail(double x, Tail which) const { return which == Tail::lower ? below(x) : above(x); }
    /// Density by a central difference, to about 20 digits.
    Big density(double x, Tail which) const {
        const Big step = abs(Big(x)) * 1e-12;
        const auto& rest = which == Tail::lower ? below : above;
        return abs(Big(rest(x + step) - rest(x - step))) / (2 * step);
    }
    /// Scale for errors of a quantile: |x|, or a larger number if a quantile near 0 is computed as
    /// a difference from it.
    double size(double x) const {
        double most = std::abs(x);
        for (const char* name : {"location", "mean"}) most = std::max(most, std::abs(number(name)));
        if (family == "triangular")
            for (const char* name : {"low", "high"}) most = std::max(most, std::abs(number(name)));
        return most;
    }
    double number(std::string_view name) const {
        for (const auto& [known, x] : numbers)
            if (known == name) return x;
        return 0;
    }
};

Big normal_below(const Big& z) { return boost::math::erfc(Big(-z / sqrt(Big(2)))) / 2; }
Big decayed(const Big& x) { return -boost::math::expm1(Big(-x)); }

Case uniform(double low, double high) {
    return {"uniform",
            {{"low", low}, {"high", high}},
            [=](const Big& x) { return Big((x - low) / (Big(high) - low)); },
            [=](const Big& x) { return Big((high - x) / (Big(high) - low)); }};
}
Case log_uniform(double low, double high) {
    return {"log-uniform",
            {{"low", low}, {"high", high}},
            [=](const Big& x) { return Big(log(x / low) / log(Big(high) / low)); },
            [=](const Big& x) { return Big(log(high / x) / log(Big(high) / low)); }};
}
Case triangular(double a, double c, double b) {
    const Big width = Big(b) - a;
    const Big rise = Big(c) - a;
    const Big fall = Big(b) - c;
    const auto below = [=](const Big& x) {
        return x < c ? Big((x - a) * (x - a) / (width * rise))
                     : Big((rise + (x - c) * (2 * Big(b) - x - c) / fall) / width);
    };
    const auto above = [=](const Big& x) {
        return x < c ? Big((fall + (c - x) * (c + x - 2 * Big(a)) / rise) / width)
                     : Big((b - x) * (b - x) / (width * fall));
    };
    return {"triangular", {{"low", a}, {"mode", c}, {"high", b}}, below, above};
}
Case normal(double mean, double deviation) {
    return {"normal",
            {{"mean", mean}, {"deviation", deviation}},
            [=](const Big& x) { return normal_below((x - mean) / deviation); },
            [=](const Big& x) { return normal_below((mean - x) / deviation); }};
}
Case lognormal(double mu, double sigma) {
    return {"lognormal",
            {{"mu", mu}, {"sigma", sigma}},
            [=](const Big& x) { return normal_below((log(x) - mu) / sigma); },
            [=](const Big& x) { return normal_below((mu - log(x)) / sigma); }};
}
Case exponential(double rate) {
    return {"exponential",
            {{"rate", rate}},
            [=](const Big& x) { return decayed(rate * x); },
            [=](const Big& x) { return Big(exp(-rate * x)); }};
}
Case weibull(double shape, double scale) {
    const auto power = [=](const Big& x) { return Big(pow(x / scale, Big(shape))); };
    return {"weibull",
            {{"shape", shape}, {"scale", scale}},
            [=](const Big& x) { return decayed(power(x)); },
            [=](const Big& x) { return Big(exp(-power(x))); }};
}
Case gumbel(double location, double scale) {
    const auto decay = [=](const Big& x) { return Big(exp((location - x) / scale)); };
    return {"gumbel",
            {{"location", location}, {"scale", scale}},
            [=](const Big& x) { return Big(exp(-decay(x))); },
            [=](const Big& x) { return decayed(decay(x)); }};
}
Case gamma(double shape, double scale) {
    return {"gamma",
            {{"shape", shape}, {"scale", scale}},
            [=](const Big& x) { return boost::math::gamma_p(Big(shape), Big(x / scale)); },
            [=](const Big& x) { return boost::math::gamma_q(Big(shape), Big(x / scale)); }};
}
Case beta(double a, double b, double low = 0, double high = 1) {
    const auto below = [=](const Big& x) {
        return boost::math::ibeta(Big(a), Big(b), Big((x - low) / (Big(high) - low)));
    };
    const auto above = [=](const Big& x) {
        return boost::math::ibeta(Big(b), Big(a), Big((high - x) / (Big(high) - low)));
    };
    return {"beta", {{"a", a}, {"b", b}, {"low", low}, {"high", high}}, below, above};
}
Case student_t(double degrees, double location = 0, double scale = 1) {
    const auto beyond = [=](const Big& t) {
        const Big z = degrees / (degrees + t * t);
        return Big(boost::math::ibeta(Big(degrees / 2), Big(0.5), z) / 2);
    };
    const auto below = [=](const Big& t) { return t < 0 ? beyond(t) : Big(1 - beyond(t)); };
    return {"student-t",
            {{"degrees", degrees}, {"location", location}, {"scale", scale}},
            [=](const Big& x) { return below(Big((x - location) / scale)); },
            [=](const Big& x) { return below(Big((location - x) / scale)); }};
}

std::vector<Case> cases() {
    return {uniform(0, 1),
            uniform(-3, 0),
            log_uniform(1, 10),
            log_uniform(1e-100, 1),
            triangular(0, 0.5, 1),
            triangular(0, 0, 2),
            triangular(-1, 0, 0),
            normal(0, 1),
            normal(5, 0.1),
            lognormal(0, 1),
            lognormal(-3, 0.01),
            lognormal(10, 5),
            exponential(1),
            exponential(1e-3),
            weibull(2, 1),
            weibull(0.7, 5),
            weibull(100, 1),
            gumbel(0, 1),
            gumbel(-7, 3),
            gamma(2, 1),
            gamma(1, 2),
            gamma(0.4, 3),
            gamma(50, 0.1),
            gamma(2000, 1),
            beta(2, 2),
            beta(0.5, 0.5),
            beta(1, 3),
            beta(5, 1.5, -2, 0),
            beta(40, 200),
            student_t(1),
            student_t(2),
            student_t(2.5),
            student_t(4, 1, 2),
            student_t(10),
            student_t(100),
            student_t(0.6)};
}

const std::vector<double> probabilities = {1e-300, 1e-20, 0.1, 0.5, 0.9, 1 - 0x1p-53};

std::string named(const Case& one) {
    std::string text = one.family;
    for (const auto& [name, x] : one.numbers) text += fmt::format(" {}={}", name, x);
    return text;
}

}  // namespace

// First-order error of a quantile: the error of its probability divided by the density.
TEST(Marginal, QuantilesAreRightInBothTailsToFiftyDigitsOfTheirProbability) {
    for (const Case& one : cases()) {
        const MarginalPtr law = one.law();
        for (const Tail tail : {Tail::lower, Tail::upper})
            for (const double p : probabilities) {
                const double x = law->quantile(p, tail);
                if (std::abs(x) < 1e-300 || std::isinf(x)) continue;  // outside the range of double
                const auto [low, high] = law->support();
                if (x == low || x == high) continue;  // too close to an end for double
                const Big off = (one.tail(x, tail) - p) / one.density(x, tail);
                EXPECT_LT(static_cast<double>(abs(off)), 1e-13 * one.size(x))
                    << named(one) << (tail == Tail::lower ? " below" : " above") << ", p = " << p
                    << ", x = " << x;
            }
    }
}

// Condition: if x (density) / probability is large, so is the effect of rounding x.
TEST(Marginal, ProbabilitiesAreRightInBothTails) {
    for (const Case& one : cases()) {
        const MarginalPtr law = one.law();
        for (const Tail tail : {Tail::lower, Tail::upper})
            for (const double p : probabilities) {
                const double x = law->quantile(p, tail);
                const auto [low, high] = law->support();
                if (std::abs(x) < 1e-300 || std::isinf(x) || x == low || x == high) continue;
                const double mine = law->probability(x, tail);
                const double right = static_cast<double>(one.tail(x, tail));
                const double condition = 1 + law->density(x) * std::abs(x) / right;
                EXPECT_LT(std::abs(mine / right - 1), 2e-13 + 4e-16 * condition)
                    << named(one) << (tail == Tail::lower ? " below" : " above") << ", p = " << p;
            }
    }
}

TEST(Marginal, ManyQuantilesAreThoseOfOneEach) {
    for (const Case& one : cases()) {
        const MarginalPtr law = one.law();
        std::vector<double> many;
        for (int i = 1; i < 300; ++i) many.push_back(i / 300.0);
        const std::vector<double> p = many;
        law->quantiles(many);
        for (std::size_t i = 0; i < p.size(); ++i)
            ASSERT_EQ(many[i], law->quantile(p[i])) << named(one);
    }
}

TEST(Marginal, QuantilesRise) {
    for (const Case& one : cases()) {
        const MarginalPtr law = one.law();
        double last = -INFINITY;
        for (int i = 1; i < 1000; ++i) {
            const double x = law->quantile(i / 1000.0);
            ASSERT_GE(x, last) << named(one);
            last = x;
        }
        for (const double p : {0.1, 0.25, 0.5})  // equal from both tails
            EXPECT_NEAR(law->quantile(p), law->quantile(1 - p, Tail::upper), 1e-13 * one.size(last))
                << named(one);
    }
}

TEST(Marginal, EndsOfTheSupportAreTheQuantilesOf0And1) {
    for (const Case& one : cases()) {
        const MarginalPtr law = one.law();
        const auto [low, high] = law->support();
        EXPECT_EQ(law->quantile(0), low);
        EXPECT_EQ(law->quantile(1), high);
        EXPECT_EQ(law->quantile(0, Tail::upper), high);
        EXPECT_EQ(law->quantile(1, Tail::upper), low);
        EXPECT_EQ(law->probability(low - 1), 0);
        EXPECT_EQ(law->probability(high + 1), 1);
        EXPECT_EQ(law->probability(high + 1, Tail::upper), 0);
        EXPECT_EQ(std::isinf(low) ? 0 : law->density(low - 1), 0);
        EXPECT_FALSE(law->discrete());
        EXPECT_EQ(law->name(), one.family);
    }
}

// The integral of the density between two quantiles is the difference of their probabilities.
TEST(Marginal, DensityIntegratesToTheProbability) {
    for (const Case& one : cases()) {
        const MarginalPtr law = one.law();
        const std::vector<double> p = {0.01, 0.1, 0.35, 0.5, 0.8, 0.99};
        for (std::size_t i = 1; i < p.size(); ++i) {
            const auto f = [&](double x) { return law->density(x); };
            const double mass =
                integrate_interval(f, law->quantile(p[i - 1]), law->quantile(p[i])).value;
            EXPECT_NEAR(mass, p[i] - p[i - 1], 1e-9) << named(one) << " from " << p[i - 1];
        }
    }
}

TEST(Marginal, MomentsAreThoseOfTheIntegrals) {
    for (const Case& one : cases()) {
        const MarginalPtr law = one.law();
        const auto [mean, variance, skewness] = law->moments();
        if (std::isnan(mean) || std::isinf(variance) || std::isnan(skewness)) {
            EXPECT_EQ(one.family, "student-t");
            continue;
        }
        if (one.family == "lognormal" && one.number("sigma") > 2) continue;  // mass out of range
        const MarginalMoments m = moments_by_quadrature(*law);
        const double deviation = std::sqrt(variance);
        // Third moments of Student's t converge slowly.
        const double tolerance = one.family == "student-t" ? 1e-3 : 1e-8;
        EXPECT_NEAR(m.mean, mean, tolerance * deviation) << named(one);
        EXPECT_NEAR(m.variance / variance, 1, tolerance) << named(one);
        EXPECT_NEAR(m.skewness, skewness, 10 * tolerance * (1 + std::abs(skewness))) << named(one);
    }
}

// Values with 200 digits by mpmath: at parameters where closed forms would cancel, and near them.
TEST(Marginal, MomentsKeepTheirDigits) {
    const auto near = [](double value, double right) {
        EXPECT_NEAR(value, right, 1e-11 * std::abs(right)) << right;
    };
    const auto skewness = [](std::string_view family, const NamedNumbers& numbers) {
        return make_marginal(family, numbers)->moments().skewness;
    };
    near(skewness("log-uniform", {{"low", 1}, {"high", 1.000001}}), 3.4640998828030986e-7);
    near(skewness("log-uniform", {{"low", 1}, {"high", 54.5}}), 1.2683836392985325);
    near(skewness("log-uniform", {{"low", 1}, {"high", 54.7}}), 1.2693767423784538);
    near(skewness("log-uniform", {{"low", 1e-150}, {"high", 1e150}}), 24.725673431295983);
    near(skewness("weibull", {{"shape", 0.05}}), 11290345890.687891);
    near(skewness("weibull", {{"shape", 10}}), -0.63763713390314441);
    near(skewness("weibull", {{"shape", 11}}), -0.6771019561959292);
    near(skewness("weibull", {{"shape", 1000}}), -1.1335927306601352);
    near(skewness("poisson", {{"mean", 1e8}}), 1e-4);
    near(skewness("binomial", {{"trials", 1e8}, {"probability", 0.25}}),
         0.5 / std::sqrt(1e8 * 3 / 16));
}

// With the mode at the low end, F(x) = 1 - (1 - x)^2 = 2 x - x^2, from either tail.
TEST(Marginal, TriangularKeepsItsDigitsBesideAModeAtAnEnd) {
    const auto law = [](double mode) { return make_marginal("triangular", {{"mode", mode}}); };
    for (const double p : {1e-300, 1e-30, 1e-16, 1e-9}) {
        EXPECT_DOUBLE_EQ(law(0)->quantile(p), p / 2 * (1 + p / 4));
        EXPECT_DOUBLE_EQ(law(0)->probability(p), 2 * p - p * p);
        EXPECT_DOUBLE_EQ(law(0)->quantile(p, Tail::upper), 1 - std::sqrt(p));
    }
    const MarginalPtr below = make_marginal("triangular", {{"low", -1}, {"mode", 0}, {"high", 0}});
    EXPECT_DOUBLE_EQ(below->quantile(1e-30, Tail::upper), -5e-31);
    EXPECT_DOUBLE_EQ(below->probability(-1e-30, Tail::upper), 2e-30);
}

// Cauchy's distribution has P(T > t) = 1 / (pi t) for large t, and the density 1 / (pi t^2).
TEST(Marginal, DensitiesFarOutAre0) {
    const auto density = [](const char* family, const NamedNumbers& numbers, double x) {
        return make_marginal(family, numbers)->density(x);
    };
    EXPECT_EQ(density("weibull", {{"shape", 1000}}, 3), 0);
    EXPECT_EQ(density("weibull", {{"shape", 1000}}, 1e300), 0);
    EXPECT_EQ(density("gamma", {{"shape", 500}, {"scale", 1e-100}}, 1e300), 0);
    EXPECT_EQ(density("gamma", {{"shape", 500}, {"scale", 1}}, 1e-320), 0);
    // x^1.130486784105228 / B(2.130486784105228, 1): the power itself is 1e-491.
    EXPECT_NEAR(density("beta", {{"a", 2.130486784105228}, {"b", 1}}, 2.6006440544197216e-231) /
                    4.521423686306389e-261,
                1, 1e-13);
}

TEST(Marginal, StudentIsRightWhereSquaresOverflow) {
    const MarginalPtr cauchy = make_marginal("student-t", {{"degrees", 1}});
    for (const double t : {1e100, 1e160, 1e250})
        EXPECT_NEAR(cauchy->probability(t, Tail::upper) * M_PI * t, 1, 1e-13);
    EXPECT_NEAR(cauchy->density(1e100) * M_PI * 1e200, 1, 1e-13);
    EXPECT_NEAR(cauchy->probability(-cauchy->quantile(1e-250, Tail::upper)) / 1e-250, 1, 1e-13);
}

// Student's t has a mean above 1 degree of freedom, a variance above 2, a skewness above 3.
TEST(Marginal, MomentsThatDoNotExistAreNotGiven) {
    const auto of = [](double degrees) {
        return make_marginal("student-t", {{"degrees", degrees}})->moments();
    };
    EXPECT_TRUE(std::isnan(of(1).mean));
    EXPECT_TRUE(std::isinf(of(2).variance));
    EXPECT_EQ(of(2).mean, 0);
    EXPECT_TRUE(std::isnan(of(3).skewness));
    EXPECT_EQ(of(3).variance, 3);
    EXPECT_EQ(of(4).skewness, 0);
}

}  // namespace stipple::testing::marginal_test
