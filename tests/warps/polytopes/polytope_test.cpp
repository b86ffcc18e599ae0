// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/text.hpp"
#include "support/warping.hpp"

namespace stipple::testing::polytope_test {
namespace {

using ::testing::ElementsAre;

std::unique_ptr<Mapping> polytope_of(std::size_t d, const std::string& constraints,
                                     const std::string& bounds = "0..1") {
    const Spec spec =
        parse_spec("polytope:constraints=[" + constraints + "],bounds=[" + bounds + "]");
    const Warp& warp = find_warp(spec.name);
    return warp.make(spec.values(warp.options), d, {});
}

double volume_of(std::size_t d, const std::string& constraints,
                 const std::string& bounds = "0..1") {
    return polytope_of(d, constraints, bounds)->domain()->measure();
}

/// "x1+x2+x3", with a minus for each bit of `minus` that is set.
std::string sum_of(std::size_t d, unsigned minus = 0) {
    std::string sum;
    for (std::size_t k = 0; k < d; ++k)
        sum += fmt::format("{}x{}", (minus >> k & 1U) ? "-" : "+", k + 1);
    return sum;
}

/// 2^d inequalities, whose facets meet in vertices of many more than d facets.
std::string cross_polytope(std::size_t d) {
    std::string all;
    for (unsigned minus = 0; minus < (1U << d); ++minus) all += sum_of(d, minus) + "<=1;";
    return all;
}

std::string differences(std::size_t d, const std::string& most) {
    std::string all;
    for (std::size_t i = 1; i <= d; ++i)
        for (std::size_t j = 1; j <= d; ++j)
            if (i != j) all += fmt::format("x{}-x{}<={};", i, j, most);
    return all;
}

double factorial(std::size_t d) { return d == 0 ? 1 : static_cast<double>(d) * factorial(d - 1); }

/// Random inequalities that leave a part around the centre.
std::string some_cuts(std::size_t d, std::size_t count, std::uint64_t seed) {
    const Rng rng(seed);
    std::string all;
    std::uint64_t draw = 0;
    for (std::size_t i = 0; i < count; ++i) {
        std::string sum;
        double middle = 0;
        for (std::size_t k = 1; k <= d; ++k) {
            const double a = std::round(8 * rng.uniform(draw++) - 4);
            sum += fmt::format("{:+}*x{}", a, k);
            middle += a / 2;
        }
        all += fmt::format("{}<={};", sum, middle + 0.1 + rng.uniform(draw++));
    }
    return all;
}

}  // namespace

// The triangle with corner (0, 0), whose weight is 1 - sqrt(xi_2); xi_1 is the position between (0,
// 1) and (1, 0).
TEST(Polytope, NumbersByHand) {
    EXPECT_THAT(image_of(*polytope_of(2, "x+y<=1"), {0.5, 0.25}), ElementsAre(0.25, 0.25));
    EXPECT_THAT(image_of(*polytope_of(2, "x+y<=1"), {0.25, 1}), ElementsAre(0.25, 0.75));
    EXPECT_THAT(image_of(*polytope_of(1, "x<=0.5"), {0.25}), ElementsAre(0.125));
    EXPECT_THAT(image_of(*polytope_of(1, "2*x>1, x<7/8"), {0.5}), ElementsAre(0.6875));
    EXPECT_THAT(image_of(*polytope_of(1, "x>-1", "-3..5"), {0.5}), ElementsAre(2));
    EXPECT_THAT(inverse_of(*polytope_of(2, "x+y<=1"), {0.25, 0.25}),
                ElementsAre(::testing::DoubleEq(0.5), ::testing::DoubleEq(0.25)));
}

TEST(Polytope, VolumesInClosedForm) {
    EXPECT_DOUBLE_EQ(volume_of(3, "x+y+z<=3/2"), 0.5);
    EXPECT_DOUBLE_EQ(volume_of(2, "x + 2*y <= 1; x - y >= -0.5, y > 0.125"), 0.140625);
    for (std::size_t d = 1; d <= 7; ++d) {
        const auto n = static_cast<double>(d);
        EXPECT_NEAR(volume_of(d, cross_polytope(d), "-1..1") * factorial(d) / std::pow(2, n), 1,
                    1e-13)
            << d;
        std::string rising = "x1>=0;";
        for (std::size_t k = 1; k < d; ++k) rising += fmt::format("x{}<=x{};", k, k + 1);
        EXPECT_NEAR(volume_of(d, rising) * factorial(d), 1, 1e-13) << d;
        if (d == 1) continue;
        // All coordinates are within 1/4 of each other: d h^(d-1) - (d-1) h^d.
        EXPECT_NEAR(volume_of(d, differences(d, "1/4")),
                    n * std::pow(4, 1 - n) - (n - 1) * std::pow(4, -n), 1e-15)
            << d;
    }
    // Irwin and Hall: sum of (-1)^k C(d, k) (s - k)^d / d!, s = 5/2.
    for (std::size_t d = 3; d <= 12; ++d) {
        const auto n = static_cast<double>(d);
        const double sum =
            std::pow(2.5, n) - n * std::pow(1.5, n) + n * (n - 1) / 2 * std::pow(0.5, n);
        EXPECT_NEAR(volume_of(d, sum_of(d) + "<=5/2") / sum * factorial(d), 1, 1e-12) << d;
    }
}

TEST(Polytope, BothWays) {
    const std::pair<std::size_t, std::string> cases[] = {
        {1, "x>0.3"},
        {2, "x+y<=1"},
        {2, some_cuts(2, 6, 1)},
        {2, cross_polytope(2)},
        {3, "x+y+z<=3/2"},
        {3, "x<=y;z<0.7"},
        {3, some_cuts(3, 8, 2)},
        {3, "x+y<=1;x+z<=1;y+z<=1"},  // six planes meet in (1/2, 1/2, 1/2) and others
        {3, differences(3, "0.5")},
    };
    for (const auto& [d, constraints] : cases) {
        SCOPED_TRACE(constraints);
        const auto map = polytope_of(d, constraints);
        expect_round_trip(*map, 1e-12);
        expect_density_is_one_over_stretch(*map);
    }
}

TEST(Polytope, BothWaysInManyDimensions) {
    const std::pair<std::size_t, std::string> cases[] = {
        {5, some_cuts(5, 6, 3)},
        {6, cross_polytope(6)},
        {7, differences(7, "0.5")},
        {10, sum_of(10) + "<=5"},
        {30, "x1+x2+x3<1;x7<x9;x9<x11;x30>0.5"},
    };
    for (const auto& [d, constraints] : cases) {
        const auto map = polytope_of(d, constraints);
        const PointSet cube = make("random", points(2000, d));
        const PointSet image = warped(*map, cube);
        std::vector<double> back(cube.flat().size());
        map->inverse(image.flat(), back);
        for (std::size_t i = 0; i < back.size(); ++i)
            ASSERT_NEAR(back[i], cube.flat()[i], 1e-11) << constraints;
    }
}

TEST(Polytope, CoordinatesThatNoInequalityJoinsAreIndependent) {
    const auto map = polytope_of(5, "x1+x4<=1;x2>1/2", "0..1,0..1,-1..3,0..1,2..4");
    const auto p = image_of(*map, {0.5, 0.25, 0.375, 0.25, 0.5});
    EXPECT_THAT(p, ElementsAre(0.25, 0.625, 0.5, 0.25, 3));
    EXPECT_DOUBLE_EQ(map->domain()->measure(), 0.5 * 0.5 * 4 * 2);
    const Moments m = *map->domain()->moments();
    EXPECT_THAT(m.mean, ElementsAre(::testing::DoubleEq(1 / 3.0), 0.75, 1,
                                    ::testing::DoubleEq(1 / 3.0), 3));
    EXPECT_DOUBLE_EQ(m.covariance[2 * 5 + 2], 16 / 12.0);
    EXPECT_EQ(m.covariance[0 * 5 + 1], 0);
    EXPECT_DOUBLE_EQ(m.covariance[0 * 5 + 3], -1 / 36.0);
    EXPECT_THAT(map->domain()->cube_axes(),
                ElementsAre("fraction of the volume before", "fraction of the volume before", "x3",
                            "position in the simplex, x4", "x5"));
}

// Moments of the simplex by its own formulas, in each dimension; and of a polytope that is
// symmetric about its centre.
TEST(Polytope, MomentsInClosedForm) {
    for (std::size_t d = 1; d <= 8; ++d) {
        const Warp& simplex = find_warp("simplex");
        const Moments right = *simplex.make(simplex.options.defaults(), d, {})->domain()->moments();
        const Moments m = *polytope_of(d, sum_of(d) + "<=1")->domain()->moments();
        for (std::size_t k = 0; k < d; ++k) {
            EXPECT_NEAR(m.mean[k], right.mean[k], 1e-15);
            EXPECT_NEAR(m.skewness[k], right.skewness[k], 1e-12);
        }
        for (std::size_t k = 0; k < d * d; ++k)
            EXPECT_NEAR(m.covariance[k], right.covariance[k], 1e-15);
    }
    for (std::size_t d = 2; d <= 6; ++d) {
        const Moments m = *polytope_of(d, cross_polytope(d), "-1..1")->domain()->moments();
        const auto n = static_cast<double>(d);
        for (std::size_t k = 0; k < d; ++k) {
            EXPECT_NEAR(m.mean[k], 0, 1e-15);
            EXPECT_NEAR(m.skewness[k], 0, 1e-13);
            EXPECT_NEAR(m.covariance[k * d + k], 2 / ((n + 1) * (n + 2)), 1e-14);
        }
    }
}

/// Random points of the box that satisfy the inequalities. @param share receives their fraction
PointSet by_rejection(const Mapping& map, std::size_t d, std::uint64_t count, double& share) {
    const PointSet all = make("random", points(count, d), {}, {.seed = 77});
    std::vector<double> kept;
    for (std::size_t i = 0; i < count; ++i)
        if (map.domain()->contains(all[i])) kept.insert(kept.end(), all[i].begin(), all[i].end());
    PointSet out(std::move(kept), d);
    share = static_cast<double>(out.count()) / static_cast<double>(count);
    out.domain = map.domain();
    return out;
}

// An independent method, which only shares the membership test: volumes, means, covariances and
// cells. False alarm: 5 standard deviations are 6e-7 for each of 38; and 3 times 1e-4.
TEST(Polytope, RejectionGivesTheSame) {
    constexpr std::uint64_t n = 400'000;
    for (const std::size_t d : {2U, 3U, 5U}) {
        const auto map = polytope_of(d, some_cuts(d, d + 3, 10 + d));
        double share = 0;
        PointSet kept = by_rejection(*map, d, n, share);
        const double volume = map->domain()->measure();
        EXPECT_NEAR(share, volume, 5 * std::sqrt(volume * (1 - volume) / n));
        const Moments m = *map->domain()->moments();
        const auto count = static_cast<double>(kept.count());
        for (std::size_t k = 0; k < d; ++k)
            for (std::size_t j = 0; j <= k; ++j) {
                double mean = 0, square = 0, first = 0;
                for (std::size_t i = 0; i < kept.count(); ++i) {
                    const double both = (kept[i][k] - m.mean[k]) * (kept[i][j] - m.mean[j]);
                    mean += both / count;
                    square += both * both / count;
                    first += (kept[i][k] - m.mean[k]) / count;
                }
                const double spread = std::sqrt((square - mean * mean) / count);
                EXPECT_NEAR(mean, m.covariance[k * d + j], 5 * spread);
                EXPECT_NEAR(first, 0, 5 * std::sqrt(m.covariance[k * d + k] / count));
            }
        EXPECT_GT(measure("chi-square", "p_value", kept), 1e-4);
        for (std::size_t i = 0; i < kept.count(); ++i)
            for (std::size_t k = 0; k < d; ++k) kept[i][k] += 0.1 * (m.mean[k] - kept[i][k]);
        EXPECT_LT(measure("chi-square", "p_value", kept), 1e-4) << "blind";
        EXPECT_GT(p_of_random(*map, 100'000), 1e-4);
    }
}

TEST(Polytope, WhatCutsNothingOffChangesNothing) {
    const std::vector<double> xi{0.3, 0.6};
    const auto plain = image_of(*polytope_of(2, "x+y<=1.5"), xi);
    for (const char* more : {"x<=1", "x<2", "x+y<=2", "2*x+2*y<=3", "x>=0", "x+y<=1.5", "1<2",
                             "x-y<=1", "x+y<=1.5+1e-13"})
        EXPECT_EQ(image_of(*polytope_of(2, fmt::format("x+y<=1.5;{}", more)), xi), plain) << more;
    EXPECT_EQ(volume_of(2, "x<2"), 1);
    EXPECT_EQ(volume_of(2, "0.1*x+0.2*y<=0.3"), 1);  // touches in (1, 1), apart from rounding
    EXPECT_EQ(volume_of(3, "x+y<=2;y+z<=2;x+y+z<=3;x-y-z<=1"), 1);
}

// Each inequality twice, with other last digits: the same volume apart from these digits, or an
// error. Inequalities that differ only by rounding count as one.
TEST(Polytope, InequalitiesThatNearlyCoincideGiveNoWrongVolume) {
    const Rng rng(5);
    std::uint64_t draw = 0;
    for (const double off : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-16})
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            const std::string cuts = some_cuts(3, 5, seed);
            std::string both = cuts;
            for (const auto cut : split(cuts, ';')) {
                if (cut.empty()) continue;
                both += fmt::format("{}{:+.17f}*x1;", cut, off * (rng.uniform(draw) - 0.5));
                both += fmt::format("{}{:+.17f};", cut, off * (rng.uniform(draw + 1) - 0.5));
                draw += 2;
            }
            const double right = volume_of(3, cuts);
            const std::string error =
                error_of([&] { EXPECT_NEAR(volume_of(3, both), right, off + 1e-14) << both; });
            if (off > 1e-8 || off < 1e-14)
                EXPECT_EQ(error, "") << both;
            else
                EXPECT_TRUE(error.empty() || error.starts_with("limit: ")) << error;
        }
}

TEST(Polytope, SizesMayDifferByAnyFactor) {
    EXPECT_DOUBLE_EQ(volume_of(2, "x+y<=1e-12"), 0.5e-24);
    EXPECT_DOUBLE_EQ(volume_of(2, "1e9*x+y<=1"), 0.5e-9);
    EXPECT_DOUBLE_EQ(volume_of(2, "1e200*x+1e200*y<=1e200"), 0.5);
    EXPECT_NEAR(volume_of(2, "x+y<=1e6+1e6+1", "1e6..1e6+1"), 0.5, 1e-9);
    EXPECT_NEAR(volume_of(2, "x-y<=1e-9;y-x<=1e-9") / 2e-9, 1, 1e-6);
    const auto map = polytope_of(3, "x+1e-6*y+1e6*z<=1e-8");
    expect_round_trip(*map, 1e-12);
    EXPECT_GT(p_of_random(*map, 50'000), 1e-4);
}

TEST(Polytope, IsClosedAndHasATightBox) {
    const DomainPtr domain = polytope_of(2, "x + y <= 1.5; x - y >= -0.25")->domain();
    EXPECT_THAT(domain->bounding_box().low, ElementsAre(0, 0));
    EXPECT_THAT(domain->bounding_box().high, ElementsAre(1, ::testing::DoubleEq(0.875)));
    EXPECT_TRUE(domain->contains(std::vector{0.5, 0.75}));
    EXPECT_TRUE(domain->contains(std::vector{0.75, 0.75}));
    EXPECT_FALSE(domain->contains(std::vector{0.75, 0.750001}));
    EXPECT_FALSE(domain->contains(std::vector{-1e-300, 0.0}));
    EXPECT_FALSE(domain->contains(std::vector{NAN, 0.0}));
    EXPECT_EQ(domain->spec(), "polytope:constraints=[x+y<=1.5,x-y>=-0.25]");
    EXPECT_EQ(mapping(domain->spec())->domain()->measure(), domain->measure());
    EXPECT_EQ(domain->density(std::vector{0.5, 0.5}), 1 / domain->measure());
    EXPECT_EQ(domain->density(std::vector{0.0, 0.5}), 0);
}

TEST(Polytope, SaysWhatIsWrong) {
    const auto says = [](std::size_t d, const std::string& constraints) {
        return error_of([&] { polytope_of(d, constraints); });
    };
    EXPECT_EQ(says(2, "x+y>=3"), "usage: --constraints: no point in the ranges satisfies 'x+y>=3'");
    EXPECT_EQ(says(2, "x>0.6;x<0.5;y<0.5"),
              "usage: --constraints: no point in the ranges satisfies 'x<0.5' and the inequalities "
              "before it");
    EXPECT_EQ(says(2, "x+y<=1;1>2"), "usage: --constraints: no point satisfies '1>2'");
    const std::pair<const char*, const char*> flat[] = {
        {"x+y<=1;x+y>=1", "x+y>=1"},       {"x<=0", "x<=0"},
        {"x+y>=2;x>0.5", "x+y>=2"},        {"0.1*x+0.2*y<=0.3;x+2*y>=3", "x+2*y>=3"},
        {"x<=1e-12;x>=1e-12", "x>=1e-12"}, {"x+y<=1;x+y>=1+1e-13", "x+y>=1+1e-13"},
    };
    for (const auto& [constraints, last] : flat)
        EXPECT_EQ(says(2, constraints),
                  fmt::format("usage: --constraints: the polytope is flat: '{}' can only hold as "
                              "an equality",
                              last));
    EXPECT_EQ(says(2, "x*y<1"),
              "usage: --constraints: 'x*y<1' is not a linear inequality; expected one such as "
              "x1 + 2*x2 <= 1");
    EXPECT_EQ(
        says(2, " ;"),
        "usage: --constraints: none given; expected linear inequalities, such as 'x + y <= 1'");
    EXPECT_THAT(says(2, "x+q<1"), ::testing::StartsWith("usage: --constraints: 'x+q<1', column 3"));
    EXPECT_EQ(says(13, sum_of(13) + "<=1"),
              "limit: --constraints: inequalities couple 13 coordinates; at most 12 are possible");
    EXPECT_EQ(error_of([] { polytope_of(2, "x<y", "0..1,0..1,0..1"); }),
              "usage: --bounds: 3 ranges for 2 coordinates; expected one for all, or one for each");
    EXPECT_THAT(says(12, differences(12, "0.9")), ::testing::StartsWith("limit: --constraints: "));
}

}  // namespace stipple::testing::polytope_test
