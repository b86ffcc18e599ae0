// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/text.hpp"
#include "math/integrands/integrands.hpp"
#include "pipeline/chain.hpp"
#include "support/warping.hpp"

namespace stipple::testing::integration_test {
namespace {

/// The unit square with density p(x) = 1/2 + x, and its uniform coordinate.
class Ramp : public Domain {
  public:
    std::string spec() const override { return "ramp"; }
    std::size_t dimension() const override { return 2; }
    double measure() const override { return 1; }
    bool contains(std::span<const double>) const override { return true; }
    Box bounding_box() const override { return {{0, 0}, {1, 1}}; }
    double density(std::span<const double> x) const override { return 0.5 + x[0]; }
    void to_cube(std::span<const double> x, std::span<double> cube) const override {
        cube[0] = (x[0] + x[0] * x[0]) / 2;
        cube[1] = x[1];
    }
    std::vector<std::string> cube_axes() const override { return {"u", "v"}; }
};

/// Claims a density with an error of 2 %.
class WrongRamp : public Ramp {
    double density(std::span<const double> x) const override { return 1.02 * (0.5 + x[0]); }
};

PointSet on_ramp(PointSet points, DomainPtr domain = std::make_shared<Ramp>()) {
    for (std::size_t i = 0; i < points.count(); ++i)
        points[i][0] = (std::sqrt(1 + 8 * points[i][0]) - 1) / 2;
    points.domain = std::move(domain);
    return points;
}

/// Directions about y with density cos theta / pi.
PointSet cosine_directions(const PointSet& square) {
    PointSet points(square.count(), 3);
    for (std::size_t i = 0; i < square.count(); ++i) {
        const double turn = 2 * std::numbers::pi * square[i][1];
        const double r = std::sqrt(square[i][0]);
        points[i][0] = r * std::cos(turn);
        points[i][1] = std::sqrt(1 - square[i][0]);
        points[i][2] = r * std::sin(turn);
    }
    points.domain = parse_domain("hemisphere:method=cosine,axis=[0,2,0]", 3);
    return points;
}

PointSet random_points(std::size_t n, std::size_t d, std::uint64_t seed = 1) {
    return make("random", points(n, d), {}, {.seed = seed});
}

Report integrate(const PointSet& points, const std::string& integrands, const Settings& more = {}) {
    Settings settings{{"integrand", integrands}};
    settings.insert(settings.end(), more.begin(), more.end());
    return analyze("integration", points, settings);
}

std::string refusal(const PointSet& points, const std::string& integrands,
                    const Settings& more = {}) {
    return error_of([&] { integrate(points, integrands, more); });
}

/// Mean of several sets, computed from reports like the command line does.
Report combined(const std::vector<Report>& sets) {
    const Analyzer& unit = find_analyzer("integration");
    Report mean = sets.front();
    unit.combine(mean, sets, unit.options.defaults());
    return mean;
}

double error(const PointSet& points, const std::string& integrand) {
    return integrate(points, integrand).number(integrand + ".error");
}

/// Root mean square error of a randomized generator over seeds.
double rms_error(const std::string& generator, const Settings& settings, std::size_t n,
                 const std::string& integrand) {
    double sum = 0;
    constexpr int sets = 10;
    for (std::uint64_t seed = 1; seed <= sets; ++seed)
        sum +=
            std::pow(error(make(generator, points(n, 3), settings, {.seed = seed}), integrand), 2);
    return std::sqrt(sum / sets);
}

TEST(Integration, MeansOfAFewPointsByHand) {
    const PointSet two = points_of({{0.25, 0.5}, {1, 0.5}});
    const Report found = integrate(two, "sobol-g:a=[0,1]");
    // (1 * 1/2 + 2 * 1/2) / 2
    EXPECT_EQ(found.number("sobol-g.estimate"), 0.75);
    EXPECT_EQ(found.number("sobol-g.exact"), 1);
    EXPECT_EQ(found.number("sobol-g.error"), -0.25);
    EXPECT_EQ(found.find("sobol-g.standard_error"), nullptr);
    const Report one = integrate(points_of({{0.75}}), "sobol-g,measure");
    EXPECT_EQ(one.number("sobol-g.estimate"), 1);
    EXPECT_EQ(one.number("measure.estimate"), 1);
}

TEST(Integration, StandardErrorOfOneSetIsForIndependentPointsOnly) {
    PointSet three = points_of({{0.25}, {0.5}, {1}});  // sobol-g is 1, 0, 2
    three.provenance.independent = true;
    const Report known = integrate(three, "sobol-g");
    EXPECT_DOUBLE_EQ(known.number("sobol-g.standard_error"), std::sqrt(1.0 / 3));
    three.provenance.independent = false;
    EXPECT_EQ(integrate(three, "sobol-g").find("sobol-g.standard_error"), nullptr);
    PointSet one = points_of({{0.25}});
    one.provenance.independent = true;
    EXPECT_EQ(integrate(one, "sobol-g").find("sobol-g.standard_error"), nullptr);
}

TEST(Integration, SpreadOfSeveralSetsByHand) {
    std::vector<Report> sets;  // estimates 1, 0, 2: standard error 1 / sqrt(3)
    for (const double x : {0.25, 0.5, 1.0}) sets.push_back(integrate(points_of({{x}}), "sobol-g"));
    const Report mean = combined(sets);
    EXPECT_DOUBLE_EQ(mean.number("sobol-g.standard_error"), std::sqrt(1.0 / 3));
    // Student's t with 2 degrees of freedom, 97.5 %: 4.302653.
    EXPECT_NEAR(mean.number("sobol-g.interval_high"), 1 + 4.302653 * std::sqrt(1.0 / 3), 1e-6);
    EXPECT_NEAR(mean.number("sobol-g.interval_low"), 1 - 4.302653 * std::sqrt(1.0 / 3), 1e-6);
    EXPECT_DOUBLE_EQ(mean.number("sobol-g.rms_error"), std::sqrt(2.0 / 3));
    EXPECT_EQ(combined({sets[0]}).find("sobol-g.standard_error"), nullptr);
}

// 200 intervals of 95 %: 10 misses are expected; outside [1, 27] with probability below 5e-5. The
// same intervals around a value two standard errors away must miss far more often.
TEST(Integration, IntervalsOfScrambledSetsHoldTheIntegral) {
    int misses = 0;
    int wrong = 0;
    for (std::uint64_t group = 0; group < 200; ++group) {
        std::vector<Report> sets;
        for (std::uint64_t set = 0; set < 8; ++set)
            sets.push_back(integrate(
                make("sobol", points(64, 2), {{"scramble", "owen"}}, {.seed = 8 * group + set}),
                "genz-gaussian"));
        const Report mean = combined(sets);
        const auto outside = [&](double x) {
            return x < mean.number("genz-gaussian.interval_low") ||
                   x > mean.number("genz-gaussian.interval_high");
        };
        const double exact = mean.number("genz-gaussian.exact");
        misses += outside(exact);
        wrong += outside(exact + 2 * mean.number("genz-gaussian.standard_error"));
    }
    EXPECT_GE(misses, 1);
    EXPECT_LE(misses, 27);
    EXPECT_GT(wrong, 40);
}

// The mean error of random points falls by 8 from 64 to 4096 points; that of scrambled nets, for
// smooth functions, by about 64^(3/2) = 512.
TEST(Integration, ErrorsFallFasterForNetsThanForRandomPoints) {
    const std::string smooth = "genz-gaussian";
    const Settings owen{{"scramble", "owen"}};
    const double random =
        rms_error("random", {}, 64, smooth) / rms_error("random", {}, 4096, smooth);
    const double net =
        rms_error("sobol", owen, 64, smooth) / rms_error("sobol", owen, 4096, smooth);
    EXPECT_GT(random, 3);
    EXPECT_LT(random, 20);
    EXPECT_GT(net, 60);
    EXPECT_LT(rms_error("sobol", owen, 4096, smooth), rms_error("random", {}, 4096, smooth) / 10);
}

// Each estimate is within 5 standard errors: false alarm below 20 x 6e-7.
TEST(Integration, OfAllIntegrandsIsUnbiasedInAnyDimension) {
    for (const std::size_t d : {1, 2, 3, 8, 30}) {
        PointSet set = random_points(20'000, d, 7);
        set.provenance.independent = true;
        const Report all = analyze("integration", set);
        EXPECT_GE(all.entries().size(), 7U);
        for (const auto& [name, value, unit] : all.entries()) {
            const auto& one = std::get<Report>(value);
            EXPECT_LE(std::abs(one.number("error")), 5 * one.number("standard_error"))
                << name << " in " << d;
        }
    }
}

TEST(Integration, OnABoxIsThatOfTheCubeTimesTheVolume) {
    PointSet cube = random_points(1000, 2);
    PointSet box = cube;
    for (std::size_t i = 0; i < box.count(); ++i) box[i][1] = 8 * box[i][1] - 4;
    box.domain = parse_domain("box:bounds=[0..1,-4..4]", 2);
    for (const std::string name : {"genz-oscillatory", "zone-plate", "measure"}) {
        const Report small = integrate(cube, name);
        const Report large = integrate(box, name);
        for (const char* key : {".estimate", ".exact"})
            EXPECT_NEAR(large.number(name + key), 8 * small.number(name + key), 1e-12) << name;
    }
    box.domain = parse_domain("disk:radius=9", 2);
    EXPECT_NEAR(integrate(box, "measure").number("measure.estimate"), 81 * std::numbers::pi, 1e-12);
}

// Within 5 standard errors, estimated from one sample: false alarm 6e-7 each.
TEST(Integration, WithADensityIsUnbiasedAndAWrongDensityIsSeen) {
    for (const std::string name : {"smooth-gaussian", "genz-corner-peak", "measure"}) {
        const auto off = [&](DomainPtr domain) {
            PointSet set = on_ramp(random_points(200'000, 2, 3), std::move(domain));
            set.provenance.independent = true;
            const Report found = integrate(set, name);
            return std::abs(found.number(name + ".error")) / found.number(name + ".standard_error");
        };
        EXPECT_LT(off(std::make_shared<Ramp>()), 5) << name;
        EXPECT_GT(off(std::make_shared<WrongRamp>()), 5) << name;
    }
}

// With the domain's density, each of these has an error of at least one half.
TEST(Integration, TakesTheDensityOfBiasedWarps) {
    for (const auto& [warp, f, exact] :
         {std::tuple{"disk:method=naive", "x*x", std::numbers::pi / 4},
          {"disk:method=naive,radius=2,center=[1,0]", "x", 4 * std::numbers::pi},
          {"sphere:method=naive-lat-long", "z*z", 4 * std::numbers::pi / 3},
          {"circle:method=square-normalize", "abs(x*y)", 2.0},
          {"mixture:components=[disk:method=naive|disk:radius=2]", "1", 4 * std::numbers::pi}}) {
        PointSet set = warped(*mapping(warp), random_points(100'000, 2, 7));
        set.provenance.independent = true;
        set.provenance.warps = {warp};
        const Report found = analyze("integration", set, {{"expression", f}, {"compare", "true"}});
        EXPECT_EQ(found.text("density"), "warps");
        const double error = found.number("expression.standard_error");
        EXPECT_NEAR(found.number("expression.estimate"), exact, 5 * error + 1e-12) << warp;
        EXPECT_LT(error, 0.02 * exact) << warp;
        EXPECT_NEAR(found.number("compare.expression.uniform_estimate"), exact, 5 * error + 1e-12);
    }
}

// Factors of a product are matched with the order of the warps that made them.
TEST(Integration, TakesTheDensityOfTheFactorThatIsBiased) {
    const Spec naive = parse_spec("disk@3,4:method=naive");
    const Spec right = parse_spec("disk@1,2");
    const WarpChain chain(std::vector{right, naive}, 4);
    PointSet set = image_of(random_points(100'000, 4, 9), chain, {});
    set.provenance.independent = true;
    set.provenance.warps = chain.record().specs;
    const Report found = analyze("integration", set, {{"expression", "x1*x1*x3*x3 + x4"}});
    const double exact = std::numbers::pi * std::numbers::pi / 16;
    EXPECT_NEAR(found.number("expression.estimate"), exact,
                5 * found.number("expression.standard_error"));
}

// Uses 1 / p of the given densities: x uniform, pdf 2, represents half of them.
TEST(Integration, TakesDensitiesThatAreGiven) {
    PointSet set(std::vector{0.1, 0.2, 0.6, 0.8}, 1);
    set.densities = {2, 2, 0.5, 0.5};
    const Report found = analyze("integration", set, {{"expression", "x"}});
    EXPECT_DOUBLE_EQ(found.number("expression.estimate"), (0.05 + 0.1 + 1.2 + 1.6) / 4);
}

TEST(Integration, ComparesWithUniformPointsOfTheSameCube) {
    const PointSet cube = random_points(100'000, 2, 5);
    const Report found = integrate(on_ramp(cube), "measure,smooth-gaussian", {{"compare", "true"}});
    // The variance of 1 / p is int 1 / p - 1 = log 3 - 1.
    EXPECT_NEAR(found.number("compare.measure.importance_variance"), std::log(3) - 1, 2e-3);
    EXPECT_EQ(found.number("compare.measure.uniform_estimate"), 1);
    EXPECT_EQ(found.number("compare.measure.uniform_variance"), 0);
    EXPECT_EQ(found.number("compare.measure.variance_ratio"), 0);
    EXPECT_NEAR(found.number("compare.smooth-gaussian.uniform_estimate"),
                integrate(cube, "smooth-gaussian").number("smooth-gaussian.estimate"), 1e-12);
    EXPECT_EQ(found.number("compare.smooth-gaussian.importance_estimate"),
              found.number("smooth-gaussian.estimate"));
}

// With cos theta = c: f / p = pi (1 + 2 c) / 3 has variance 4 pi^2 / 9 / 18; with uniform points 2
// pi f has 4 pi^2 (1/3 + 1 + 4/5) / 9 - (7 pi / 9)^2.
TEST(Integration, CosineSamplingOfASkyReducesTheVarianceByWhatTheoryTells) {
    const PointSet directions = cosine_directions(random_points(100'000, 2, 6));
    const Report found = integrate(directions, "sky-radiance", {{"compare", "true"}});
    const double pi = std::numbers::pi;
    const double cosine = 4 * pi * pi / 9 / 18;
    const double uniform = 4 * pi * pi * (1 / 3.0 + 1 + 0.8) / 9 - std::pow(7 * pi / 9, 2);
    const auto number = [&](const std::string& key) {
        return found.number("compare.sky-radiance." + key);
    };
    EXPECT_NEAR(number("importance_variance") / cosine, 1, 0.02);
    EXPECT_NEAR(number("uniform_variance") / uniform, 1, 0.02);
    EXPECT_NEAR(number("variance_ratio") / (uniform / cosine), 1, 0.04);
    EXPECT_NEAR(number("uniform_estimate"), 7 * pi / 9, 5 * std::sqrt(uniform / 1e5));
    // int y z^2 is pi / 4 around y, for any choice of the two other axes.
    const Report turned =
        analyze("integration", directions, {{"expression", "y*(z-2*x)^2"}, {"compare", "true"}});
    EXPECT_NEAR(turned.number("compare.expression.uniform_estimate"), 5 * pi / 4, 0.1);
    EXPECT_NEAR(turned.number("expression.estimate"), 5 * pi / 4, 0.1);
    EXPECT_NEAR(found.number("sky-radiance.error"), 0, 5 * std::sqrt(cosine / 1e5));
}

// f = 1 + z by a lobe around x: with uniform points 4 pi f has variance 16 pi^2 / 3.
TEST(Integration, ComparesALobeWithTheWholeSphere) {
    const PointSet cube = random_points(100'000, 2, 7);
    for (const char* spec :
         {"henyey-greenstein:g=0.3,axis=[1,0,0]", "von-mises-fisher:kappa=0.5,axis=[0,1,1]"}) {
        const Report found = analyze("integration", warped(*mapping(spec), cube),
                                     {{"expression", "1+z"}, {"compare", "true"}});
        const auto number = [&](const std::string& key) {
            return found.number("compare.expression." + key);
        };
        const double pi = std::numbers::pi;
        const double variance = 16 * pi * pi / 3;
        EXPECT_NEAR(number("uniform_variance") / variance, 1, 0.02) << spec;
        EXPECT_NEAR(number("uniform_estimate"), 4 * pi, 5 * std::sqrt(variance / 1e5)) << spec;
        EXPECT_NEAR(number("importance_estimate"), 4 * pi, 0.2) << spec;
    }
}

TEST(Integration, ComparesUniformPointsWithThemselves) {
    const PointSet cube = random_points(1000, 2, 8);
    for (const char* spec : {"disk:radius=2", "sphere", "triangle", "spherical-triangle"}) {
        const Report found = analyze("integration", warped(*mapping(spec), cube),
                                     {{"expression", "x^2"}, {"compare", "true"}});
        EXPECT_NEAR(found.number("compare.expression.uniform_estimate"),
                    found.number("expression.estimate"), 1e-12)
            << spec;
        EXPECT_NEAR(found.number("compare.expression.variance_ratio"), 1, 1e-9) << spec;
    }
}

// One set has no standard error between sets, but an error.
TEST(Integration, OneSetsAverageHasItsErrorAsRootMeanSquare) {
    const Analyzer& unit = find_analyzer("integration");
    Report one = integrate(random_points(64, 2), "owen");
    const Report sets[] = {one};
    unit.combine(one, sets, unit.options.defaults());
    EXPECT_EQ(one.number("owen.rms_error"), std::abs(one.number("owen.error")));
    EXPECT_EQ(one.find("owen.interval_low"), nullptr);
}

TEST(Integration, NamesASecondIntegrandOfAKind) {
    const Report found = integrate(random_points(64, 2),
                                   "genz-gaussian:seed=3,owen,genz-gaussian:seed=4,"
                                   "difficulty=2.5,genz-gaussian:seed=3");
    const auto exact = [&](const std::string& name) { return found.number(name + ".exact"); };
    EXPECT_NE(exact("genz-gaussian"), exact("genz-gaussian-2"));
    EXPECT_EQ(exact("genz-gaussian"), exact("genz-gaussian-3"));
    EXPECT_EQ(found.entries().size(), 4U);
}

TEST(Integration, RefusesWhatItCannotIntegrateInOneLine) {
    const PointSet square = random_points(64, 2);
    PointSet disk = square;
    disk.domain = parse_domain("disk", 2);
    EXPECT_EQ(refusal(square, "zone-plat"),
              "usage: --integrand: 'zone-plat' is not an integrand | did you mean 'zone-plate'?");
    EXPECT_EQ(refusal(square, "owen,"), "usage: --integrand, column 6: a name is expected");
    EXPECT_EQ(refusal(square, "owen:order=0"),
              "usage: --integrand: owen: --order: 0 is outside [1, 10]");
    EXPECT_EQ(refusal(square, "owen:ordr=1"),
              "usage: --integrand: owen: unknown option 'ordr' | did you mean 'order'?");
    EXPECT_EQ(refusal(square, "sobol-g:a=[1"),
              "usage: --integrand, column 11: this '[' has no ']'");
    EXPECT_EQ(refusal(square, "owen@2"),
              "usage: --integrand: 'owen@2': coordinates after @ are for warps only");
    EXPECT_EQ(refusal(square, "sobol-g:a=-1"), "usage: --integrand: sobol-g: --a: -1 is below 0");
    EXPECT_EQ(refusal(square, "sobol-g:a=[0,1,2]"),
              "usage: --integrand: sobol-g: --a: 3 numbers for 2 coordinates; give one for all, or "
              "one for each");
    EXPECT_EQ(refusal(square, "sky-radiance"),
              "input: --integrand: sky-radiance requires points of a hemisphere; the domain is "
              "unit-cube");
    EXPECT_EQ(refusal(disk, "genz-gaussian"),
              "input: --integrand: genz-gaussian requires points of a box; the domain is disk");
    EXPECT_EQ(refusal(random_points(64, 3), "zone-plate"),
              "input: --integrand: zone-plate requires points of dimension 2; these have 3");
    PointSet decay = random_points(64, 1);
    decay.domain = parse_domain("normal", 1);
    EXPECT_EQ(refusal(decay, "measure"),
              "input: --integrand: measure requires points of a domain of finite measure; the "
              "domain is normal");
    EXPECT_EQ(
        error_of([&] {
            analyze("integration", decay, {{"expression", "x"}, {"compare", "true"}});
        }),
        "input: --compare: there are no uniform points on normal, because its measure is infinite");
    PointSet tiny = points_of({{1e-201, 2e-201}});
    tiny.domain = parse_domain("box:bounds=[0..1e-200,0..1e-200]", 2);
    EXPECT_EQ(
        refusal(tiny, "measure"),
        "input: the measure of box:bounds=[0..1e-200,0..1e-200] is too small for float64; use "
        "other units");
    EXPECT_EQ(refusal(points_of({{0.5}}), "owen", {{"compare", "true"}}),
              "input: --compare: needs at least 2 points, not 1");
}

/// A density that is 0 at the points.
class Empty final : public Ramp {
    double density(std::span<const double> x) const override { return x[0] > 0.5 ? 2 : 0; }
};

TEST(Integration, RefusesPointsWhereTheDensityIsZero) {
    PointSet set = points_of({{0.75, 0}, {0.25, 0}, {0.125, 0}});
    set.domain = std::make_shared<Empty>();
    EXPECT_EQ(refusal(set, "measure"),
              "input: at point 1 the integrand measure is 1 and the density of ramp is 0");
}

// An expected value: the points are those of the distribution, so nothing is divided by its density.
TEST(Integration, MeanIsTheExpectedValueOfTheDistribution) {
    const PointSet set = make("sobol", points(4096, 2), {{"scramble", "owen"}});
    const auto found = [&](const char* warp, const char* f) {
        PointSet image = warped(*mapping(warp), set);
        image.provenance.warps = {warp};
        return analyze("integration", image,
                       {{"expression", f}, {"mean", "true"}, {"exact", "13"}});
    };
    const auto mean = [&](const char* warp, const char* f) {
        return found(warp, f).number("expression.estimate");
    };
    const char* normal = "normal:mean=[3,3],deviation=[2,2]";
    EXPECT_NEAR(mean(normal, "x^2"), 9 + 4, 0.02);
    EXPECT_NEAR(mean(normal, "x*y"), 9, 0.02);
    EXPECT_EQ(mean(normal, "1"), 1);
    EXPECT_EQ(found(normal, "x^2").number("expression.error"), mean(normal, "x^2") - 13);
    EXPECT_NEAR(mean("disk:radius=2", "x^2+y^2"), 2, 1e-3);
    // Points of a biased warp have another density; their mean is that of the values all the same.
    EXPECT_NEAR(mean("disk:radius=2,method=naive", "x^2+y^2"), 4. / 3, 1e-3);
}

// int_0^1 int_0^1 x y^2 = 1/6; also on the ramp with the density of its points.
TEST(Integration, TakesFormulas) {
    const PointSet set = make("sobol", points(1024, 2));
    const auto of = [&](const PointSet& points, const Settings& settings) {
        return analyze("integration", points, settings);
    };
    const Report bare = of(set, {{"expression", "x * y^2"}});
    EXPECT_NEAR(bare.number("expression.estimate"), 1 / 6.0, 2e-3);
    EXPECT_EQ(bare.keys(), std::vector<std::string>{"expression.estimate"});
    const Report both =
        of(on_ramp(set), {{"expression", "x1*x2^2"}, {"exact", "0.5"}, {"integrand", "owen"}});
    EXPECT_NEAR(both.number("expression.estimate"), 1 / 6.0, 2e-3);
    EXPECT_NEAR(both.number("expression.error"), 1 / 6.0 - 0.5, 2e-3);
    EXPECT_NE(both.find("owen.error"), nullptr);
    const Report mean = combined({bare, bare});
    EXPECT_EQ(mean.number("expression.standard_error"), 0);
    EXPECT_EQ(mean.find("expression.rms_error"), nullptr);
    EXPECT_EQ(error_of([&] {
                  of(set, {{"exact", "1"}});
              }),
              "usage: --exact: requires --expression, which is not given");
    for (const Settings& other : {Settings{}, Settings{{"expression", "x"}, {"compare", "true"}},
                                  Settings{{"expression", "x"}, {"integrand", "owen"}}}) {
        Settings settings = other;
        settings.emplace_back("mean", "true");
        EXPECT_EQ(error_of([&] { of(set, settings); }),
                  "usage: --mean: is for --expression, without --integrand and --compare, which "
                  "integrate");
    }
    EXPECT_TRUE(error_of([&] {
                    of(set, {{"expression", "x+"}});
                }).starts_with("usage: --expression: 'x+': the formula ends at column 3, where "));
    EXPECT_TRUE(error_of([&] {
                    of(set, {{"expression", "1/(x-x)"}});
                }).starts_with("input: at point 0 the integrand expression is inf"));
}

TEST(Integration, HelpNamesAllIntegrands) {
    const auto& help = find_analyzer("integration").options.options().front().help;
    for (const IntegrandKind& kind : integrand_kinds())
        EXPECT_NE(help.find(kind.name), std::string::npos) << kind.name;
}

}  // namespace

// Density 1/3 on [0, 1], 0 on [1, 2], 2/3 on [2, 3]: no point samples f in between, so the estimate
// and the exact value both exclude that part.
TEST(Integration, GapsInADensityAreLeftOutOfTheExactValue) {
    PointSet line = make("sobol", points(1024, 1));
    const Spec spec = parse_spec("table-1d:rows=[0,1 1,0 2,2 3,2],interpolation=constant");
    const Warp& table = find_warp(spec.name);
    const auto warp = table.make(spec.values(table.options), 1, {});
    line = warped(*warp, line);
    const Report found = integrate(line, "measure,owen:order=1");
    EXPECT_EQ(found.number("measure.exact"), 2);
    EXPECT_NEAR(found.number("measure.error"), 0, 2e-3);
    EXPECT_EQ(std::get<bool>(*found.find("support.whole")), false);
    EXPECT_NEAR(found.number("owen.error"), 0, 1e-2);
    EXPECT_LT(found.number("owen.exact_error"), 1e-9);
    const Report beside =
        analyze("integration", line, {{"expression", "1"}, {"exact", "2"}, {"compare", "true"}});
    EXPECT_NEAR(beside.number("compare.expression.uniform_variance"), 0, 0.02);

    const PointSet square = make("sobol", points(1024, 2));
    PointSet right = square;
    for (std::size_t i = 0; i < right.count(); ++i)
        right[i][0] = 0.5 + 0.5 * std::sqrt(right[i][0] + 1 / 2048.0);
    right.domain = parse_domain("expression-2d:density=[max(0,x-0.5)]", 2);
    const Report half = integrate(right, "measure,smooth-gaussian");
    EXPECT_NEAR(half.number("measure.exact"), 0.5, 1e-6);
    EXPECT_NEAR(half.number("smooth-gaussian.error"), 0, 0.02);  // 1 / p is large near x = 1/2
}

// Both components fill the unit square, so the mixture does, too.
TEST(Integration, MixturesOnABoxAreIntegratedAndCompared) {
    PointSet set = make("sobol", points(4096, 2));
    const auto warp =
        mapping("mixture:components=[power:exponent=1|power:exponent=0],weights=[0.5,0.5]");
    set = warped(*warp, set);
    EXPECT_EQ(set.domain->measure(), 1);
    const Report found =
        integrate(set, "measure", {{"expression", "x*y"}, {"exact", "0.25"}, {"compare", "true"}});
    EXPECT_NEAR(found.number("measure.error"), 0, 5e-3);
    EXPECT_NEAR(found.number("expression.error"), 0, 2e-3);
    EXPECT_NEAR(found.number("compare.measure.uniform_variance"), 0, 2e-2);
    // Variance of x y at uniform points: 1/9 - 1/16.
    EXPECT_NEAR(found.number("compare.expression.uniform_variance"), 1 / 9.0 - 1 / 16.0, 2e-3);
    EXPECT_LT(found.number("compare.expression.importance_variance"), 1 / 9.0 - 1 / 16.0);
}

// Two caps cover a part of the sphere of unknown area: an estimate without an exact value.
TEST(Integration, WhatAMixtureCoversIsEstimatedWithoutAnExactValue) {
    const auto warp = mapping(
        "mixture:components=[cone:half-angle=60|cone:half-angle=60,"
        "axis=[0,0,-1]],weights=[0.25,0.75]");
    const PointSet caps = warped(*warp, make("sobol", points(1024, 2)));
    const Report found = integrate(caps, "measure");
    EXPECT_NEAR(found.number("measure.estimate"), 2 * std::numbers::pi, 0.01);
    EXPECT_EQ(found.find("measure.exact"), nullptr);
    EXPECT_NE(found.find("support.meaning"), nullptr);
    // Two quarters of the sphere: area 2 pi, with known densities 1 / (4 pi) and 3 / (4 pi).
    const Report both = integrate(caps, "measure", {{"compare", "true"}});
    EXPECT_NEAR(both.number("support.measure"), 2 * std::numbers::pi, 0.01);
    EXPECT_EQ(both.find("support.measure_error"), nullptr) << "of no independent points";
    EXPECT_NE(both.find("support.measure_is_estimate"), nullptr);
    EXPECT_EQ(both.number("compare.measure.uniform_variance"), 0);
    const double quarter = std::numbers::pi * std::numbers::pi;
    EXPECT_NEAR(both.number("compare.measure.importance_variance"),
                quarter * (16 * 0.25 + 16 / 9.0 * 0.75) - 4 * quarter, 0.2);
}

TEST(Integration, ErrorsOfTinyIntegrandsAreThoseOfOthers) {
    const PointSet set = make("random", points(100, 2));
    const auto error = [&](const char* formula) {
        return measure("integration", "expression.standard_error", set, {{"expression", formula}});
    };
    EXPECT_NEAR(error("1e-200*x") / error("x"), 1e-200, 1e-214);
    EXPECT_NEAR(error("1e200*x") / error("x") / 1e200, 1, 1e-14);
    EXPECT_TRUE(error_of([&] {
                    analyze("integration", set, {{"expression", "1e-200*x"}, {"compare", "true"}});
                }).starts_with("input: --compare: float64 cannot hold the square of"));
    EXPECT_EQ(error_of([&] {
                  analyze("integration", set, {{"expression", "1.7e308"}});
              }),
              "input: the sum of expression over the points is too large for float64");
}

// Narrow peaks between the nodes of quadrature: in one dimension they are found, in two `exact` is
// left out; it was 0.
TEST(Integration, ExactOverASupportSeesNarrowPeaks) {
    const Spec spec = parse_spec("table-1d:rows=[0,1 0.3,1 0.5,0 0.6,0 0.7,1 1,1]");
    const Settings peak = {{"integrand", "genz-gaussian:difficulty=10000"}};
    const Warp& table = find_warp(spec.name);
    const auto analyzed = [&](std::size_t d, const Settings& settings) {
        const auto warp = table.make(spec.values(table.options), d, {});
        return analyze("integration", warped(*warp, make("sobol", points(1 << 16, d))), settings);
    };
    const Report line = analyzed(1, peak);
    ASSERT_NE(line.find("genz-gaussian.exact"), nullptr);
    EXPECT_NEAR(line.number("genz-gaussian.exact"), line.number("genz-gaussian.estimate"), 1e-7);
    EXPECT_EQ(analyzed(2, peak).find("genz-gaussian.exact"), nullptr);
    EXPECT_NE(analyzed(2, {{"integrand", "genz-gaussian"}}).find("genz-gaussian.exact"), nullptr);
}

}  // namespace stipple::testing::integration_test
