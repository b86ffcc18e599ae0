// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "analyzers/uniformity/moment_sums.hpp"
#include "support/steps.hpp"
#include "support/warping.hpp"

namespace stipple::testing::moments_test {
namespace {

double at(const Report& report, const char* key, std::size_t i) { return report.curve(key)[i]; }

}  // namespace

TEST(Moments, SmallSetsByHand) {
    // x = 0, 0, 0.25, 0.75: mean 1/4, deviations -1/4 -1/4 0 1/2.
    const Report one = analyze("moments", PointSet(std::vector<double>{0, 0, 0.25, 0.75}, 1));
    EXPECT_DOUBLE_EQ(at(one, "mean", 0), 0.25);
    EXPECT_DOUBLE_EQ(at(one, "variance", 0), 0.125);
    const double m2 = 0.375 / 4, m3 = (0.125 - 2.0 / 64) / 4;
    EXPECT_DOUBLE_EQ(at(one, "skewness", 0), m3 / std::pow(m2, 1.5));
    EXPECT_DOUBLE_EQ(at(one, "standard_error.mean", 0), std::sqrt(0.125 / 4));
    EXPECT_DOUBLE_EQ(at(one, "exact.mean", 0), 0.5);
    EXPECT_DOUBLE_EQ(at(one, "exact.variance", 0), 1.0 / 12);

    const Report two = analyze("moments", points_of({{0, 0}, {1, 0}, {0, 0.5}, {1, 0.5}}));
    EXPECT_EQ(at(two, "covariance", 1), 0);
    const Report line = analyze("moments", points_of({{0, 1}, {0.5, 0.5}, {1, 0}}));
    EXPECT_DOUBLE_EQ(at(line, "covariance", 1), -0.25);
    EXPECT_DOUBLE_EQ(at(line, "covariance", 2), -0.25);
    EXPECT_DOUBLE_EQ(at(line, "covariance", 0), 0.25);
}

TEST(Moments, EqualPointsHaveNoSpread) {
    const Report report = analyze("moments", PointSet(std::vector<double>(100, 0.3), 2));
    for (const char* key : {"variance", "skewness", "covariance", "standard_error.mean"})
        EXPECT_EQ(at(report, key, 0), 0) << key;
    EXPECT_DOUBLE_EQ(at(report, "mean", 1), 0.3);
}

// Oracle: two passes in long double, about the mean; far from the origin and near it.
TEST(Moments, AgreeWithTheDefinition) {
    for (const double shift : {0.0, 1e6}) {
        PointSet set = make("random", {3000, 3});
        for (std::size_t i = 0; i < set.count(); ++i) {
            set[i][1] = set[i][0] * set[i][1];
            set[i][2] = shift + set[i][2] * set[i][2];
        }
        set.domain = box_domain({{-1, -1, -1}, {2, 2, 2e6}});
        const Report report = analyze("moments", set);
        const auto mean = [&](auto&& f) {
            long double sum = 0;
            for (std::size_t i = 0; i < set.count(); ++i) sum += f(i);
            return sum / static_cast<long double>(set.count());
        };
        const long double n = 3000;
        for (std::size_t a = 0; a < 3; ++a) {
            const long double ma = mean([&](auto i) { return set[i][a]; });
            EXPECT_NEAR(at(report, "mean", a), double(ma), 1e-10 * (1 + 1e-3 * shift));
            const auto m2 = mean([&](auto i) { return std::pow(set[i][a] - ma, 2.0L); });
            const auto m3 = mean([&](auto i) { return std::pow(set[i][a] - ma, 3.0L); });
            EXPECT_NEAR(at(report, "skewness", a), double(m3 / std::pow(m2, 1.5L)), 1e-9);
            for (std::size_t b = 0; b < 3; ++b) {
                const long double mb = mean([&](auto i) { return set[i][b]; });
                const auto c = mean([&](auto i) { return (set[i][a] - ma) * (set[i][b] - mb); });
                const auto vb = mean([&](auto i) { return std::pow(set[i][b] - mb, 2.0L); });
                const auto m22 = mean(
                    [&](auto i) { return std::pow((set[i][a] - ma) * (set[i][b] - mb), 2.0L); });
                EXPECT_NEAR(at(report, "covariance", 3 * a + b), double(c * n / (n - 1)), 1e-10);
                EXPECT_NEAR(
                    at(report, "standard_error.covariance", 3 * a + b),
                    double(std::sqrt((m22 - c * c * (n - 2) / (n - 1) + m2 * vb / (n - 1)) / n)),
                    2e-6);
            }
        }
    }
}

// Of the corners (0, 0), (1, 0) and (0, 1): m11 = -1/9, m20 = m02 = 2/9 and m22 = 1/27, so the square
// is (1/27 - 1/162 + 4/162) / 3. With itself, a coordinate has the error of its variance.
TEST(Moments, CovariancesOfFewPointsHaveTheErrorsOfVariances) {
    const Report corners = analyze("moments", points_of({{0, 0}, {1, 0}, {0, 1}}));
    EXPECT_NEAR(at(corners, "standard_error.covariance", 1), std::sqrt(1 / 54.), 1e-15);
    const Report same = analyze("moments", points_of({{0.1, 0.1}, {0.5, 0.5}, {0.6, 0.6}}));
    EXPECT_NEAR(at(same, "standard_error.covariance", 1), at(same, "standard_error.variance", 0),
                1e-15);
}

TEST(Moments, DoNotDependOnWhatSumsAreTakenAbout) {
    const PointSet set = make("random", {500, 2});
    analyzers::MomentSums far({1.5, -0.5});
    analyzers::MomentSums near({0.5, 0.5});
    far.add(set.flat(), {});
    near.add(set.flat(), {});
    const auto a = far.moments();
    const auto b = near.moments();
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(a.value.covariance[i], b.value.covariance[i], 1e-14);
        EXPECT_NEAR(a.error.covariance[i], b.error.covariance[i], 1e-12);
    }
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(a.value.mean[k], b.value.mean[k], 1e-15);
        EXPECT_NEAR(a.value.skewness[k], b.value.skewness[k], 1e-12);
        EXPECT_NEAR(a.error.skewness[k], b.error.skewness[k], 1e-11);
    }
}

// 1e16 + 1 - 1e16 = 1: rounding errors of sums are compensated.
TEST(Moments, CarryWhatRoundingTakes) {
    analyzers::MomentSums sums({0.0});
    for (const double x : {1e16, 1.0, -1e16, 0.0}) sums.add(std::vector{x}, {});
    EXPECT_EQ(sums.moments().value.mean[0], 0.25);
}

// 100 sets: each standard error is within 30 % of the standard deviation between sets; with 100
// values this fails with probability 2e-5.
TEST(Moments, StandardErrorsAreTheSpreadBetweenSets) {
    const char* keys[] = {"mean", "variance", "skewness", "covariance"};
    for (const char* key : keys) {
        const std::size_t which = std::string(key) == "covariance" ? 1 : 0;
        double sum = 0, squares = 0, error = 0;
        for (std::uint64_t seed = 1; seed <= 100; ++seed) {
            PointSet set = make("random", {400, 2}, {}, {.seed = seed});
            for (std::size_t i = 0; i < set.count(); ++i)
                set[i][0] = set[i][0] * set[i][0], set[i][1] = set[i][0] * set[i][1];
            const Report report = analyze("moments", set);
            const double x = at(report, key, which);
            sum += x;
            squares += x * x;
            error += at(report, (std::string("standard_error.") + key).c_str(), which) / 100;
        }
        const double spread = std::sqrt((squares - sum * sum / 100) / 99);
        EXPECT_NEAR(spread / error, 1, 0.3) << key;
    }
}

TEST(Moments, BoxesAndProductsHaveExactValues) {
    PointSet set = make("random", {1000, 3});
    set.domain = product_domain({{box_domain({{-2, 0}, {4, 12}}), {2, 0}}, {unit_cube(1), {1}}});
    for (std::size_t i = 0; i < set.count(); ++i) {
        set[i][0] *= 12;
        set[i][2] = 6 * set[i][2] - 2;
    }
    const Report report = analyze("moments", set);
    EXPECT_EQ(report.curve("exact.mean"), (Report::Curve{6, 0.5, 1}));
    EXPECT_EQ(report.curve("exact.variance"), (Report::Curve{12, 1.0 / 12, 3}));
    EXPECT_LT(report.number("cube.largest_z"), 4.5);
}

// largest_z of 9 values of random points exceeds 5 with a probability of about 1e-5.
TEST(Moments, CubeCoordinatesTellRightWarpsFromWrong) {
    const PointSet cube = make("random", {20'000, 2});
    EXPECT_LT(measure("moments", "cube.largest_z", warped(*mapping("disk"), cube)), 5);
    EXPECT_GT(measure("moments", "cube.largest_z", warped(*mapping("disk:method=naive"), cube)),
              50);
    // The second moment of a unit disk's coordinates is 1/4.
    const Report disk = analyze("moments", warped(*mapping("disk"), cube));
    EXPECT_EQ(std::get<bool>(*disk.find("exact.known")), true);
    EXPECT_EQ(disk.curve("exact.variance"), (Report::Curve{0.25, 0.25}));
}

TEST(Moments, SayThatExactValuesOfADomainAreNotKnown) {
    PointSet set = make("random", {100, 1});
    set.domain = std::make_shared<Steps>(std::vector<double>{0.5, 0.5});
    const Report report = analyze("moments", set);
    EXPECT_EQ(std::get<bool>(*report.find("exact.known")), false);
    EXPECT_EQ(report.find("exact.mean"), nullptr);
    EXPECT_EQ(report.find("cube"), nullptr);
    EXPECT_NE(report.find("standard_error.covariance"), nullptr);
}

TEST(Moments, NeedTwoPointsOnTheirDomain) {
    EXPECT_EQ(error_of([] {
                  analyze("moments", make("random", {1, 2}));
              }),
              "input: moments needs at least 2 points; there is 1");
    PointSet far = make("random", {10, 1});
    far.domain = box_domain({{-1e200}, {1e200}});
    far[3][0] = 1e160;
    EXPECT_EQ(error_of([&] { analyze("moments", far); }),
              "limit: variances of coordinates are beyond the largest double");
    for (std::size_t i = 0; i < 10; ++i) far[i][0] = std::ldexp(1 + static_cast<double>(i), -540);
    EXPECT_EQ(error_of([&] { analyze("moments", far); }),
              "limit: variances of coordinates are below the smallest normal double");
}

// On the unit cube both are of the same numbers, of which a cluster keeps digits only about its mean.
TEST(Moments, OfAClusterAreTheSameOnTheCube) {
    for (const double width : {0.5, 1e-3, 1e-6, 1e-12}) {
        PointSet cluster = make("random", points(1000, 2));
        for (double& x : cluster.flat()) x = 0.2 + width * x;
        const Report report = analyze("moments", cluster);
        for (const std::string name : {"variance", "skewness"}) {
            const double x = at(report, name.c_str(), 0);
            EXPECT_NEAR(at(report, ("cube." + name).c_str(), 0), x, 1e-9 * std::abs(x)) << width;
        }
    }
}

// Sixth powers of such coordinates are no doubles, but their moments are.
TEST(Moments, ScaleWithTheCoordinates) {
    const Box wide{{-1e300, -1e300}, {1e300, 1e300}};
    PointSet plain = make("halton", points(1000, 2));
    plain.domain = box_domain(wide);
    const Report at_one = analyze("moments", plain);
    for (const int exponent : {-500, -300, -130, 130, 300, 500}) {
        PointSet scaled = plain;
        for (double& x : scaled.flat()) x = std::ldexp(x, exponent);
        const Report report = analyze("moments", scaled);
        for (const std::string kind : {"", "standard_error."})
            for (const auto& [name, power, count] : {std::tuple{"mean", 1, 2U},
                                                     {"variance", 2, 2U},
                                                     {"skewness", 0, 2U},
                                                     {"covariance", 2, 4U}})
                for (std::size_t i = 0; i < count; ++i) {
                    const double found = at(report, (kind + name).c_str(), i);
                    const double expected = at(at_one, (kind + name).c_str(), i);
                    EXPECT_NEAR(std::ldexp(found, -power * exponent), expected,
                                1e-12 * std::abs(expected))
                        << kind << name << " " << exponent;
                }
    }
}

// Equal points have no variance, but a finite distance from the expected moments: (1/2 - 0.25)
// sqrt(12 * 3) = 1.5, and for the variance (1/12) / sqrt((1/80) / 3) = 1.29.
TEST(Moments, LargestZIsFiniteWhateverThePoints) {
    const PointSet same = points_of({{0.25}, {0.25}, {0.25}});
    EXPECT_DOUBLE_EQ(measure("moments", "cube.largest_z", same), 1.5);
}

// Each moment in turn has the largest deviation: the variance 1/2 of 0 and 1, with standard error
// sqrt((1/80 + 1/144) / 2) for two points; the covariance 1/8 of two points on the diagonal, with
// 1/12; the skewness of one point far from three, with sqrt(72 / (35 n)).
TEST(Moments, LargestZIsThatOfAnyMoment) {
    const auto largest = [](const PointSet& set) {
        return measure("moments", "cube.largest_z", set);
    };
    EXPECT_NEAR(largest(points_of({{0}, {1}})), (5 / 12.) / std::sqrt(7 / 720.), 1e-13);
    EXPECT_NEAR(largest(points_of({{0.25, 0.25}, {0.75, 0.75}})), 1.5, 1e-13);
    EXPECT_NEAR(largest(points_of({{0.25, 0.75}, {0.75, 0.25}})), 1.5, 1e-13);
    // Deviations from the mean 1/2: three of -0.1 and one of 0.3.
    const double skewness = 0.006 / std::pow(0.03, 1.5);
    EXPECT_NEAR(largest(points_of({{0.4}, {0.4}, {0.4}, {0.8}})), skewness / std::sqrt(72 / 140.),
                1e-12);
}

TEST(Moments, SayWhoseExactValuesTheyAre) {
    const PointSet cube = make("random", {100, 2});
    const Report naive = analyze("moments", warped(*mapping("disk:method=naive"), cube));
    EXPECT_EQ(naive.text("exact.law"), "uniform on disk");
    EXPECT_EQ(naive.curve("exact.variance"), (Report::Curve{0.25, 0.25}));
    EXPECT_EQ(naive.text("cube.axes"), "area fraction r^2/R^2; angle in turns");
    const Report bell = analyze("moments", warped(*mapping("normal"), cube));
    EXPECT_EQ(bell.text("exact.law"), "the density of normal");
    EXPECT_EQ(analyze("moments", cube).find("cube.axes"), nullptr);
}

}  // namespace stipple::testing::moments_test
