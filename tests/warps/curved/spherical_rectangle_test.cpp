// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/planar.hpp"

namespace stipple::testing::spherical_rectangle_test {
namespace {

constexpr double pi = std::numbers::pi;
using Point = std::vector<double>;

void expect_near(const Point& p, const Point& q, double tolerance) {
    for (std::size_t k = 0; k < p.size(); ++k) EXPECT_NEAR(p[k], q[k], tolerance) << k;
}

Point unit(Point v) {
    const double size = std::hypot(v[0], v[1], v[2]);
    for (double& x : v) x /= size;
    return v;
}

const std::string face = "spherical-rectangle:corner=[-1,-1,1],edges=[2,0,0 0,2,0]";
const std::string shapes[] = {
    "spherical-rectangle",
    face,
    "spherical-rectangle:corner=[1,2,0.1],edges=[2,0,0 0,2,0]",
    "spherical-rectangle:corner=[-3,-4,-0.1],edges=[2,0,0 0,2,0]",
    "spherical-rectangle:corner=[3,2,1],edges=[1,2,2 2,1,-2],origin=[1,1,-1]",
    "spherical-rectangle:corner=[-1,-1,0.001],edges=[2,0,0 0,2,0]",
    "spherical-rectangle:corner=[1000,2000,3000],edges=[1,2,0 -2,1,0]",
};

/// Intersection of a direction with the rectangle's plane, in coordinates along its edges; for
/// `face`.
Point on_face(const Point& w) { return {w[0] / w[2], w[1] / w[2]}; }

}  // namespace

// A face of the cube covers a sixth of the sphere; xi = 1/2 is its middle line.
TEST(SphericalRectangle, CubeFaceByHand) {
    const auto map = mapping(face);
    EXPECT_NEAR(map->domain()->measure(), 4 * pi / 6, 1e-15);
    expect_near(image_of(*map, {0.5, 0.5}), {0, 0, 1}, 4e-16);
    expect_near(image_of(*map, {0, 0}), unit({-1, -1, 1}), 5e-16);
    expect_near(image_of(*map, {1, 0}), unit({1, -1, 1}), 5e-16);
    expect_near(image_of(*map, {0, 1}), unit({-1, 1, 1}), 5e-16);
    expect_near(image_of(*map, {1, 1}), unit({1, 1, 1}), 5e-16);
    // On the middle line x = 0 the sine of the elevation is uniform up to sqrt(1/2).
    expect_near(image_of(*map, {0.5, 0.75}), {0, std::sqrt(0.125), std::sqrt(0.875)}, 4e-16);
}

// Part of the face between x = -1 and a line: F(x, y) = atan(x y / (z r)) at its corners, by hand.
TEST(SphericalRectangle, SolidAngleBehindALineIsXi0) {
    for (const double x : {-0.9, -0.5, 0.2, 0.7}) {
        const auto solid = [](double to) {
            return 2 * (std::atan(to / std::sqrt(to * to + 2)) + std::atan(1 / std::sqrt(3)));
        };
        const Point back = inverse_of(*mapping(face), unit({x, 0.3, 1}));
        EXPECT_NEAR(back[0], solid(x) / solid(1), 1e-15) << x;
    }
}

TEST(SphericalRectangle, XiRunAlongTheEdges) {
    for (const auto& spec : shapes) {
        const auto map = mapping(spec);
        const Values values = parse_spec(spec).values(find_warp("spherical-rectangle").options);
        const auto numbers = [&](const char* name) {
            return std::get<std::vector<double>>(values.find(name).value);
        };
        const auto corner = numbers("corner"), origin = numbers("origin");
        const auto edges = std::get<Table>(values.find("edges").value);
        for (const double u : {0.0, 1.0})
            for (const double v : {0.0, 1.0}) {
                Point at(3);
                for (std::size_t k = 0; k < 3; ++k)
                    at[k] = corner[k] + u * edges[0][k] + v * edges[1][k] - origin[k];
                expect_near(image_of(*map, {u, v}), unit(at), 1e-14);
            }
    }
}

TEST(SphericalRectangle, SmallFarRectanglesKeepTheirDigits) {
    // 1 x 1 at a distance of 1e6, facing: solid angle 1e-12 (1 - 1/4 1e-12 ...).
    const auto map = mapping("spherical-rectangle:corner=[-0.5,-0.5,1e6],edges=[1,0,0 0,1,0]");
    EXPECT_NEAR(map->domain()->measure() / 1e-12, 1, 1e-11);
    expect_near(image_of(*map, {0.25, 0.75}), unit({-0.25e-6, 0.25e-6, 1}), 2e-16);
}

TEST(SphericalRectangle, RoundTripOverTheWholeSquare) {
    for (const auto& spec : shapes) {
        SCOPED_TRACE(spec);
        expect_round_trip(*mapping(spec), spec == shapes[5] ? 1e-12 : 3e-15);
    }
    expect_round_trip(*mapping("spherical-rectangle:corner=[1,2,1e-6],edges=[2,0,0 0,2,0]"), 1e-14);
}

// Seen at a grazing angle from the side, and from above, where only xi must come back.
TEST(SphericalRectangle, NearlyFlatRectanglesKeepTheirDigits) {
    const PointSet cube = telling_points();
    const std::pair<const char*, bool> places[] = {
        {"2,-1,1e-3", false}, {"2,-1,1e-9", false}, {"-4,-1.7,1e-6", false}, {"-1,2,1e-9", false},
        {"1,2,1e-9", false},  {"-1,-1,1e-6", true}, {"-0.3,-1.5,1e-9", true}};
    for (const auto& [at, above] : places) {
        const std::string spec =
            std::string("spherical-rectangle:corner=[") + at + "],edges=[2,0,0 0,2,0]";
        SCOPED_TRACE(spec);
        const auto map = mapping(spec);
        if (!above) expect_round_trip(*map, 3e-15);
        double worst = 0;
        for (std::size_t i = 0; i < cube.count(); ++i) {
            const Point back = inverse_of(*map, image_of(*map, {cube[i][0], cube[i][1]}));
            for (std::size_t k = 0; k < 2; ++k)
                worst = std::max(worst, std::abs(back[k] - cube[i][k]));
        }
        EXPECT_LT(worst, 4e-15);
    }
}

// Large, oblique and nearly infinite rectangles, whose points rounding must not move outside.
TEST(SphericalRectangle, KeepsItsPointsOnTheRim) {
    for (const char* shape : {"corner=[0.717,-1.533,1.483],edges=[-4,2,4 -1.5,3,-3]",
                              "corner=[-1e10,-1e10,1],edges=[2e10,0,0 0,2e10,0]",
                              "corner=[-1e10,-1,1],edges=[2e10,0,0 0,2,0]"}) {
        const auto map = mapping("spherical-rectangle:" + std::string(shape));
        for (const PointSet& cube : {telling_points(), hostile_points(20'000, 2)})
            for (std::size_t i = 0; i < cube.count(); ++i) {
                const Point w = image_of(*map, {cube[i][0], cube[i][1]});
                ASSERT_EQ(map->density(w), 1 / map->domain()->measure())
                    << shape << ": " << cube[i][0] << ", " << cube[i][1];
            }
    }
    // The part of the hemisphere outside a square of half-width h is 4 sqrt(2) / h.
    const double left = 2 * std::numbers::pi -
                        mapping("spherical-rectangle:corner=[-1e3,-1e3,1],edges=[2e3,0,0 0,2e3,0]")
                            ->domain()
                            ->measure();
    EXPECT_NEAR(left / (4 * std::numbers::sqrt2 * 1e-3), 1, 1e-5);
    EXPECT_DOUBLE_EQ(mapping("spherical-rectangle:corner=[-1e17,-1e17,1],edges=[2e17,0,0 0,2e17,0]")
                         ->domain()
                         ->measure(),
                     2 * std::numbers::pi);
}

TEST(SphericalRectangle, UnitCoordinatesComeBack) {
    const PointSet cube = telling_points();
    for (std::size_t shape = 0; shape < 5; ++shape) {
        const auto map = mapping(shapes[shape]);
        for (std::size_t i = 0; i < cube.count(); ++i) {
            const Point xi(cube[i].begin(), cube[i].end());
            expect_near(inverse_of(*map, image_of(*map, xi)), xi, 1e-13);
        }
    }
}

TEST(SphericalRectangle, DensityIsOneOverTheSolidAngle) {
    for (std::size_t shape = 0; shape < 5; ++shape)
        expect_density_is_one_over_stretch(*mapping(shapes[shape]), 1e-5);
    EXPECT_NEAR(mapping(face)->density(Point{0, 0, 1}), 6 / (4 * pi), 1e-15);
    EXPECT_EQ(mapping(face)->density(Point{0, 0, -1}), 0);
    EXPECT_EQ(mapping(face)->density(unit({1.01, 0, 1})), 0);
}

// False alarm 1e-5 for each right one; cells are first divided along the other edge. Wrong: points
// uniform on the rectangle.
TEST(SphericalRectangle, ChiSquareAcceptsItAndRejectsPointsUniformByArea) {
    for (const auto& spec : shapes) EXPECT_GT(p_of_random(*mapping(spec), 50'000), 1e-5) << spec;
    PointSet flat = make("random", points(50'000, 3));
    for (std::size_t i = 0; i < flat.count(); ++i) {
        const Point w = unit({2 * flat[i][0] - 1, 2 * flat[i][1] - 1, 1});
        std::copy(w.begin(), w.end(), flat[i].begin());
    }
    flat.domain = mapping(face)->domain();
    EXPECT_LT(measure("chi-square", "p_value", flat), 1e-100);
}

// By symmetry the mean of x/z over a face is 0. The fraction with |x/z| < 1/2, |y/z| < 1/2 is 4
// asin(1/5) / (2 pi / 3) for the half-size square at distance 1: the sine of F is xy / ((x^2+z^2)
// (y^2+z^2))^(1/2) = 1/5. 5 standard errors of 1e5 points are 7.7e-3.
TEST(SphericalRectangle, ShareOfTheInnerSquare) {
    const PointSet image = warped(*mapping(face), make("random", points(100'000, 2)));
    double inner = 0;
    for (std::size_t i = 0; i < image.count(); ++i) {
        const Point p = on_face({image[i][0], image[i][1], image[i][2]});
        inner += std::abs(p[0]) < 0.5 && std::abs(p[1]) < 0.5;
    }
    EXPECT_NEAR(inner / 1e5, 4 * std::asin(0.2) / (2 * pi / 3), 7.7e-3);
}

TEST(SphericalRectangle, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("spherical-rectangle")->domain()->spec(), "spherical-rectangle");
    const DomainPtr domain = mapping(face)->domain();
    EXPECT_EQ(domain->spec(), face);
    EXPECT_EQ(mapping(domain->spec())->domain()->spec(), domain->spec());
    const Box box = domain->bounding_box();
    EXPECT_EQ(box.high[2], 1);
    EXPECT_NEAR(box.low[2], std::sqrt(1 / 3.), 1e-15);
    EXPECT_NEAR(box.high[0], std::sqrt(0.5), 1e-15);
    EXPECT_FALSE(domain->contains(Point{std::nan(""), 0, 0}));
    EXPECT_EQ(error_of([&] {
                  inverse_of(*mapping(face), {0, 0, -1});
              }),
              "input: the point (0, 0, -1) is outside the domain " + face);
}

TEST(SphericalRectangle, RefusesWhatIsNoRectangleOrHasNoSolidAngle) {
    const auto error = [](const std::string& options) {
        return error_of([&] { mapping("spherical-rectangle:" + options); });
    };
    EXPECT_EQ(
        error("edges=[1,0,0 1,1,0]"),
        "usage: --edges: 1,0,0 1,1,0 are not at right angles; the cosine of their angle is 0.707");
    EXPECT_EQ(error("edges=[1,0,0 0,0,0]"), "usage: --edges: 1,0,0 0,0,0 has an edge of length 0");
    EXPECT_EQ(error("edges=[1,0 0,1]"),
              "usage: --edges: 2 vectors of dimension 2; expected 2 vectors x,y,z");
    EXPECT_EQ(error("corner=[1,2]"), "usage: --corner: expected 3 numbers, x,y,z; 2 given");
    EXPECT_EQ(error("origin=[3,4,1]"),
              "usage: --origin: the solid angle of the rectangle from 3,4,1 is 0 or too small; "
              "move the point out of its plane, or nearer");
    EXPECT_NE(error("origin=[0,0,1e15]"), "");
}

}  // namespace stipple::testing::spherical_rectangle_test
