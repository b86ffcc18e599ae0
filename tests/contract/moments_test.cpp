// SPDX-License-Identifier: MIT
//
// Exact moments of domains, compared with integrals over the cube through their warps.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "places.hpp"
#include "support/pictures.hpp"
#include "support/warping.hpp"

namespace stipple::testing::moments_test {
namespace {

/// Midpoint rule on an axis of the cube, with nodes concentrated at both ends, where warps may have
/// roots, logarithms and poles: u = t - sin(2 pi t) / (2 pi).
struct Nodes {
    std::vector<double> at;
    std::vector<double> weight;

    explicit Nodes(std::size_t n) {
        const double turn = 2 * std::numbers::pi;
        for (std::size_t i = 0; i < n; ++i) {
            const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
            at.push_back(t - std::sin(turn * t) / turn);
            weight.push_back((1 - std::cos(turn * t)) / static_cast<double>(n));
        }
    }
};

/// Tensor product of the nodes, as rows with weights.
struct Rule {
    std::vector<double> rows;
    std::vector<double> weights;

    Rule(const Nodes& nodes, std::size_t d) {
        std::vector<std::size_t> at(d, 0);
        for (std::size_t k = 0; k < d;) {
            double weight = 1;
            for (const std::size_t i : at) {
                rows.push_back(nodes.at[i]);
                weight *= nodes.weight[i];
            }
            weights.push_back(weight);
            for (k = 0; k < d && ++at[k] == nodes.at.size(); ++k) at[k] = 0;
        }
    }
};

Moments integrated(const Mapping& map, std::size_t n) {
    const std::size_t d = map.domain()->dimension();
    const Rule rule(Nodes(n), map.cube_dimension());
    const auto& weights = rule.weights;
    std::vector<double> image(weights.size() * d);
    std::vector<std::uint8_t> keep(weights.size(), 1);
    map.forward(rule.rows, image, keep);
    Moments m{std::vector<double>(d), std::vector<double>(d * d), std::vector<double>(d)};
    for (std::size_t i = 0; i < weights.size(); ++i)
        for (std::size_t k = 0; k < d; ++k) m.mean[k] += weights[i] * image[i * d + k];
    for (std::size_t i = 0; i < weights.size(); ++i)
        for (std::size_t k = 0; k < d; ++k) {
            const double x = image[i * d + k] - m.mean[k];
            m.skewness[k] += weights[i] * x * x * x;
            for (std::size_t j = 0; j < d; ++j)
                m.covariance[k * d + j] += weights[i] * x * (image[i * d + j] - m.mean[j]);
        }
    for (std::size_t k = 0; k < d; ++k)
        if (m.covariance[k * d + k] > 0) m.skewness[k] /= std::pow(m.covariance[k * d + k], 1.5);
    return m;
}

/// Expects both moments to agree within a fraction of the standard deviations.
void expect_same(const Moments& exact, const Moments& found, double tolerance) {
    const std::size_t d = exact.dimension();
    ASSERT_EQ(found.dimension(), d);
    std::vector<double> size(d);
    for (std::size_t k = 0; k < d; ++k) size[k] = std::sqrt(found.covariance[k * d + k]);
    for (std::size_t k = 0; k < d; ++k) {
        EXPECT_NEAR(exact.mean[k], found.mean[k], tolerance * size[k] + 1e-15) << "mean " << k;
        EXPECT_NEAR(exact.skewness[k], found.skewness[k], 4 * tolerance) << "skewness " << k;
        for (std::size_t j = 0; j < d; ++j)
            EXPECT_NEAR(exact.covariance[k * d + j], found.covariance[k * d + j],
                        tolerance * size[k] * size[j])
                << "covariance " << k << ", " << j;
    }
}

class ExactMoments : public ::testing::TestWithParam<const char*> {};

TEST_P(ExactMoments, AreTheIntegrals) {
    const auto map = mapping(GetParam());
    const auto exact = map->domain()->moments();
    ASSERT_TRUE(exact.has_value());
    const std::size_t d = map->cube_dimension();
    expect_same(*exact, integrated(*map, d == 1 ? 20'000 : (d == 2 ? 600 : 80)), 2e-5);
}

// Shapes in general position, with arbitrary sizes and rotations, so that no errors cancel.
INSTANTIATE_TEST_SUITE_P(
    Laws, ExactMoments,
    ::testing::Values(
        "annulus:inner=0.5,radius=2,center=[1,-3]", "ball:radius=2,center=[1,2,3]",
        "circle:radius=3,center=[1,2]", "cone:half-angle=20,axis=[1,2,3]",
        "cone:half-angle=150,axis=[0,1,0.5]", "cylinder:radius=2,height=3,axis=[1,2,2]",
        "disk:radius=2,center=[3,4]", "ellipse:axes=[3,1],rotation=30,center=[1,1]",
        "exponential:rate=[2,0.5]", "hemisphere:axis=[1,-1,2]",
        "hemisphere:method=cosine,axis=[1,-1,2]",
        "hemisphere:method=cosine-power,exponent=3.5,axis=[1,-1,2]",
        "henyey-greenstein:g=0.6,axis=[1,2,-2]", "henyey-greenstein:g=-0.9",
        "normal:mean=[1,2],deviation=[3,0.5]", "normal:covariance=[2,1,1,3]",
        "parallelogram:corner=[1,2,3],edges=[1,0,2 0,3,1]", "pixel:resolution=3x2,pixel=[1,1]",
        "power:exponent=1", "power:exponent=2.5,range=[1,3]", "power:exponent=-1,range=[1,5]",
        "power:exponent=-3,range=[1,5]", "power:exponent=2,range=[-5,-1]",
        "power:exponent=4,range=[2,2.1]", "power:exponent=-0.5",
        "spherical-triangle:vertices=[1,0,0 0,1,0.2 0.1,0.3,1]",
        "spherical-triangle:vertices=[1,0,0 1,0.2,0 1,0.1,0.3]",
        "spherical-rectangle:corner=[-1,-0.5,-1],edges=[3,0,0 0,1,0]",
        "expression-1d:density=1+x*x,range=[1,3]", "expression-1d:density=exp(-x),range=[0,20]",
        "sphere:radius=2,center=[1,2,3]", "tent:radius=[1,2],center=[3,0]",
        "torus-surface:major-radius=2,minor-radius=1.5,axis=[1,1,0],center=[1,0,0]",
        "triangle:vertices=[0,0 3,1 1,4]", "triangle:vertices=[1,0,0 0,2,0 0,0,3]",
        "von-mises-fisher:kappa=0.5,axis=[1,2,3]", "von-mises-fisher:kappa=5,axis=[1,2,3]",
        "von-mises-fisher:kappa=300,axis=[1,2,3]", "von-mises-fisher:kappa=0"),
    [](const auto& test) { return "Case" + std::to_string(test.index); });

// Sectors, sides, pieces and parts, whose maps have kinks and jumps inside the cube.
TEST(MomentsOfParts, AreTheIntegralsToo) {
    for (const char* spec :
         {"sector:inner=0.5,radius=2,angles=[20,100],center=[1,1]", "sector:angles=[0,300]",
          "power:exponent=2,range=[-1,2]",
          "mixture:components=[henyey-greenstein:g=0.7|cone:half-angle=30,axis=[1,0,0]]",
          "regular-polygon:sides=3,rotation=10", "regular-polygon:sides=5,rotation=10",
          "cylinder:caps=true,radius=2,height=3,axis=[1,2,2]",
          "polygon:vertices=[0,0 4,0 4,4 0,4 / 1,1 1,3 3,3 3,2]", "table-1d:rows=[0,1 1,3 2,0 4,2]",
          "table-1d:rows=[0,1 1,3 2,0.5 4,2],interpolation=constant",
          "power:exponent=6,range=[-2,1]", "expression-2d:density=1+x*y,bounds=[0..1,1..3]",
          "expression-1d:density=[x<0.3?1:(x<0.6?0:2)]"}) {
        SCOPED_TRACE(spec);
        const auto map = mapping(spec);
        const auto exact = map->domain()->moments();
        ASSERT_TRUE(exact.has_value());
        expect_same(*exact, integrated(*map, map->cube_dimension() == 1 ? 20'000 : 700), 5e-3);
    }
}

// Three faces of area 1/2 in the coordinate planes, and one of area sqrt(3) / 2.
TEST(MomentsOfParts, OfATetrahedronsFacesByHand) {
    const auto map = mapping("mesh:file=" STIPPLE_SOURCE_DIR "/tests/support/tetrahedron.obj");
    const auto exact = map->domain()->moments();
    ASSERT_TRUE(exact.has_value());
    const double slant = std::sqrt(3) / 2;
    // On a right triangle E x^2 is 1/6 and E x y 1/12; also on the slanted one.
    const double mean = (1 + slant) / 3 / (1.5 + slant);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(exact->mean[k], mean, 1e-15);
    EXPECT_NEAR(exact->covariance[0], (1 + slant) / 6 / (1.5 + slant) - mean * mean, 1e-15);
    EXPECT_NEAR(exact->covariance[1], (0.5 + slant) / 12 / (1.5 + slant) - mean * mean, 1e-15);
    expect_same(*exact, integrated(*map, 700), 0.02);
}

TEST(MomentsOfParts, OfAPictureAndOfOutcomesByHand) {
    // Densities 1 and 3 side by side: mean 1/4 1/4 + 3/4 3/4, E x^2 1/12 + 3/4 7/12.
    const TemporaryFile file(npy_of<double>("<f8", "(1, 2)", std::vector<double>{1, 3}));
    const auto picture = mapping("image:file=" + file.path())->domain()->moments();
    ASSERT_TRUE(picture.has_value());
    EXPECT_DOUBLE_EQ(picture->mean[0], 0.625);
    EXPECT_DOUBLE_EQ(picture->mean[1], 0.5);
    EXPECT_NEAR(picture->covariance[0], 1 / 48. + 7 / 16. - 0.625 * 0.625, 1e-15);
    EXPECT_NEAR(picture->covariance[3], 1 / 12., 1e-15);
    expect_same(*picture, integrated(*mapping("image:file=" + file.path()), 600), 1e-4);
    const std::vector<double> values{1, 3, 0, 0, 0, 7, 2, 1, 1, 0.5, 4, 2};
    const TemporaryFile smooth(npy_of<double>("<f8", "(4, 3)", values));
    const auto map = mapping("image:interpolation=bilinear,file=" + smooth.path());
    expect_same(*map->domain()->moments(), integrated(*map, 600), 1e-4);
    // Values 0 and 1 with probabilities 3/4 and 1/4: variance 3/16, skewness (1 - 2 p) / sqrt(p q).
    const auto coin =
        mapping("discrete:probabilities=[0.75,0.25],values=[0,1]")->domain()->moments();
    ASSERT_TRUE(coin.has_value());
    EXPECT_EQ(coin->mean[0], 0.25);
    EXPECT_EQ(coin->covariance[0], 3 / 16.);
    EXPECT_NEAR(coin->skewness[0], 0.5 / std::sqrt(3 / 16.), 1e-15);
}

// On each triangle, normals are constant and barycentric coordinates linear: a barycentric
// coordinate has mean 1/3 and variance 1/18.
TEST(MomentsOfParts, OfMeshesGoWithTheirAttributes) {
    const std::string file = STIPPLE_SOURCE_DIR "/tests/support/tetrahedron.obj";
    const auto rich = mapping("mesh:attributes=barycentric,file=" + file);
    const Moments m = *rich->domain()->moments();
    ASSERT_EQ(m.dimension(), 7U);
    for (std::size_t k = 4; k < 7; ++k) {
        EXPECT_NEAR(m.mean[k], 1 / 3.0, 1e-12);
        EXPECT_NEAR(m.covariance[8 * k], 1 / 18.0, 1e-12);
    }
    const Moments plain = *mapping("mesh:file=" + file)->domain()->moments();
    const Moments normals = *mapping("mesh:attributes=normal,file=" + file)->domain()->moments();
    EXPECT_NEAR(normals.mean[2], plain.mean[2], 1e-12);
    // Normals times areas of a closed surface sum to 0.
    for (std::size_t k = 3; k < 6; ++k) EXPECT_NEAR(normals.mean[k], 0, 1e-12);
}

TEST(MomentsOfParts, KeepTheirDigitsWhereLawsAreThin) {
    const auto of = [](const char* spec) { return *mapping(spec)->domain()->moments(); };
    // A constant coordinate has skewness 0.
    const Moments level = of("triangle:vertices=[0,0,1 1,0,1 0,1,1]");
    EXPECT_EQ(level.covariance[8], 0);
    EXPECT_EQ(level.skewness[2], 0);
    // Nearly normal about the axis, with variance 1 / kappa; 1 - z is nearly exponential.
    const Moments thin = of("von-mises-fisher:kappa=1e8");
    EXPECT_NEAR(thin.covariance[0] * 1e8, 1, 1e-7);
    EXPECT_NEAR(thin.covariance[8] * 1e16, 1, 1e-12);
    EXPECT_NEAR(thin.skewness[2], -2, 1e-12);
    const double drop = std::pow(std::numbers::pi / 180 * 1e-3, 2) / 2;
    EXPECT_NEAR(of("cone:half-angle=1e-3").covariance[8] / (drop * drop / 12), 1, 1e-9);
    EXPECT_NEAR(of("power:exponent=5,range=[1,1.000001]").covariance[0] * 12e12, 1, 1e-9);
    // Density x^999: 1 - x is nearly exponential.
    EXPECT_NEAR(of("power:exponent=999").covariance[0] * 1001 * 1001 * 1002 / 1000, 1, 1e-9);
}

TEST(MomentsOfParts, AreNotGivenWhereDigitsWouldBeLost) {
    for (const char* spec : {"spherical-triangle:vertices=[1,0,0 1,1e-5,0 1,0,1e-5]",
                             "rejection:density=x,bounds=[0..1,0..1,0..1]"})
        EXPECT_FALSE(mapping(spec)->domain()->moments().has_value()) << spec;
}

}  // namespace

}  // namespace stipple::testing::moments_test
