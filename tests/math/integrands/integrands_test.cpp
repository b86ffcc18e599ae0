// SPDX-License-Identifier: MIT
//
// Exact integrals, compared with simple quadrature and with other formulas than those in the code.
#include "math/integrands/integrands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "core/spec.hpp"
#include "support/units.hpp"

namespace stipple::testing::integrand_test {
namespace {

Integrand integrand(const std::string& text, std::size_t dimension) {
    const Spec spec = parse_spec(text);
    const IntegrandKind& kind = integrand_kind(spec.name);
    return kind.make(dimension, spec.values(kind.options));
}

/// Gauss's rule with 30 points on each of several pieces of [0, 1].
template <class F>
double composite(const F& f, int pieces = 8) {
    double sum = 0;
    for (int j = 0; j < pieces; ++j)
        sum += boost::math::quadrature::gauss<double, 30>::integrate(
            f, static_cast<double>(j) / pieces, static_cast<double>(j + 1) / pieces);
    return sum;
}

/// Integral of functions that are smooth on the pieces.
double smooth_integral(const Integrand& one, std::size_t dimension) {
    const auto at = [&](double x, double y) { return one.value(std::array{x, y}); };
    if (dimension == 1) return composite([&](double x) { return one.value(std::array{x}); });
    return composite([&](double x) { return composite([&](double y) { return at(x, y); }); });
}

/// Adaptive integral, which handles kinks and jumps.
double adaptive_integral(const Integrand& one, std::size_t dimension) {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 15>;
    if (dimension == 1)
        return Rule::integrate([&](double x) { return one.value(std::array{x}); }, 0, 1, 30, 1e-11);
    const auto row = [&](double x) {
        return Rule::integrate(
            [&](double y) {
                return one.value(std::array{x, y});
            },
            0, 1, 24, 1e-9);
    };
    return Rule::integrate(row, 0, 1, 14, 1e-6);
}

/// Mean over the centres of m x m cells.
double midpoint_mean(const Integrand& one, int m) {
    double sum = 0;
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < m; ++j) sum += one.value(std::array{(i + 0.5) / m, (j + 0.5) / m});
    return sum / m / m;
}

TEST(Integrands, OfSmoothFunctionsHaveTheIntegralOfQuadrature) {
    for (const std::string name :
         {"genz-oscillatory", "genz-product-peak", "genz-corner-peak", "genz-gaussian",
          "genz-oscillatory:seed=2,difficulty=40", "genz-product-peak:seed=3,difficulty=20",
          "genz-corner-peak:seed=4,difficulty=30", "genz-gaussian:seed=5,difficulty=15",
          "smooth-gaussian", "smooth-gaussian:width=0.05", "sobol-g", "sobol-g:a=3"})
        for (const std::size_t d : {1, 2}) {
            const Integrand one = integrand(name, d);
            EXPECT_NEAR(one.exact / smooth_integral(one, d), 1, 1e-12) << name << " in " << d;
        }
    const Integrand uneven = integrand("sobol-g:a=[0.5,3]", 2);
    EXPECT_NEAR(uneven.exact / smooth_integral(uneven, 2), 1, 1e-12);
    EXPECT_DOUBLE_EQ(uneven.value(std::vector{1.0, 0.0}), 2.5 / 1.5 * 5 / 4);
    for (const std::string name : {"zone-plate", "zone-plate:phase=0", "zone-plate:phase=37"}) {
        const Integrand one = integrand(name, 2);
        EXPECT_NEAR(one.exact, smooth_integral(one, 2), 1e-13) << name;
    }
}

TEST(Integrands, WithKinksAndJumpsHaveTheIntegralOfQuadrature) {
    for (const std::string name : {"genz-continuous", "genz-continuous:seed=2,difficulty=3",
                                   "genz-discontinuous", "genz-discontinuous:seed=7"}) {
        const Integrand line = integrand(name, 1);
        EXPECT_NEAR(line.exact / adaptive_integral(line, 1), 1, 1e-8) << name;
        const Integrand plane = integrand(name, 2);
        EXPECT_NEAR(plane.exact / adaptive_integral(plane, 2), 1, 2e-4) << name;
    }
}

// A curve of length L <= 4 crosses at most 2 L m cells, whose errors nearly cancel.
TEST(Integrands, OfIndicatorsHaveTheAreaThatCellsHave) {
    for (const char* name : {"disk-indicator", "half-plane-indicator", "soft-shadow"})
        for (int seed = 1; seed <= 20; ++seed) {
            const Integrand one = integrand(fmt::format("{}:seed={}", name, seed), 2);
            EXPECT_NEAR(one.exact, midpoint_mean(one, 500), 1e-3) << name << ' ' << seed;
            EXPECT_GT(one.exact, 0);
            EXPECT_LT(one.exact, 1);
        }
}

// Inclusion and exclusion over the corners, in long double; coefficients are computed from values
// of the function: f(e_i) = (1 + a_i)^-(d + 1).
TEST(Integrands, CornerPeakAgreesWithInclusionAndExclusion) {
    for (std::size_t d = 1; d <= 6; ++d) {
        const Integrand one = integrand("genz-corner-peak:seed=9", d);
        std::vector<long double> a;
        long double factor = 1;
        for (std::size_t i = 0; i < d; ++i) {
            std::vector<double> corner(d);
            corner[i] = 1;
            a.push_back(std::pow(static_cast<long double>(one.value(corner)),
                                 -1.0L / static_cast<long double>(d + 1)) -
                        1);
            factor *= a.back() * static_cast<long double>(i + 1);
        }
        long double sum = 0;
        for (unsigned set = 0; set < 1U << d; ++set) {
            long double s = 1;
            for (std::size_t i = 0; i < d; ++i)
                if (set >> i & 1) s += a[i];
            sum += (std::popcount(set) % 2 ? -1 : 1) / s;
        }
        EXPECT_NEAR(one.exact / static_cast<double>(sum / factor), 1, 1e-11) << d;
    }
}

// With all a_i = s / d nearly equal and large d, the sum tends to s / 2.
TEST(Integrands, CornerPeakIsFiniteInAnyDimension) {
    for (const char* hard : {"0.001", "1.85", "100"}) {
        const auto name = fmt::format("genz-corner-peak:difficulty={}", hard);
        for (const std::size_t d : {1, 2, 20, 100}) {
            const double exact = integrand(name, d).exact;
            EXPECT_TRUE(exact > 0 && exact < 1) << hard << ' ' << d << ' ' << exact;
        }
    }
    EXPECT_NEAR(integrand("genz-corner-peak:difficulty=1e-9", 50).exact, 1, 1e-7);
}

TEST(Integrands, BeyondFloat64AreRefused) {
    // Values and integrals would be 0, and an estimate of 0 would seem to be exact.
    const auto refusal = [](const char* name, std::size_t d) {
        return error_of([&] { integrand(name, d); });
    };
    EXPECT_EQ(
        refusal("genz-product-peak:difficulty=1", 100),
        "usage: --integrand: genz-product-peak: its integral in dimension 100 is too small for "
        "float64");
    EXPECT_EQ(
        refusal("genz-discontinuous:difficulty=10000", 5),
        "usage: --integrand: genz-discontinuous: its integral in dimension 5 is too large for "
        "float64");
    for (const char* name : {"genz-corner-peak:difficulty=10000", "smooth-gaussian:width=1e-3"})
        EXPECT_NE(refusal(name, 200).find("too small for float64"), std::string::npos) << name;
    EXPECT_NE(refusal("genz-oscillatory:difficulty=1e-323", 2).find("outside"), std::string::npos);
}

TEST(Integrands, OwenHasMeanZeroAndVarianceOneInItsOrderAlone) {
    const auto second_moment = [](const Integrand& one) {
        return composite([&](double x) {
            return composite([&](double y) { return std::pow(one.value(std::array{x, y}), 2); });
        });
    };
    for (const std::string name : {"owen", "owen:order=1", "owen:order=9"}) {
        const Integrand one = integrand(name, 2);
        EXPECT_EQ(one.exact, 0);
        EXPECT_NEAR(smooth_integral(one, 2), 0, 1e-14) << name;
        EXPECT_NEAR(second_moment(one), 1, 1e-13) << name;
    }
    // sqrt(12)^2 (1/4) = 3 in the corner; 0 on the middle lines.
    EXPECT_NEAR(integrand("owen", 2).value(std::array{1.0, 1.0}), 3, 1e-15);
    EXPECT_EQ(integrand("owen", 2).value(std::array{0.5, 0.9}), 0);
    EXPECT_NEAR(integrand("owen:order=1", 3).value(std::array{1.0, 1.0, 1.0}), 3, 1e-15);
}

TEST(Integrands, SkyIntegratesOverTheHemisphere) {
    const Integrand sky = integrand("sky-radiance", 3);
    const double turn = 2 * std::numbers::pi;
    const double sum = composite([&](double z) { return sky.value(std::array{0.0, 0.0, z}); });
    EXPECT_NEAR(sky.exact, turn * sum, 1e-14);
    EXPECT_NEAR(sky.exact, 7 * std::numbers::pi / 9, 1e-15);
    EXPECT_EQ(sky.value(std::array{0.0, 0.0, 1.0}), 1);
}

TEST(Integrands, DependOnTheirSeeds) {
    for (const IntegrandKind& kind : integrand_kinds()) {
        const auto& options = kind.options.options();
        if (std::ranges::find(options, "seed", &Option::name) == options.end()) continue;
        const auto exact = [&](int seed) {
            return integrand(fmt::format("{}:seed={}", kind.name, seed), 2).exact;
        };
        EXPECT_EQ(exact(3), exact(3)) << kind.name;
        EXPECT_NE(exact(3), exact(4)) << kind.name;
    }
}

// Half-planes have all directions, so each of two corners is in many without the other.
TEST(Integrands, HalfPlanesLieInAllDirections) {
    std::map<std::pair<double, double>, int> seen;
    for (int seed = 1; seed <= 800; ++seed) {
        const Integrand half = integrand(fmt::format("half-plane-indicator:seed={}", seed), 2);
        ++seen[{half.value(std::array{0.0, 1.0}), half.value(std::array{1.0, 0.0})}];
        ++seen[{2 + half.value(std::array{0.0, 0.0}), 2 + half.value(std::array{1.0, 1.0})}];
    }
    EXPECT_EQ(seen.size(), 8U);
    for (const auto& [corners, times] : seen) EXPECT_GT(times, 40) << corners.first;
}

TEST(Integrands, AreDescribed) {
    for (const IntegrandKind& kind : integrand_kinds()) {
        EXPECT_FALSE(kind.summary.empty()) << kind.name;
        for (const Option& option : kind.options.options())
            EXPECT_FALSE(option.help.empty()) << kind.name << ' ' << option.name;
    }
}

TEST(Integrands, AreFoundByTheirNames) {
    EXPECT_EQ(error_of([] { integrand_kind("genz-gausian"); }),
              "usage: 'genz-gausian' is not an integrand | did you mean "
              "'genz-gaussian'?");
}

}  // namespace

}  // namespace stipple::testing::integrand_test
