// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "places.hpp"
#include "support/temporary_file.hpp"
#include "support/warping.hpp"

namespace stipple::testing::mesh_test {
namespace {

using Point = std::vector<double>;
const std::string tetrahedron = "mesh:file=" STIPPLE_SOURCE_DIR "/tests/support/tetrahedron.obj";

/// A file that is removed with the object.
class MeshFile : public TemporaryFile {
  public:
    explicit MeshFile(const std::string& text) : TemporaryFile(text, ".obj") {}
    std::string spec(const std::string& more = "") const { return "mesh:file=" + path() + more; }
};

void expect_near(const Point& p, const Point& q, double tolerance) {
    ASSERT_EQ(p.size(), q.size());
    for (std::size_t k = 0; k < p.size(); ++k) EXPECT_NEAR(p[k], q[k], tolerance) << k;
}

/// A bumpy sphere of 2 x rows x 2 rows triangles, some of area 0 at the poles.
std::string bumpy_sphere(int rows) {
    std::string text;
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j < 2 * rows; ++j) {
            const double theta = M_PI * i / rows, phi = M_PI * j / rows;
            const double r = 1 + 0.2 * std::sin(3 * theta) * std::cos(2 * phi);
            text += fmt::format("v {} {} {}\n", r * std::sin(theta) * std::cos(phi),
                                r * std::sin(theta) * std::sin(phi), r * std::cos(theta));
        }
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < 2 * rows; ++j) {
            const int a = 2 * rows * i + j + 1, b = 2 * rows * i + (j + 1) % (2 * rows) + 1;
            text += fmt::format("f {} {} {} {}\n", a, a + 2 * rows, b + 2 * rows, b);
        }
    return text;
}

}  // namespace

// The tetrahedron's faces have areas 1/2, 1/2, 1/2 and sqrt(3)/2, in this order.
TEST(Mesh, PointsByHand) {
    const auto map = mapping(tetrahedron);
    const double area = 1.5 + std::sqrt(0.75);
    EXPECT_DOUBLE_EQ(map->domain()->measure(), area);
    EXPECT_DOUBLE_EQ(map->density(Point{0.25, 0.25, 0}), 1 / area);
    EXPECT_EQ(map->density(Point{0.25, 0.25, 0.25}), 0);
    EXPECT_EQ(image_of(*map, {0, 0.5}), (Point{0, 0, 0}));
    // A quarter of the first face 0, y, x: square root 1/2, then 3/4 of the way to corner 1, which
    // is y.
    expect_near(image_of(*map, {0.125 / area, 0.75}), {0.125, 0.375, 0}, 1e-15);
    expect_near(image_of(*map, {(1 + 0.125) / area, 0.5}), {0, 0.25, 0.25}, 1e-15);
    expect_near(image_of(*map, {1, 0}), {0, 0, 1}, 1e-15);
    expect_near(image_of(*map, {1, 1}), {0, 1, 0}, 1e-15);
}

TEST(Mesh, GivesNormalsAndBarycentrics) {
    const double area = 1.5 + std::sqrt(0.75);
    const auto normals = mapping(tetrahedron + ",attributes=normal");
    expect_near(image_of(*normals, {0.125 / area, 0.75}), {0.125, 0.375, 0, 0, 0, -1}, 1e-15);
    const double h = std::sqrt(1 / 3.);
    expect_near(image_of(*normals, {1, 1}), {0, 1, 0, h, h, h}, 1e-15);
    const auto weights = mapping(tetrahedron + ",attributes=barycentric");
    expect_near(image_of(*weights, {(0.5 + 0.125) / area, 0.75}),
                {0.375, 0, 0.125, 1, 0.5, 0.375, 0.125}, 1e-15);
    EXPECT_EQ(weights->domain()->bounding_box().high, (Point{1, 1, 1, 4, 1, 1, 1}));
}

TEST(Mesh, RoundTripOverTheWholeSquareWithAllAttributes) {
    const MeshFile bumps(bumpy_sphere(12));
    for (const std::string attributes : {"position", "normal", "barycentric"}) {
        SCOPED_TRACE(attributes);
        expect_round_trip(*mapping(tetrahedron + ",attributes=" + attributes), 1e-14);
        expect_round_trip(*mapping(bumps.spec(",attributes=" + attributes)), 1e-12);
    }
}

TEST(Mesh, TrianglesWithoutAreaGetNoPoints) {
    const MeshFile file("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf 2 2 4\nf 1 1 1\n");
    const auto map = mapping(file.spec(",attributes=barycentric"));
    EXPECT_DOUBLE_EQ(map->domain()->measure(), 0.5);
    for (const double u : {0.0, 1e-300, 0.5, one_minus_ulp, 1.0})
        EXPECT_EQ(image_of(*map, {u, 0.5})[3], 1) << u;
}

// A triangle with 1e-9 of the area, between two others, gets its fraction of the unit interval.
TEST(Mesh, SharesOfTinyTrianglesAreExact) {
    const MeshFile file(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1e-9 0 5\nv 0 1 5\nv 0 0 5\nv 1 0 9\nv 0 1 9\nv 0 0 9\n"
        "f 1 2 3\nf 4 5 6\nf 7 8 9\n");
    const auto map = mapping(file.spec());
    const double share = 1 / (2 + 1e-9);
    EXPECT_EQ(image_of(*map, {share - 1e-12, 0.5})[2], 0);
    EXPECT_EQ(image_of(*map, {share + 1e-12, 0.5})[2], 5);
    EXPECT_EQ(image_of(*map, {share + 1e-9 * share - 1e-12, 0.5})[2], 5);
    EXPECT_EQ(image_of(*map, {share + 1e-9 * share + 1e-12, 0.5})[2], 9);
}

// 1000 triangles of 1e-17 of the area have 1e-14 of it together, though each alone vanishes when
// added to 1.
TEST(Mesh, ManyTrianglesTooSmallToAddHaveTheirShareTogether) {
    std::string text = "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 5\nv 2e-8 0 5\nv 0 1e-9 5\nf 1 2 3\n";
    for (int i = 0; i < 1000; ++i) text += "f 4 5 6\n";
    const MeshFile file(text);
    const auto map = mapping(file.spec());
    EXPECT_EQ(image_of(*map, {1 - 2e-14, 0.5})[2], 0);
    EXPECT_EQ(image_of(*map, {1 - 5e-15, 0.5})[2], 5);
}

TEST(Mesh, TheFarEdgeOfATriangleIsNotTheNextTriangle) {
    const auto map = mapping(tetrahedron + ",attributes=barycentric");
    for (const Point& end : {Point{0, 1, 0, 0, 0, 1, 0}, {0, 0, 1, 1, 0, 0, 1}}) {
        const Point again = image_of(*map, inverse_of(*map, end));
        expect_near(again, end, 1e-14);
    }
}

TEST(Mesh, DensityIsOneOverTheStretch) {
    const auto map = mapping(tetrahedron);
    for (const double u : {0.05, 0.2, 0.3, 0.5, 0.9})
        for (const double v : {0.1, 0.7})
            EXPECT_NEAR(stretch_at(*map, {u, v}), map->domain()->measure(), 1e-5) << u;
}

// Mean over the tetrahedron's surface, by symmetry the same for x, y, z: the faces 0, x, y; 0, x,
// z; x, y, z have mean x 1/3, and face 0, y, z has 0, so it is (1 + sqrt(3)/2) / 3 / (3/2 +
// sqrt(3)/2). Standard error of 1e5 points below 7.5e-4; 5 of them.
TEST(Mesh, MeansOfTheTetrahedron) {
    const PointSet image = warped(*mapping(tetrahedron), make("random", points(100'000, 2)));
    const double mean = (1 + std::sqrt(0.75)) / 3 / (1.5 + std::sqrt(0.75));
    for (std::size_t k = 0; k < 3; ++k) {
        double sum = 0;
        for (std::size_t i = 0; i < image.count(); ++i) sum += image[i][k];
        EXPECT_NEAR(sum / 1e5, mean, 3.75e-3) << k;
    }
}

// False alarm 1e-5 for each right one. Wrong: triangles chosen with equal probabilities.
TEST(Mesh, ChiSquareAcceptsItAndRejectsEqualChancesOfTriangles) {
    const MeshFile bumps(bumpy_sphere(12));
    EXPECT_GT(p_of_random(*mapping(bumps.spec()), 50'000), 1e-5);
    EXPECT_GT(p_of_random(*mapping(tetrahedron + ",attributes=normal"), 50'000), 1e-5);
    const double area = 1.5 + std::sqrt(0.75);
    PointSet cube = make("random", points(50'000, 2));
    for (std::size_t i = 0; i < cube.count(); ++i) {
        const double u = cube[i][0];
        cube[i][0] =
            std::min(u < 0.75 ? u * 2 / area : 1.5 / area + (u - 0.75) * 4 * (1 - 1.5 / area),
                     one_minus_ulp);
    }
    EXPECT_LT(measure("chi-square", "p_value", warped(*mapping(tetrahedron), cube)), 1e-100);
}

// Coincident or partly overlapping faces: the inverse assigns each its fraction of the points.
TEST(Mesh, ChiSquareAcceptsFacesUponEachOther) {
    const MeshFile file("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 3 1 2\nf 2 4 3\nf 1 2 4\n");
    EXPECT_GT(p_of_random(*mapping(file.spec()), 50'000), 1e-5);
}

TEST(Mesh, DomainKnowsWhatIsOnTheSurface) {
    const DomainPtr domain = mapping(tetrahedron)->domain();
    EXPECT_EQ(domain->spec(), tetrahedron);
    EXPECT_EQ(mapping(domain->spec())->domain()->spec(), tetrahedron);
    EXPECT_EQ(domain->bounding_box(), (Box{{0, 0, 0}, {1, 1, 1}}));
    EXPECT_TRUE(domain->contains(Point{0.5, 0, 0.5}));
    EXPECT_FALSE(domain->contains(Point{0.5, 1e-13, 0.5 - 2e-13}));
    EXPECT_FALSE(domain->contains(Point{-1e-13, 0, 0}));
    EXPECT_FALSE(domain->contains(Point{std::nan(""), 0, 0}));
    const DomainPtr normals = mapping(tetrahedron + ",attributes=normal")->domain();
    EXPECT_TRUE(normals->contains(Point{0, 0, 0.5, 0, -1, 0}));
    EXPECT_TRUE(normals->contains(Point{0, 0, 0.5, -1, 0, 0})) << "two faces meet there";
    EXPECT_FALSE(normals->contains(Point{0, 0, 0.5, 0, 1, 0}));
    const DomainPtr weights = mapping(tetrahedron + ",attributes=barycentric")->domain();
    EXPECT_TRUE(weights->contains(Point{0.25, 0.5, 0, 0, 0.25, 0.5, 0.25}));
    EXPECT_FALSE(weights->contains(Point{0.25, 0.5, 0, 1, 0.25, 0.5, 0.25}));
    EXPECT_FALSE(weights->contains(Point{0.25, 0.5, 0, 4, 0.25, 0.5, 0.25}));
    EXPECT_FALSE(weights->contains(Point{0.25, 0.5, 0, 0.5, 0.25, 0.5, 0.25}));
    EXPECT_EQ(error_of([&] {
                  inverse_of(*mapping(tetrahedron), {1, 1, 1});
              }),
              "input: the point (1, 1, 1) is outside the domain " + tetrahedron);
}

TEST(Mesh, RefusesFilesWithoutASurface) {
    EXPECT_EQ(error_of([] { mapping("mesh"); }),
              "usage: --file: no file given; expected a PLY or OBJ file with a triangle mesh");
    const MeshFile flat("v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n");
    EXPECT_EQ(error_of([&] { mapping(flat.spec()); }),
              "input: " + flat.path() + ": the mesh has no area");
    EXPECT_NE(error_of([] { mapping("mesh:file=/no/such.obj"); }).find("io: /no/such.obj"),
              std::string::npos);
}

// Squares of areas must neither vanish nor overflow.
TEST(Mesh, MayHaveAnySize) {
    for (const std::string s : {"1e-140", "1e-80", "1", "1e80", "1e140"}) {
        const MeshFile file(
            fmt::format("v 0 0 0\nv {0} 0 0\nv 0 {0} 0\nv {0} {0} {0}\nf 1 2 3\nf 2 3 4\n", s));
        const auto map = mapping(file.spec());
        const double size = std::stod(s);
        EXPECT_NEAR(map->domain()->measure() / size / size, 0.5 + std::sqrt(3) / 2, 1e-15) << s;
        EXPECT_NEAR(map->domain()->moments()->skewness[2], 1.0144337540012358, 1e-13) << s;
        for (const Point& u : {Point{0.2, 0.3}, {0.7, 0.9}}) {
            const Point back = inverse_of(*map, image_of(file.spec(), u));
            expect_near(back, u, 1e-14);
        }
    }
    const MeshFile tiny("v 0 0 0\nv 1e-155 0 0\nv 0 1e-155 0\nf 1 2 3\n");
    EXPECT_NE(error_of([&] { mapping(tiny.spec()); }).find("the mesh has an area of 5e-311"),
              std::string::npos);
}

}  // namespace stipple::testing::mesh_test
