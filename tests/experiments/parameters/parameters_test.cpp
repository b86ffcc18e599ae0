// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/parameters/parameter_space.hpp"
#include "pipeline/units.hpp"
#include "support/temporary_file.hpp"
#include "support/warping.hpp"

namespace stipple::testing::parameters_test {
namespace {

using parameters::parse_parameters;
using ::testing::HasSubstr;

std::unique_ptr<Mapping> parameters_of(const std::string& json) {
    const Spec spec = parse_spec("parameters:json=[" + json + "]");
    return find_warp(spec.name).make(spec.values(find_warp(spec.name).options), 0, {});
}

/// Three parameters joined by a copula.
std::string joined(const std::string& correlation) {
    return R"({"parameters":[{"name":"a","range":[0,1]},{"name":"b","range":[0,1]},)"
           R"({"name":"c","range":[0,1]}],"correlation":)" +
           correlation + "}";
}

const std::vector<std::string> copulas = {
    R"({"spearman":[["a","b",0.7],["b","c",-0.4]]})",
    R"({"copula":"student","degrees":3.5,"kendall":[["a","b",0.5],["a","c",0.2]]})"};

TEST(Parameters, CopulasHaveTheDensityOfTheirMap) {
    for (const std::string& correlation : copulas) {
        const auto map = parameters_of(joined(correlation));
        expect_density_is_one_over_stretch(*map, 2e-5);
        PointSet some(200, 3);
        Rng(3).fill(0, some.flat());
        PointSet back(200, 3);
        map->inverse(warped(*map, some).flat(), back.flat());
        for (std::size_t i = 0; i < 600; ++i) EXPECT_NEAR(back.flat()[i], some.flat()[i], 1e-9);
    }
}

std::vector<double> ranks(const PointSet& points, std::size_t k) {
    std::vector<std::size_t> order(points.count());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, {}, [&](std::size_t i) { return points[i][k]; });
    std::vector<double> rank(order.size());
    for (std::size_t r = 0; r < order.size(); ++r) rank[order[r]] = static_cast<double>(r);
    return rank;
}

double linear(const std::vector<double>& x, const std::vector<double>& y) {
    double mx = 0, my = 0, xx = 0, yy = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mx += x[i] / static_cast<double>(x.size());
        my += y[i] / static_cast<double>(x.size());
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - mx) * (x[i] - mx);
        yy += (y[i] - my) * (y[i] - my);
        xy += (x[i] - mx) * (y[i] - my);
    }
    return xy / std::sqrt(xx * yy);
}

double kendall(const PointSet& points, std::size_t a, std::size_t b) {
    double sum = 0;
    for (std::size_t i = 0; i < points.count(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            sum += (points[i][a] - points[j][a]) * (points[i][b] - points[j][b]) > 0 ? 1 : -1;
    const auto n = static_cast<double>(points.count());
    return sum / (n * (n - 1) / 2);
}

// 2^14 scrambled points; correlations of such sets are within a third of these bounds.
TEST(Parameters, HaveTheCorrelationsThatAreAskedFor) {
    const PointSet cube = make("sobol", points(1 << 14, 3), {{"scramble", std::string("owen")}});
    const PointSet gauss = warped(*parameters_of(joined(copulas[0])), cube);
    EXPECT_NEAR(linear(ranks(gauss, 0), ranks(gauss, 1)), 0.7, 2e-3);
    EXPECT_NEAR(linear(ranks(gauss, 1), ranks(gauss, 2)), -0.4, 2e-3);
    EXPECT_NEAR(linear(ranks(gauss, 0), ranks(gauss, 2)), 0, 2e-3);

    const PointSet few = make("sobol", points(1 << 11, 3), {{"scramble", std::string("owen")}});
    const PointSet student = warped(*parameters_of(joined(copulas[1])), few);
    EXPECT_NEAR(kendall(student, 0, 1), 0.5, 5e-3);
    EXPECT_NEAR(kendall(student, 0, 2), 0.2, 5e-3);
    EXPECT_NEAR(kendall(student, 1, 2), 0, 5e-3);

    // Linear correlation of distributions far from normal: a skewed one and a coin.
    const PointSet skew = warped(
        *parameters_of(R"({"parameters":[{"name":"a","distribution":"lognormal","sigma":0.8},)"
                       R"({"name":"b","range":[2,7]},{"name":"c","levels":[0,1]}],)"
                       R"("correlation":{"pearson":[["a","b",0.6],["b","c",0.5]]}})"),
        make("sobol", points(1 << 18, 3), {{"scramble", std::string("owen")}}));
    const auto column = [&](std::size_t k) {
        std::vector<double> x;
        for (std::size_t i = 0; i < skew.count(); ++i) x.push_back(skew[i][k]);
        return x;
    };
    EXPECT_NEAR(linear(column(0), column(1)), 0.6, 1e-3);
    EXPECT_NEAR(linear(column(1), column(2)), 0.5, 1e-3);
}

// The matrix of Higham 2002, section 4, and its nearest correlation matrix.
TEST(Parameters, OfferTheNearestCorrelations) {
    const auto near = parameters::nearest_correlation({1, 1, 0, 1, 1, 1, 0, 1, 1}, 3);
    EXPECT_NEAR(near[1], 0.7607, 5e-5);
    EXPECT_NEAR(near[2], 0.1573, 5e-5);
    EXPECT_NEAR(near[5], 0.7607, 5e-5);
    EXPECT_TRUE(parameters::is_correlation(near, 3));
    try {
        parameters_of(joined(R"({"kendall":[["a","b",0.9],["b","c",0.9],["a","c",-0.9]]})"));
        FAIL();
    } catch (const Error& e) {
        EXPECT_THAT(e.what(),
                    HasSubstr("$.correlation: these correlations are not possible together"));
        EXPECT_THAT(e.hint(), HasSubstr("a and b 0."));
    }
}

// The rank correlations offered by the error are accepted.
TEST(Parameters, OfferRankCorrelationsForThose) {
    try {
        parameters_of(joined(R"({"reordering":"iman-conover",)"
                             R"("spearman":[["a","b",0.9],["b","c",0.9],["a","c",-0.9]]})"));
        FAIL();
    } catch (const Error& e) {
        EXPECT_THAT(e.hint(), HasSubstr("as \"spearman\": a and b 0.482583, a and c -0.482583, "
                                        "b and c 0.482583"));
    }
    parameters_of(joined(R"({"reordering":"iman-conover","spearman":)"
                         R"([["a","b",0.482583],["b","c",0.482583],["a","c",-0.482583]]})"));
}

TEST(Parameters, AreInversesOfTheirDistributions) {
    const auto map = parameters_of(
        R"({"parameters":[{"name":"a","range":[1,100],"scale":"log"},)"
        R"({"name":"b","distribution":"normal","mean":5,"truncate":[4,9]},)"
        R"({"name":"c","integers":[3,5]},{"name":"d","levels":["x","y z"],"probabilities":[3,1]},)"
        R"({"name":"f","levels":[7,2.5],"probabilities":[0.25,0.75]}]})");
    const auto low = image_of(*map, {0.5, 0, 0, 0.74, 0.7});
    EXPECT_NEAR(low[0], 10, 1e-14);
    EXPECT_EQ(low[1], 4);
    EXPECT_EQ(low[2], 3);
    EXPECT_EQ(low[3], 0);
    EXPECT_EQ(low[4], 2.5);
    const auto high = image_of(*map, {0.75, 0.5, 0.99, 0.76, 0.8});
    EXPECT_NEAR(high[0], std::pow(10, 1.5), 1e-13);
    EXPECT_EQ(high[2], 5);
    EXPECT_EQ(high[3], 1);
    EXPECT_EQ(high[4], 7);
    EXPECT_THAT(map->domain()->names(), ::testing::ElementsAre("a", "b", "c", "d", "f"));
    ASSERT_EQ(map->domain()->levels().size(), 1U);
    EXPECT_THAT(map->domain()->levels()[0].second, ::testing::ElementsAre("x", "y z"));
    EXPECT_GT(p_of_random(*map, 20000), 1e-4);
}

TEST(Parameters, DependOnThoseBefore) {
    const auto map = parameters_of(R"({"parameters":[{"name":"length","range":[2,4]},)"
                                   R"({"name":"height","range":["length/2","length"]},)"
                                   R"({"name":"many","distribution":"binomial","trials":10,)"
                                   R"("probability":"height/10"}]})");
    const auto point = image_of(*map, {0.5, 0.5, 0.5});
    EXPECT_EQ(point[0], 3);
    EXPECT_EQ(point[1], 2.25);
    EXPECT_EQ(point[2], 2);  // the median of 10 trials of 0.225
    EXPECT_EQ(inverse_of(*map, point)[1], 0.5);
    EXPECT_FALSE(map->domain()->contains(std::vector<double>{3, 1.4, 2}));
    EXPECT_NEAR(map->density(point), 0.5 / 1.5 * 45 * std::pow(0.225, 2) * std::pow(0.775, 8),
                1e-12);
}

TEST(Parameters, HoldTheirConstraints) {
    const auto map =
        parameters_of(R"({"parameters":[{"name":"a","range":[0,2]},)"
                      R"({"name":"b","range":[0,2]}],"constraints":["(a+b)^2<4","a^3>0.125"]})");
    EXPECT_TRUE(map->drops());
    const PointSet all = make("halton", points(4096, 2));
    const PointSet kept = warped(*map, all);
    EXPECT_NEAR(static_cast<double>(kept.count()), 4096 * 1.125 / 4, 20);
    for (std::size_t i = 0; i < kept.count(); ++i)
        EXPECT_TRUE(kept[i][0] + kept[i][1] < 2 && kept[i][0] > 0.5);
    EXPECT_THROW(static_cast<void>(map->density(kept[0])), Error);
}

// Each number in proportion to its frequency, or interpolated linearly, like the warp empirical.
TEST(Parameters, FollowNumbersThatWereMeasured) {
    const auto map = parameters_of(R"({"parameters":[{"name":"a","values":[3,-0.0,2,2]},)"
                                   R"({"name":"b","values":[3,1,7],"interpolation":"linear"},)"
                                   R"({"name":"c","values":[5]},)"
                                   R"({"name":"d","values":[0.5,0.25],"interpolation":"steps"},)"
                                   R"({"name":"f","range":[0,"1+a"]}]})");
    EXPECT_EQ(image_of(*map, {0.2, 0.25, 0.1, 0.49, 0.5}),
              (std::vector<double>{0, 2, 5, 0.25, 0.5}));
    EXPECT_EQ(image_of(*map, {0.74, 0.75, 0.9, 0.5, 0.5}),
              (std::vector<double>{2, 5, 5, 0.5, 1.5}));
    EXPECT_EQ(inverse_of(*map, {2, 5, 5, 0.5, 1.5}),
              (std::vector<double>{0.5, 0.75, 0.5, 0.75, 0.5}));
    EXPECT_FALSE(map->domain()->contains(std::vector<double>{1, 5, 5, 0.5, 1}));
    EXPECT_FALSE(std::signbit(image_of(*map, {0, 0, 0, 0, 0})[0]));
}

// The column is copied into the spec stored with the points, which opens no file.
TEST(Parameters, ReadColumnsOfFilesOnce) {
    const TemporaryFile table("day,speed\n1,3.25\n2,1e-3\n", ".csv");
    const auto file = [&](const std::string& more) {
        return R"({"parameters":[{"name":"wind","file":")" + table.path() + "\"" + more + "}]}";
    };
    const TemporaryFile named(file(R"(,"column":"speed","interpolation":"linear")"));
    EXPECT_EQ(read_parameters(named.path())->spec(),
              R"(parameters:json=[{"parameters":[{"name":"wind",)"
              R"("interpolation":"linear","values":[3.25,0.001]}]}])");
    const TemporaryFile counted(file(R"(,"column":2)"));
    EXPECT_THAT(read_parameters(counted.path())->spec(), HasSubstr(R"("values":[3.25,0.001])"));
    EXPECT_THROW(static_cast<void>(parse_parameters(named.bytes(), "t.json")), Error);
    EXPECT_THROW(static_cast<void>(mapping("parameters:file=" + named.path())), Error);

    std::string many = "x\n";
    for (int i = 0; i < 100'000; ++i) many += "1\n";
    const TemporaryFile most(many);
    const TemporaryFile over(many + "1\n");
    for (const auto* numbers : {&most, &over}) {
        const TemporaryFile of(R"({"parameters":[{"name":"x","file":")" + numbers->path() +
                               "\"}]}");
        try {
            EXPECT_EQ(read_parameters(of.path())->dimension(), 1U);
            EXPECT_EQ(numbers, &most);
        } catch (const Error& e) {
            EXPECT_EQ(numbers, &over);
            EXPECT_THAT(std::string(e.what()),
                        HasSubstr("$.parameters[0].file: 100001 numbers; expected 1 to 100000"));
        }
    }
}

// The triangle with corners (1/2, 0), (2, 0), (1/2, 3/2), and unconstrained parameters.
TEST(Parameters, LinearConstraintsDropNothing) {
    const auto map =
        parameters_of(R"({"parameters":[{"name":"a","range":[0,2]},{"name":"n","integers":[1,4]},)"
                      R"({"name":"b","range":[0,20]},{"name":"h","distribution":"normal"}],)"
                      R"("constraints":["a+b<2","2*a>1 && b < 10"]})");
    EXPECT_FALSE(map->drops());
    const PointSet all = make("sobol", points(4096, 4));
    const PointSet image = warped(*map, all);
    ASSERT_EQ(image.count(), 4096U);
    for (std::size_t i = 0; i < image.count(); ++i)
        ASSERT_TRUE(image[i][0] + image[i][2] < 2 && image[i][0] > 0.5) << i;
    const DomainPtr domain = map->domain();
    EXPECT_DOUBLE_EQ(map->density(std::vector{1.0, 2.0, 0.5, 0.0}),
                     1 / 1.125 / 4 / std::sqrt(2 * std::acos(-1)));
    EXPECT_EQ(map->density(std::vector{1.0, 2.0, 1.5, 0.0}), 0);
    EXPECT_EQ(domain->bounding_box().low[0], 0.5);
    EXPECT_DOUBLE_EQ(domain->bounding_box().high[2], 1.5);
    const Moments m = *domain->moments();
    EXPECT_DOUBLE_EQ(m.mean[0], 1);
    EXPECT_DOUBLE_EQ(m.mean[2], 0.5);
    EXPECT_DOUBLE_EQ(m.covariance[0 * 4 + 2], -0.0625);
    EXPECT_DOUBLE_EQ(m.covariance[1 * 4 + 1], 1.25);
    EXPECT_DOUBLE_EQ(m.covariance[3 * 4 + 3], 1);
    PointSet back(4096, 4);
    map->inverse(image.flat(), back.flat());
    for (std::size_t i = 64; i < 4096; ++i)
        for (const std::size_t k : {0U, 2U, 3U}) ASSERT_NEAR(back[i][k], all[i][k], 1e-12) << i;
    EXPECT_GT(p_of_random(*map, 50'000), 1e-4);
}

// A parameter that depends on earlier ones has its conditional distribution, as without
// constraints.
TEST(Parameters, LinearConstraintsBesideCopulasAndDependence) {
    const auto given =
        parameters_of(R"({"parameters":[{"name":"a","range":[0,1]},{"name":"b","range":[0,6]},)"
                      R"({"name":"c","range":["a","a+b+1"]}],"constraints":["a+b<1"]})");
    EXPECT_FALSE(given->drops());
    EXPECT_THAT(image_of(*given, {0.5, 0.25, 0.5}), ::testing::ElementsAre(0.25, 0.25, 0.875));
    expect_density_is_one_over_stretch(*given, 1e-5);

    const auto beside =
        parameters_of(R"({"parameters":[{"name":"a","range":[0,1]},{"name":"b","range":[0,6]},)"
                      R"({"name":"c","range":[0,1]},{"name":"d","range":[0,1]}],)"
                      R"("correlation":{"spearman":[["c","d",0.7]]},"constraints":["a+b<1"]})");
    EXPECT_FALSE(beside->drops());
    EXPECT_EQ(image_of(*beside, {0.5, 0.25, 0.5, 0.5})[0], 0.25);
    expect_density_is_one_over_stretch(*beside, 2e-5);
}

// Half of the square is feasible: points are rejected and keep their positions in the square, but
// their density is known.
TEST(Parameters, LinearConstraintsThatLeaveMuchRejectPoints) {
    const auto map = parameters_of(
        R"({"parameters":[{"name":"a","range":[0,2]},{"name":"b","range":[0,2]}],"constraints":["a+b<2"]})");
    EXPECT_TRUE(map->drops());
    EXPECT_EQ(image_of(*map, {0.25, 0.5}), (std::vector<double>{0.5, 1}));
    EXPECT_EQ(inverse_of(*map, {0.5, 1}), (std::vector<double>{0.25, 0.5}));
    EXPECT_DOUBLE_EQ(map->density(std::vector{0.5, 1.0}), 0.5);
    EXPECT_DOUBLE_EQ(map->domain()->measure(), 2);
    EXPECT_DOUBLE_EQ(map->domain()->moments()->mean[0], 2 / 3.0);
    const PointSet kept = warped(*map, make("random", points(50'000, 2)));
    EXPECT_GT(measure("chi-square", "p_value", kept), 1e-4);
    PointSet sloping = kept;
    for (std::size_t i = 0; i < sloping.count(); ++i) sloping[i][0] *= 0.97;
    EXPECT_LT(measure("chi-square", "p_value", sloping), 1e-4);
}

// Points from rejection follow the same distribution: false alarm 1e-4.
TEST(Parameters, BothWaysToHoldLinearConstraintsAreOneDistribution) {
    const std::string parameters =
        R"({"parameters":[{"name":"a","range":[0,2]},{"name":"b","range":[1,)";
    const std::string wide = parameters + R"(40]}],"constraints":)";
    const std::string near = parameters + R"(4]}],"constraints":)";
    const auto exact = parameters_of(wide + R"(["a+b<3.5","b-a<2"]})");
    const auto tried = parameters_of(near + R"(["(a+b)^3<42.875","(b-a)^3<8"]})");
    EXPECT_FALSE(exact->drops());
    ASSERT_TRUE(tried->drops());
    PointSet kept = warped(*tried, make("random", points(100'000, 2)));
    kept.domain = exact->domain();
    EXPECT_GT(measure("chi-square", "p_value", kept), 1e-4);
    // Both at once: linear constraints drop nothing, the other one does.
    const auto both = parameters_of(wide + R"(["a+b<3.5","(b-a)^3<8"]})");
    PointSet mixed = warped(*both, make("random", points(100'000, 2)));
    EXPECT_GT(mixed.count(), kept.count());
    mixed.domain = exact->domain();
    EXPECT_GT(measure("chi-square", "p_value", mixed), 1e-4);
}

TEST(Parameters, ConstraintsOnWhatIsNotUniformAreTried) {
    const char* others[] = {
        R"({"name":"b","range":[0.1,1],"scale":"log"}], "constraints":["a+b<1"]})",
        R"({"name":"b","distribution":"normal"}], "constraints":["a+b<1"]})",
        R"({"name":"b","integers":[0,1]}], "constraints":["a+b<1"]})",
        R"({"name":"b","levels":[0.1,0.7]}], "constraints":["a+b<1"]})",
        R"({"name":"b","range":[0,"a"]}], "constraints":["a+b<1"]})",
        R"({"name":"b","range":[0,1]}], "constraints":["a+b<1 || a > b"]})",
        R"({"name":"b","range":[0,1]}], "correlation":{"spearman":[["a","b",0.5]]},
            "constraints":["a+b<1"]})",
        R"({"name":"b","range":[0,1]}], "correlation":{"copula":"student","degrees":3},
            "constraints":["a+b<1"]})"};
    for (const char* other : others)
        EXPECT_TRUE(
            parameters_of(R"({"parameters":[{"name":"a","range":[0,1]},)" + std::string(other))
                ->drops())
            << other;
    const auto truncated =
        parameters_of(R"({"parameters":[{"name":"a","distribution":"uniform","low":0,"high":4,)"
                      R"("truncate":[1,2]},{"name":"b","range":[0,6]}],"constraints":["a+b<2"]})");
    EXPECT_FALSE(truncated->drops());
    EXPECT_DOUBLE_EQ(truncated->domain()->measure(), 0.5);
}

TEST(Parameters, FormulasNameParametersAndLevelsInQuotes) {
    const auto map =
        parameters_of(R"({"parameters":[{"name":"cross section","range":[0,4]},)"
                      R"({"name":"material","levels":["mild steel","oak"]},)"
                      R"({"name":"load","range":[0,"'cross section' + 1"]}],)"
                      R"("constraints":["material == \"mild steel\" || load < 'cross section'"]})");
    const PointSet image = warped(*map, make("sobol", points(1024, 3)));
    std::size_t steel = 0;
    for (std::size_t i = 0; i < image.count(); ++i) {
        EXPECT_TRUE(image[i][1] == 0 || image[i][2] < image[i][0]);
        EXPECT_LE(image[i][2], image[i][0] + 1);
        steel += image[i][1] == 0 ? 1 : 0;
    }
    EXPECT_EQ(steel, 512U);
    EXPECT_LT(image.count(), 1024U);
    EXPECT_EQ(parse_spec(map->domain()->spec()).name, "parameters");
}

// Each parameter is a uniform number plus the preceding one; with constraints on two of them. Work
// quadratic in their number would take minutes.
TEST(Parameters, ChainsOfFormulasTakeTimeInProportion) {
    constexpr int n = 5000;
    std::string json = R"({"parameters":[{"name":"x0","range":[0,1]})";
    for (int k = 1; k < n; ++k)
        json += fmt::format(R"(,{{"name":"x{0}","range":["x{1}","x{1}+1"]}})", k, k - 1);
    json += R"(],"constraints":["x0^2<2")";
    for (int k = 1; k < n; ++k) json += fmt::format(R"(,"x{}^2 >= x{}^2")", k, k - 1);
    const auto map = parameters_of(json + "]}");
    const auto image = image_of(*map, std::vector<double>(n, 0.5));
    for (int k = 0; k < n; ++k) ASSERT_EQ(image[static_cast<std::size_t>(k)], 0.5 * (k + 1));
}

struct Wrong {
    const char* json;
    const char* says;
};

TEST(Parameters, SayWhatIsWrongAndWhere) {
    const Wrong cases[] = {
        {"{", "t.json:1:2: not JSON"},
        {R"({"parameters":[{"name":"a","name":"b","range":[0,1]}]})",
         "t.json: $.parameters.name: the key occurs twice"},
        {"[]", "t.json: $: expected an object"},
        {R"({"parameter":[]})", "$: the key 'parameter' is not known"},
        {R"({"parameters":[]})", "$.parameters: expected a list"},
        {R"({"parameters":[{"name":"a"}]})", "$.parameters[0]: expected one of the keys"},
        {R"({"parameters":[{"name":"a","range":[0,1],"levels":[1]}]})", "several are given"},
        {R"({"parameters":[{"range":[0,1]}]})", "$.parameters[0]: the name is missing"},
        {R"({"parameters":[{"name":"a","range":[1,0]}]})",
         "$.parameters[0].range: low: 1 is not below high, 0"},
        {R"({"parameters":[{"name":"a","range":[1]}]})", "$.parameters[0].range: expected two"},
        {R"({"parameters":[{"name":"a","range":[0,1],"skale":"log"}]})", "'skale' is not known"},
        {R"({"parameters":[{"name":"a","range":[0,1],"scale":"ln"}]})",
         "$.parameters[0].scale: 'ln' is not log or linear"},
        {R"({"parameters":[{"name":"a","range":[-1,1],"scale":"log"}]})",
         "$.parameters[0].range: low: -1 is outside"},
        {R"({"parameters":[{"name":"a","range":[0,1]},{"name":"a","range":[0,1]}]})",
         "$.parameters[1].name: 'a' is given twice"},
        {R"({"parameters":[{"name":"a\u0007","range":[0,1]}]})", "cannot be a name"},
        {R"({"parameters":[{"name":"12","range":[0,1]}]})", "cannot be a name"},
        {R"({"parameters":[{"name":"NaN","range":[0,1]}]})", "'NaN' cannot be a name"},
        {R"({"parameters":[{"name":"infinity","range":[0,1]}]})", "cannot be a name"},
        {R"({"parameters":[{"name":"-1,5e3","range":[0,1]}]})", "cannot be a name"},
        {R"({"parameters":[{"name":"e","range":[0,1]}]})",
         "$.parameters[0].name: 'e' is a constant in formulas, which the name would hide"},
        {R"({"parameters":[{"name":"pi","range":[0,1]}]})", "'pi' is a constant in formulas"},
        {R"({"parameters":[{"name":"a","range":[0,1]}],"constraints":["0.2<a<0.5"]})",
         "$.constraints[0]: '0.2<a<0.5', column 6: '<': comparisons cannot be chained; write 0.2<a "
         "&& a <0.5"},
        {R"({"parameters":[{"name":"m","levels":["x","y"]}],"constraints":["m=='z'"]})",
         "$.constraints[0]: 'm=='z'', column 4: 'z': expected a level of m"},
        {R"({"parameters":[{"name":"a","distribution":"norml"}]})",
         "$.parameters[0].distribution: there is no distribution 'norml'"},
        {R"({"parameters":[{"name":"a","distribution":"normal","sd":1}]})", "'sd' is not known"},
        {R"({"parameters":[{"name":"a","distribution":"normal","mean":"b"}]})",
         "$.parameters[0].mean: 'b', column 1: 'b':"},
        {R"({"parameters":[{"name":"a","levels":["x","y"],"probabilities":[0.5,0.4]}]})",
         "$.parameters[0].probabilities: the sum is 0.9; expected 1"},
        {R"({"parameters":[{"name":"a","levels":["x","y"],"probabilities":[1e308,1e308]}]})",
         "$.parameters[0].probabilities: their sum exceeds float64"},
        {R"({"parameters":[{"name":"a","levels":["x","y"],"probabilities":[1]}]})",
         "1 probabilities for 2 levels"},
        {R"({"parameters":[{"name":"a","levels":["x","x"]}]})",
         R"($.parameters[0].levels[1]: "x" is given twice)"},
        {R"({"parameters":[{"name":"a","levels":[1,1.0]}]})",
         "$.parameters[0].levels[1]: 1 is given twice"},
        {R"({"parameters":[{"name":"a","levels":[1,2],"normalize":"yes"}]})",
         "$.parameters[0].normalize: expected true or false"},
        {R"({"parameters":[{"name":"a","integers":[0.5,3]}]})",
         "$.parameters[0].integers: low: 0.5 is not a whole number"},
        {R"({"parameters":[{"name":"a","range":[0,1]}],"constraints":["a<"]})",
         "$.constraints[0]: 'a<': the formula ends"},
        {R"({"parameters":[{"name":"a","range":[0,1]}],"constraints":["a>2"]})",
         "t.json: $.constraints: no point in the ranges satisfies 'a>2'"},
        {R"({"parameters":[{"name":"a","range":[0,1]}],"constraints":["a>0.5","a<0.5"]})",
         "t.json: $.constraints: the polytope is flat: 'a<0.5' can only hold as an equality"},
        {R"({"parameters":[{"name":"a","range":[0,1]}],"constraints":["b<1"]})",
         "$.constraints[0]: 'b<1', column 1: 'b':"},
        {R"({"parameters":[{"name":"a","range":[0,1]}],"correlation":{"spearman":[["a","b",1]]}})",
         "$.correlation.spearman[0][1]: there is no parameter 'b'"},
        {R"({"parameters":[{"name":"a","range":[0,1]}],"correlation":{"spearman":[["a","a",0]]}})",
         "both names are the same; expected two parameters"},
        {R"({"parameters":[{"name":"a","range":[0,1]},{"name":"b","levels":[0,1]}],)"
         R"("correlation":{"pearson":[["a","b",0.95]]}})",
         "0.95 is not attainable: these two parameters have correlations in [-0.86"},
        {R"({"parameters":[{"name":"a","range":[0,1]},{"name":"b","distribution":"normal",)"
         R"("mean":1e10,"deviation":2e-4}],"correlation":{"pearson":[["a","b",0.5]]}})",
         "or if its values are so close to each other that float64 rounds them"},
        {R"({"parameters":[{"name":"a","values":[]}]})", "$.parameters[0].values: expected a list"},
        {R"({"parameters":[{"name":"a","values":[1,"2"]}]})",
         "$.parameters[0].values[1]: '\"2\"' is not a number"},
        {R"({"parameters":[{"name":"a","values":[1,1],"interpolation":"linear"}]})",
         "$.parameters[0].values: 1 occurs twice; linear interpolation needs"},
        {R"({"parameters":[{"name":"a","values":[1],"interpolation":"linear"}]})",
         "$.parameters[0].values: only 1 number; linear interpolation needs at least 2"},
        {R"({"parameters":[{"name":"a","values":[1,2],"interpolation":"cubic"}]})",
         "$.parameters[0].interpolation: 'cubic' is not steps or linear"},
        {R"({"parameters":[{"name":"a","values":[-2e150]}]})",
         "$.parameters[0].values: -2e+150 is outside [-1e150, 1e150]"},
        {R"({"parameters":[{"name":"a","values":[1],"truncate":[0,1]}]})",
         "'truncate' is not known"},
        {R"({"parameters":[{"name":"a","file":"/dev/null"}]})",
         "$.parameters[0].file: only --parameters FILE reads columns of other files"},
        {R"({"parameters":[{"name":"a","values":[1,2]},{"name":"b","values":[3]}],)"
         R"("correlation":{"pearson":[["a","b",0.5]]}})",
         "a parameter whose variance is 0 or infinite has no linear correlation"},
        {R"({"parameters":[{"name":"a","range":[0,1]}],"correlation":{"reordering":"ranks"}})",
         "$.correlation.reordering: 'ranks' is not iman-conover"},
        {R"({"parameters":[{"name":"a","range":[0,1]}],)"
         R"("correlation":{"reordering":"iman-conover","copula":"gaussian"}})",
         "$.correlation.copula: belongs to copulas, but \"reordering\" is given"},
        {R"({"parameters":[{"name":"a","range":[0,1]},{"name":"b","range":[0,1]}],)"
         R"("correlation":{"reordering":"iman-conover","pearson":[["a","b",0.5]]}})",
         "$.correlation.pearson: not possible with a reordering, which gives rank correlations"},
    };
    for (const auto& [json, says] : cases) {
        try {
            static_cast<void>(parse_parameters(json, "t.json"));
            ADD_FAILURE() << json;
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::input) << json;
            EXPECT_THAT(std::string(e.what()), HasSubstr(says)) << json;
        }
    }
}

}  // namespace
}  // namespace stipple::testing::parameters_test
