// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/chain.hpp"
#include "support/warping.hpp"

namespace stipple::testing::expression_2d_test {
namespace {

struct PlaneMoments {
    double x, y, xx, yy, xy;
};

/// Means, variances and covariance of the images of the cells' centres of an n x n grid.
PlaneMoments moments_of(const Mapping& map, std::size_t n = 1000) {
    std::vector<double> cube;
    for (std::size_t i = 0; i < n * n; ++i) {
        cube.push_back((static_cast<double>(i % n) + 0.5) / static_cast<double>(n));
        cube.push_back((static_cast<double>(i / n) + 0.5) / static_cast<double>(n));
    }
    std::vector<double> image(cube.size());
    map.forward(cube, image, {});
    PlaneMoments m{};
    const auto count = static_cast<double>(n * n);
    for (std::size_t i = 0; i < image.size(); i += 2) {
        const double x = image[i];
        const double y = image[i + 1];
        m = {m.x + x / count, m.y + y / count, m.xx + x * x / count, m.yy + y * y / count,
             m.xy + x * y / count};
    }
    return {m.x, m.y, m.xx - m.x * m.x, m.yy - m.y * m.y, m.xy - m.x * m.y};
}

}  // namespace

// p = 2 on x + y < 1: p(x) = 2 - 2 x, p(y | x) = 1 / (1 - x). Inverting F(x, y) / F(x, y_max)
// instead would put 22.7 % of the points outside.
TEST(Expression2d, TriangleHasItsMomentsAndNoPointOutside) {
    const auto map = mapping("expression-2d:density=[x + y < 1 ? 1 : 0]");
    const PlaneMoments m = moments_of(*map);
    EXPECT_NEAR(m.x, 1 / 3.0, 2e-4);
    EXPECT_NEAR(m.y, 1 / 3.0, 2e-4);
    EXPECT_NEAR(m.xx, 1 / 18.0, 2e-4);
    EXPECT_NEAR(m.yy, 1 / 18.0, 2e-4);
    EXPECT_NEAR(m.xy, -1 / 36.0, 2e-4);
    const PointSet image = warped(*map, make("random", points(300'000, 2)));
    for (std::size_t i = 0; i < image.count(); ++i) ASSERT_LT(image[i][0] + image[i][1], 1);
    EXPECT_NEAR(map->domain()->density(std::vector{0.2, 0.3}), 2, 1e-7);
    EXPECT_NEAR(map->density(std::vector{0.2, 0.3}), 2, 1e-3);
    EXPECT_EQ(map->density(std::vector{0.8, 0.3}), 0);
}

// f = x + y: p(x) = x + 1/2, p(y | x) = (x + y) / (x + 1/2). Means 7/12, variances 11/144,
// covariance -1/144. Exact at corners: at x = 0, y = sqrt(xi1).
TEST(Expression2d, SumOfCoordinatesHasItsConditional) {
    const auto map = mapping("expression-2d:density=x+y");
    const PlaneMoments m = moments_of(*map);
    EXPECT_NEAR(m.x, 7 / 12.0, 1e-6);
    EXPECT_NEAR(m.y, 7 / 12.0, 1e-6);
    EXPECT_NEAR(m.xx, 11 / 144.0, 1e-6);
    EXPECT_NEAR(m.yy, 11 / 144.0, 1e-6);
    EXPECT_NEAR(m.xy, -1 / 144.0, 1e-6);
    std::vector<double> image(4);
    map->forward(std::vector<double>{0, 0.49, 3 / 8.0, 0.5}, image, {});
    EXPECT_EQ(image[0], 0);
    EXPECT_NEAR(image[1], 0.7, 1e-14);
    EXPECT_NEAR(image[2], 0.5, 1e-14);                                // (x^2 + x) / 2 = 3/8
    EXPECT_NEAR(image[3] * image[3] / 2 + image[3] / 2, 0.5, 1e-14);  // half of the total 1
}

// p(x) = 0 at x = 0, where the conditional is the limit, 2 y.
TEST(Expression2d, TakesTheLimitWhereTheMarginalIsZero) {
    std::vector<double> image(2);
    mapping("expression-2d:density=x*y")->forward(std::vector{0.0, 0.25}, image, {});
    EXPECT_EQ(image[0], 0);
    EXPECT_NEAR(image[1], 0.5, 1e-15);
    mapping("expression-2d:density=(1-x)*y")->forward(std::vector{1.0, 0.25}, image, {});
    EXPECT_NEAR(image[0], 1, 2e-8);  // (1 - x)^2 = 2^-53
    EXPECT_NEAR(image[1], 0.5, 1e-15);
    // At x = 1 itself, where the density is 0, the inverse uses the same limit.
    mapping("expression-2d:density=(1-x)*y")->inverse(std::vector{1.0, 0.5}, image);
    EXPECT_EQ(image[0], 1);
    EXPECT_NEAR(image[1], 0.25, 1e-15);
}

TEST(Expression2d, GoesThereAndBack) {
    const PointSet cube = telling_points();
    for (const std::string spec :
         {"density=1+x*y", "density=[exp(-9*(x-y)^2)],bounds=[-1..2,0..1]",
          "density=[x*x+y*y<1 ? 1 : 0],bounds=-1..1,tolerance=0.01", "density=x*y"}) {
        const auto map = mapping("expression-2d:" + spec);
        PointSet image(cube.count(), 2), back(cube.count(), 2);
        map->forward(cube.flat(), image.flat(), {});
        map->inverse(image.flat(), back.flat());
        for (std::size_t i = 0; i < cube.count(); ++i) {
            ASSERT_TRUE(map->domain()->contains(image[i])) << spec;
            ASSERT_NEAR(back[i][0], cube[i][0], 1e-13) << spec << " " << i;
            ASSERT_NEAR(back[i][1], cube[i][1], 1e-13) << spec << " " << i;
        }
    }
}

/// Fraction of points in a disk, by 2^17 points of a net.
double share_in_disk(const Mapping& map, double x, double y, double r) {
    const PointSet image = warped(map, make("sobol", points(1U << 17, 2)));
    std::size_t inside = 0;
    for (std::size_t i = 0; i < image.count(); ++i)
        inside += std::hypot(image[i][0] - x, image[i][1] - y) < r ? 1U : 0U;
    return static_cast<double>(inside) / static_cast<double>(image.count());
}

// With f = h inside a disk of area a and 1 outside, the disk has h a / (h a + 1 - a) of the mass.
// One disk is between the lines of a first strip, whose patches may become thinner than the spacing
// of their samples; the others are as small as promised, and accurate to 3 % of their mass.
TEST(Expression2d, FindsDisksOf1Over256) {
    const double least = 0.5 / 256;
    for (const auto& [x, y, r] :
         {std::array{0.4425, 0.5, 0.018}, std::array{0.4425, 0.5, least},
          std::array{0.1234, 0.8765, least}, std::array{0.0501, 0.9507, least},
          std::array{0.71, 0.29, least}, std::array{0.5, 0.5, least}}) {
        const double area = std::numbers::pi * r * r;
        const double height = 1 / area;
        const auto map = mapping(
            fmt::format("expression-2d:density=[(x-{})^2+(y-{})^2<{}^2?{}:1],tolerance=0.002", x, y,
                        r, height));
        EXPECT_NEAR(share_in_disk(*map, x, y, r), 1 / (2 - area), r > least ? 0.004 : 0.015)
            << x << " " << y << " " << r;
    }
}

// Thinner than the grid of samples resolves, but hit by many samples taken later.
TEST(Expression2d, FindsAThinLine) {
    const auto map =
        mapping("expression-2d:density=[abs(x-0.30171)<0.0001?5000:1],tolerance=0.002");
    const PointSet image = warped(*map, make("sobol", points(1U << 15, 2)));
    std::size_t inside = 0;
    for (std::size_t i = 0; i < image.count(); ++i)
        inside += std::abs(image[i][0] - 0.30171) < 0.0001 ? 1U : 0U;
    EXPECT_NEAR(static_cast<double>(inside) / 32768, 1 / (2 - 0.0002), 0.004);
}

// A patch that is 0 at its edge and just beyond, but linear at its samples, has no bend: its mass was
// left out without counting as an error, up to 0.02 of the whole.
TEST(Expression2d, CountsAGapNextToAnEdgeAsAnError) {
    for (const double edge : {0.50001, 0.5001, 0.5004, 0.501}) {
        const auto distance = [edge](const std::string& spec, std::size_t axis) {
            const PointSet image =
                warped(*mapping("expression-2d:" + spec), make("sobol", points(1U << 14, 2)));
            std::vector<double> shares;
            for (std::size_t i = 0; i < image.count(); ++i)
                shares.push_back(std::pow((image[i][axis] - edge) / (1 - edge), 2));
            std::ranges::sort(shares);
            double worst = 0;
            for (std::size_t i = 0; i < shares.size(); ++i)
                worst =
                    std::max(worst, std::abs(shares[i] - (static_cast<double>(i) + 0.5) / 16384));
            return worst;
        };
        EXPECT_LT(distance(fmt::format("density=[max(0,x-{})]", edge), 0), 4e-4) << edge;
        EXPECT_LT(distance(fmt::format("density=[max(0,y-{})]", edge), 1), 4e-4) << edge;
        EXPECT_LT(distance(fmt::format("density=[max(0,y-{0})*max(0,x-{0})]", edge), 0), 4e-4)
            << edge;
        EXPECT_LT(distance(fmt::format("density=[y>{}?y-{}:0],tolerance=0.01", edge, edge), 1),
                  1e-2);
    }
}

// The domain's integral is right, too, or throws an error.
TEST(Expression2d, DomainKnowsWhatIsNarrow) {
    const double r = 0.5 / 256;
    const double area = std::numbers::pi * r * r;
    for (const double x : {0.4425, 0.1234, 0.71}) {
        const auto map = mapping(fmt::format(
            "expression-2d:density=[(x-{})^2+(y-0.5)^2<{}^2?{}:1],tolerance=0.01", x, r, 1 / area));
        EXPECT_NEAR(map->domain()->density(std::vector{0.9, 0.9}), 1 / (2 - area), 2e-3) << x;
    }
}

// A lower tolerance must bring the points nearer to the distribution: the mean of x under an
// oblique jump.
TEST(Expression2d, ToleranceIsKept) {
    for (const std::string tolerance : {"0.05", "0.005"}) {
        const auto map = mapping("expression-2d:density=[x+y<1?1:0],tolerance=" + tolerance);
        EXPECT_NEAR(moments_of(*map, 300).x, 1 / 3.0, std::stod(tolerance));
    }
}

// Small disks and a narrow bell between the first samples. A disk of area a has a / (a + 0.001 (1 -
// a)) of the mass, measured with 160 000 points of a grid.
TEST(Expression2d, SeesWhatIsNarrow) {
    for (const auto& [x, y, r] : {std::array{0.31, 0.7, 0.02}, std::array{0.883, 0.117, 0.004}}) {
        const auto map = mapping(fmt::format(
            "expression-2d:density=[(x-{0})^2+(y-{1})^2<{2}^2?1:0.001],tolerance=0.001", x, y, r));
        constexpr std::size_t n = 400;
        std::size_t inside = 0;
        for (std::size_t i = 0; i < n * n; ++i) {
            std::array<double, 2> at{};
            map->forward(std::array{(static_cast<double>(i % n) + 0.5) / n,
                                    (static_cast<double>(i / n) + 0.5) / n},
                         at, {});
            inside += std::hypot(at[0] - x, at[1] - y) < r ? 1U : 0U;
        }
        const double area = M_PI * r * r;
        const double whole = area + 0.001 * (1 - area);
        EXPECT_NEAR(static_cast<double>(inside) / (n * n), area / whole, 0.002) << x << " " << r;
        EXPECT_NEAR(map->domain()->density(std::array{x, y}), 1 / whole, 1e-3 / whole);
    }
    const auto bell = mapping("expression-2d:density=[exp(-1e6*((x-0.3)^2+(y-0.7)^2))]");
    const PlaneMoments m = moments_of(*bell, 300);
    EXPECT_NEAR(m.x, 0.3, 2e-6);
    EXPECT_NEAR(m.yy, 0.5e-6, 1e-8);
    EXPECT_NEAR(bell->domain()->density(std::array{0.3, 0.7}), 1e6 / M_PI, 10);
}

// dx dy = dxi / density: x depends only on xi0, so a small square of the cube is mapped to dx/dxi0
// dy/dxi1 times its area.
TEST(Expression2d, DensityIsThatOfThePointsAsTheyAre) {
    const PointSet cube = make("random", points(500, 2));
    for (const std::string spec :
         {"density=[abs(sin(20*x*y))]", "density=[exp(-9*(x-y)^2)],bounds=[-1..2,0..3]"}) {
        const auto map = mapping("expression-2d:tolerance=0.01," + spec);
        double worst = 0;
        for (std::size_t i = 0; i < cube.count(); ++i) {
            constexpr double h = 1e-7;
            const double u = cube[i][0], v = cube[i][1];
            const auto at = image_of(*map, {u, v});
            const double dx = image_of(*map, {u + h, v})[0] - image_of(*map, {u - h, v})[0];
            const double dy = image_of(*map, {u, v + h})[1] - image_of(*map, {u, v - h})[1];
            EXPECT_NEAR(map->density(at) * dx * dy / (4 * h * h), 1, 2e-5) << spec << " " << i;
            worst = std::max(worst, std::abs(map->density(at) / map->domain()->density(at) - 1));
        }
        EXPECT_GT(worst, 1e-4) << "what the tolerance allows is not there to be seen";
    }
}

TEST(Expression2d, ProbabilitiesOfCellsAreIntegrals) {
    const DomainPtr domain = mapping("expression-2d:density=[x+y<1?1:0],tolerance=0.01")->domain();
    EXPECT_FALSE(domain->even());
    const auto p = [&](double x, double y) {
        return domain->probability({{x, y}, {x + 0.25, y + 0.25}});
    };
    EXPECT_NEAR(p(0, 0).value, 1 / 8.0, 1e-7);
    EXPECT_NEAR(p(0.25, 0.5).value, 1 / 16.0, 1e-6);
    EXPECT_EQ(p(0.5, 0.5).value, 0);
    EXPECT_EQ(p(0.75, 0.75).error, 0);
    EXPECT_LT(p(0.25, 0.5).error, 1e-5);
}

TEST(Expression2d, DomainSaysWhatItIsAndParsesBack) {
    const DomainPtr domain =
        mapping("expression-2d:density=[1 + x * y],bounds=[0..2,-0.25..1]")->domain();
    EXPECT_EQ(domain->spec(), "expression-2d:density=1+x*y,bounds=[0..2,-0.25..1]");
    EXPECT_EQ(parse_domain(domain->spec(), 2)->spec(), domain->spec());
    EXPECT_EQ(domain->measure(), 2.5);
}

TEST(Expression2d, RefusesBadOptions) {
    EXPECT_EQ(error_of([] { mapping("expression-2d"); }),
              "usage: --density: no formula given; expected one in x and y, such as 'x + y'");
    EXPECT_EQ(error_of([] { mapping("expression-2d:density=0"); }),
              "usage: --density: 0 is 0 at all points tried in 0..1,0..1");
    EXPECT_NE(error_of([] { mapping("expression-2d:density=x-0.5"); }).find("is -0."),
              std::string::npos);
    EXPECT_NE(error_of([] { mapping("expression-2d:density=1/(x*y)"); }).find("is inf at (0"),
              std::string::npos);
    EXPECT_NE(error_of([] { mapping("expression-2d:density=log(x-2)"); }).find("nan at ("),
              std::string::npos);
    EXPECT_NE(error_of([] {
                  mapping("expression-2d:density=x,bounds=[0..1,1..0]");
              }).find("usage: --bounds: '1..0' is not a range"),
              std::string::npos);
    EXPECT_EQ(error_of([] {
                  inverse_of(*mapping("expression-2d:density=x"), {1.5, 0});
              }),
              "input: the point (1.5, 0) is outside the domain expression-2d:density=x");
}

}  // namespace stipple::testing::expression_2d_test
