// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/planar.hpp"
#include "support/temporary_file.hpp"

namespace stipple::testing::polygon_test {
namespace {

using Corners = std::vector<std::pair<double, double>>;

const char* frame = "polygon:vertices=[0,0 4,0 4,4 0,4 / 1,1 3,1 3,3 1,3]";
const char* peak = "polygon:vertices=[0,0 2,0 1,1]";
const char* apart = "polygon:vertices=[0,0 1,0 1,1 0,1 / 3,0 4,0 4,1 3,1]";
const char* island = "polygon:vertices=[0,0 6,0 6,6 0,6 / 1,1 1,5 5,5 5,1 / 2,2 4,2 4,4 2,4]";
const char* zigzag = "polygon:vertices=[0,0 5,1 9,-2 8,4 6,2.5 5,6 3,3 1,7 0.5,3]";

std::string error(std::string_view spec) {
    return error_of([&] { mapping(spec); });
}

/// A star around (2, -1), with a corner in each of n directions, so that edges do not intersect.
Corners star(std::uint64_t seed, int n) {
    const Rng rng(seed);
    Corners corners;
    for (int k = 0; k < n; ++k) {
        const double r = 0.2 + rng.uniform(static_cast<std::uint64_t>(k));
        const double angle = 2 * std::numbers::pi * k / n;
        corners.emplace_back(2 + r * std::cos(angle), -1 + r * std::sin(angle));
    }
    return corners;
}

std::string text_of(const Corners& corners) {
    std::string text;
    for (const auto& [x, y] : corners)
        text += fmt::format("{}{},{}", text.empty() ? "" : " ", x, y);
    return text;
}

/// Oracle: the shoelace formula.
double shoelace(const Corners& p) {
    double twice = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto& [x, y] = p[i];
        const auto& [x1, y1] = p[(i + 1) % p.size()];
        twice += x * y1 - x1 * y;
    }
    return 0.5 * twice;
}

/// Oracle: the part of the polygon below a row, clipped edge by edge.
Corners below(const Corners& p, double row) {
    Corners kept;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto& [x, y] = p[i];
        const auto& [x1, y1] = p[(i + 1) % p.size()];
        if (y <= row) kept.emplace_back(x, y);
        if ((y < row && y1 > row) || (y > row && y1 < row))
            kept.emplace_back(x + (x1 - x) * (row - y) / (y1 - y), row);
    }
    return kept;
}

/// Oracle: whether a ray to the right crosses an odd number of edges.
bool inside(const Corners& p, double px, double py) {
    bool odd = false;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto& [x, y] = p[i];
        const auto& [x1, y1] = p[(i + 1) % p.size()];
        if ((y > py) != (y1 > py) && px < x + (x1 - x) * (py - y) / (y1 - y)) odd = !odd;
    }
    return odd;
}

}  // namespace

// The lower two thirds of the L are a 2 x 1 box, the upper third is the 1 x 1 box on its left.
TEST(Polygon, PointsByHand) {
    EXPECT_EQ(image_of("polygon", {0, 0}), (std::vector{0.0, 0.0}));
    EXPECT_EQ(image_of("polygon", {1. / 3, 0.25}), (std::vector{0.5, 0.5}));
    EXPECT_DOUBLE_EQ(image_of("polygon", {5. / 6, 0.25})[0], 0.25);
    EXPECT_DOUBLE_EQ(image_of("polygon", {5. / 6, 0.25})[1], 1.5);
    EXPECT_EQ(image_of("polygon", {1, 1}), (std::vector{1.0, 2.0}));
    // The area below y is 1 - (1 - y)^2.
    EXPECT_EQ(image_of(peak, {0.75, 0.5}), (std::vector{1.0, 0.5}));
    EXPECT_EQ(image_of(peak, {0.4375, 0}), (std::vector{0.25, 0.25}));
    EXPECT_EQ(image_of(peak, {1, 0.3}), (std::vector{1.0, 1.0}));
}

TEST(Polygon, RowsLeaveOutHolesAndGaps) {
    EXPECT_EQ(image_of(frame, {0.5, 0.25}), (std::vector{0.5, 2.0}));
    EXPECT_EQ(image_of(frame, {0.5, 0.75}), (std::vector{3.5, 2.0}));
    EXPECT_EQ(image_of(apart, {0.5, 0.25}), (std::vector{0.5, 0.5}));
    EXPECT_EQ(image_of(apart, {0.5, 0.75}), (std::vector{3.5, 0.5}));
    const auto middle = mapping(island);  // 6 - 4 + 2 along the row y = 3
    EXPECT_EQ(image_of(*middle, {0.5, 0.5}), (std::vector{3.0, 3.0}));
    EXPECT_EQ(image_of(*middle, {0.5, 0.125}), (std::vector{0.5, 3.0}));
}

TEST(Polygon, RoundTripOverTheWholeSquare) {
    for (const char* spec : {"polygon", frame, peak, apart, island, zigzag}) {
        SCOPED_TRACE(spec);
        expect_round_trip(*mapping(spec), 1e-13);
        expect_stands_hostile_points(*mapping(spec), 1e-13, 20'000);
    }
    expect_round_trip(*mapping("polygon:vertices=[0,0 1e140,0 0,1e140]"), 1e127);
    expect_round_trip(*mapping("polygon:vertices=[0,0 1e-130,0 0,1e-130]"), 1e-143);
    expect_unit_coordinates_back(*mapping("polygon"), 1e-14);
    expect_unit_coordinates_back(*mapping(island), 1e-14);
}

// The edge of the L at y = 1 belongs only to its lower part.
TEST(Polygon, PointsOnLevelEdgesComeBack) {
    const auto map = mapping("polygon");
    const auto upside_down = mapping("polygon:vertices=[0,0 1,0 1,1 2,1 2,2 0,2]");
    for (const auto& [u, v] : {std::pair{2. / 3, 0.75}, {2. / 3, 1.0}}) {
        const auto back = inverse_of(*map, {2 * v, 1});
        EXPECT_NEAR(back[0], u, 1e-15);
        EXPECT_NEAR(back[1], v, 1e-15);
        EXPECT_EQ(image_of(*map, {back[0], back[1]})[0], 2 * v) << "not on the short row above";
        EXPECT_NEAR(inverse_of(*upside_down, {2 * v, 1})[0], 1 - u, 1e-15);
    }
    EXPECT_EQ(inverse_of(*mapping(peak), {1, 1}), (std::vector{1.0, 0.0})) << "the tip";
}

// Parts of a row include their left ends; the inverse of a right end is just below it.
TEST(Polygon, EndsOfPartsComeBack) {
    for (const char* spec : {frame, apart}) {
        const auto map = mapping(spec);
        for (const double x : {1.0, 3.0}) {
            const auto back = inverse_of(*map, {x, spec == frame ? 1.5 : 0.5});
            EXPECT_NEAR(back[1], 0.5, 1e-15);
            EXPECT_NEAR(image_of(*map, {back[0], back[1]})[0], x, 1e-15) << spec;
        }
    }
}

TEST(Polygon, InsideIsWhatAnOddNumberOfRingsSurrounds) {
    EXPECT_DOUBLE_EQ(mapping(frame)->domain()->measure(), 12);
    EXPECT_DOUBLE_EQ(mapping(apart)->domain()->measure(), 2);
    EXPECT_DOUBLE_EQ(mapping(island)->domain()->measure(), 36 - 16 + 4);
    const DomainPtr domain = mapping(island)->domain();
    for (const auto& p : {std::vector{0.5, 3.0}, {3.0, 3.0}, {1.0, 3.0}, {2.0, 2.0}, {6.0, 6.0}})
        EXPECT_TRUE(domain->contains(p)) << p[0];
    for (const auto& p : {std::vector{1.5, 3.0}, {4.5, 4.5}, {-0.1, 3.0}, {3.0, 6.1}, {NAN, 3.0}})
        EXPECT_FALSE(domain->contains(p)) << p[0];
    EXPECT_TRUE(domain->contains(std::vector{3.0, 6.0 + 1e-15}));
    EXPECT_FALSE(domain->contains(std::vector{3.0, 6.0 + 1e-12}));
    EXPECT_FALSE(domain->contains(std::vector{1.0 + 1e-12, 3.0}));
}

// Stars with up to 60 corners, compared with simple oracles.
TEST(Polygon, AreasAndMembershipAreThoseOfTheOracles) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Corners corners = star(seed, 3 + static_cast<int>(3 * seed - 3));
        const DomainPtr domain =
            mapping(fmt::format("polygon:vertices=[{}]", text_of(corners)))->domain();
        EXPECT_NEAR(domain->measure(), shoelace(corners), 1e-14) << "seed " << seed;
        const Box box = domain->bounding_box();
        const PointSet cloud = make("random", points(500, 2), {}, {.seed = seed});
        std::vector<double> cube(2);
        for (std::size_t i = 0; i < cloud.count(); ++i) {
            const std::vector<double> p = {box.low[0] + cloud[i][0] * box.extent(0),
                                           box.low[1] + cloud[i][1] * box.extent(1)};
            ASSERT_EQ(domain->contains(p), inside(corners, p[0], p[1])) << p[0] << ", " << p[1];
            if (!domain->contains(p)) continue;
            domain->to_cube(p, cube);
            ASSERT_NEAR(cube[0], shoelace(below(corners, p[1])) / shoelace(corners), 1e-13);
        }
    }
}

TEST(Polygon, OrientationAndRepeatedCornersDoNotMatter) {
    const PointSet cube = telling_points();
    const PointSet image = warped(*mapping("polygon"), cube);
    for (const char* spec : {"polygon:vertices=[0,2 1,2 1,1 2,1 2,0 0,0]",
                             "polygon:vertices=[0,0 2,0 2,0 2,1 1,1 1,2 0,2 0,0]",
                             "polygon:vertices=[0,0 1,0 2,0 2,1 1,1 1,2 0,2]"})
        EXPECT_TRUE(std::ranges::equal(warped(*mapping(spec), cube).flat(), image.flat())) << spec;
}

TEST(Polygon, DensityIsOneOverTheArea) {
    for (const char* spec : {"polygon", peak, zigzag})
        expect_density_is_one_over_jacobian(*mapping(spec));
    for (const char* spec : {"polygon", frame, peak, apart, island, zigzag})
        expect_measure_is_share_of_box(*mapping(spec)->domain());
    EXPECT_EQ(mapping(frame)->density(std::vector{2.0, 2.0}), 0) << "in the hole";
}

TEST(Polygon, IsUniformByArea) {
    for (const char* spec : {"polygon", frame, zigzag}) expect_chi_square_can_tell(*mapping(spec));
    // The frame's second moment: (16 (16/12) - 4 (4/12)) / 12 = 5/3.
    const PlaneMoments m = plane_moments(*mapping(frame));
    EXPECT_NEAR(m.x, 2, 0.0205);
    EXPECT_NEAR(m.y, 2, 0.0205);
    EXPECT_NEAR(m.xx, 5. / 3, 0.018);
    EXPECT_NEAR(m.yy, 5. / 3, 0.018);
    EXPECT_NEAR(m.xy, 0, 0.02);
}

TEST(Polygon, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("polygon")->domain()->spec(), "polygon");
    for (const char* spec : {frame, island, zigzag}) {
        EXPECT_EQ(mapping(spec)->domain()->spec(), spec);
        EXPECT_EQ(mapping(mapping(spec)->domain()->spec())->domain()->measure(),
                  mapping(spec)->domain()->measure());
    }
    EXPECT_EQ(mapping(zigzag)->domain()->bounding_box(), (Box{{0, -2}, {9, 7}}));
}

TEST(Polygon, RefusesCrossingsAndNamesThem) {
    EXPECT_EQ(error("polygon:vertices=[0,0 1,1 1,0 0,1]"),
              "usage: --vertices: edge 1 (0,0 to 1,1) and edge 3 (1,0 to 0,1) cross; edges may "
              "meet only at a shared vertex");
    EXPECT_EQ(error("polygon:vertices=[0,0 4,0 4,4 0,4 / 3,1 5,1 5,2 3,2]"),
              "usage: --vertices: edge 2 of ring 1 (4,0 to 4,4) and edge 1 of ring 2 (3,1 to 5,1) "
              "cross; edges may meet only at a shared vertex");
    EXPECT_NE(error("polygon:vertices=[0,0 4,0 4,4 0,4 / 2,0 3,0 2,1]"), "") << "along an edge";
    EXPECT_NE(error("polygon:vertices=[0,0 4,0 4,4 0,4 / 4,4 5,2 3,2]"), "") << "in a corner";
    EXPECT_NE(error("polygon:vertices=[0,0 2,0 2,1 / 0,0 2,0 2,1]"), "") << "twice the same";
    EXPECT_NE(error("polygon:vertices=[0,0 2,0 1,1 2,2 0,2 1,1]"), "") << "touches itself";
    EXPECT_EQ(error("polygon:vertices=[0,0 2,0 2,2 2,3 2,2 0,2]"),
              "usage: --vertices: edge 2 (2,0 to 2,2) and edge 4 (2,3 to 2,2) touch; edges may "
              "meet only at a shared vertex")
        << "a spike";
}

TEST(Polygon, RingsMayTouchInPoints) {
    const char* on_edge = "polygon:vertices=[0,0 4,0 4,4 0,4 / 2,0 3,1 2,1]";
    const char* on_corner = "polygon:vertices=[0,0 4,0 4,4 0,4 / 4,4 5,4 5,5]";
    const char* slanted = "polygon:vertices=[0,0 3,1 3,3 0,3 / 1,0.3333333333333333 2,2 1,2]";
    EXPECT_DOUBLE_EQ(mapping(on_edge)->domain()->measure(), 15.5);
    EXPECT_DOUBLE_EQ(mapping(on_corner)->domain()->measure(), 16.5);
    EXPECT_NEAR(mapping(slanted)->domain()->measure(), 7.5 - 5. / 6, 1e-14);
    for (const char* spec : {on_edge, on_corner, slanted}) {
        expect_round_trip(*mapping(spec), 1e-13);
        expect_chi_square_can_tell(*mapping(spec));
    }
}

// Teeth of different heights: rows cross thousands of them, and there are as many rows.
TEST(Polygon, ManyVerticesAreQuick) {
    const Rng rng(1);
    Corners comb;
    const int teeth = 3000;
    for (int k = 0; k < teeth; ++k) {
        const double height = 1 + rng.uniform(static_cast<std::uint64_t>(k));
        comb.insert(comb.end(), {{k, 0.5}, {k + 0.25, height}, {k + 0.75, height}});
    }
    comb.insert(comb.end(), {{teeth, 0.5}, {teeth, 0}, {0, 0}});
    const auto map = mapping(fmt::format("polygon:vertices=[{}]", text_of(comb)));
    EXPECT_NEAR(map->domain()->measure(), std::abs(shoelace(comb)), 1e-9);
    const PointSet cube = make("random", points(2000, 2));
    const PointSet image = warped(*map, cube);
    std::vector<double> back(2);
    for (std::size_t i = 0; i < image.count(); ++i) {
        ASSERT_TRUE(inside(comb, image[i][0], image[i][1])) << i;
        map->domain()->to_cube(image[i], back);
        ASSERT_NEAR(back[0], cube[i][0], 1e-12);
        ASSERT_NEAR(back[1], cube[i][1], 1e-12);
    }
}

TEST(Polygon, RefusesWhatHasNoArea) {
    EXPECT_NE(error("polygon:vertices=[0,0 1,1 2,2]"), "");
    EXPECT_NE(error("polygon:vertices=[0,0 1,0 2,0]"), "");
    EXPECT_EQ(error("polygon:vertices=[0,0 1,0 0,1e-17]"),
              "usage: --vertices: the area of the polygon is 0 or lost in rounding");
    EXPECT_EQ(error("polygon:vertices=[0,0 1,1]"),
              "usage: --vertices: ring 1 has 2 different vertices; expected at least 3");
    EXPECT_NE(error("polygon:vertices=[1,1 1,1 1,1]"), "");
    EXPECT_EQ(error("polygon:vertices=[0,0 1,0 0,1 /]"),
              "usage: --vertices: ring 2 has 0 different vertices; expected at least 3");
    EXPECT_EQ(error("polygon:vertices=[0,0 1,0 0,x]"),
              "usage: --vertices: '0,x' is not a point x,y");
    EXPECT_NE(error("polygon:vertices=[0,0 1,0 0]"), "");
    EXPECT_EQ(error("polygon:vertices=[0,0 1e200,0 0,1]"),
              "usage: --vertices: the vertex 1e+200,0 is outside [-1e150, 1e150]");
}

TEST(PolygonFile, HoldsRingsBetweenBlankLinesOrComments) {
    const std::string rings = "# a frame\nx,y\n0,0\n4,0\n4,4\n0,4\n";
    const std::string hole = "1,1\n3, 1 # right\n3,3\n1,3\n1,1\n";
    const PointSet cube = telling_points();
    const PointSet expected = warped(*mapping(frame), cube);
    for (const std::string between : {"\n", "# the hole\n", "\n\n#\n"}) {
        const TemporaryFile both(rings + between + hole);
        const auto map = mapping("polygon:file=" + both.path());
        EXPECT_TRUE(std::ranges::equal(warped(*map, cube).flat(), expected.flat())) << between;
    }
    const TemporaryFile one(rings);
    const std::string spec = "polygon:file=" + one.path();
    EXPECT_EQ(mapping(spec)->domain()->spec(), spec);
}

TEST(PolygonFile, ComplainsByItsName) {
    const auto complaint = [&](const std::string& text) {
        const TemporaryFile file(text);
        const std::string& path = file.path();
        const std::string what = error("polygon:file=" + path);
        EXPECT_EQ(what.find("input: " + path + ":"), 0U) << what;
        return what.substr(std::min(what.size(), path.size() + 7));
    };
    EXPECT_EQ(complaint("0,0\n1,1\n1,0\n0,1\n"),
              ": edge 1 (0,0 to 1,1) and edge 3 (1,0 to 0,1) cross; edges may meet only at a "
              "shared vertex");
    EXPECT_EQ(complaint("0,0,0\n1,0,0\n0,1,0\n"), ": 3 coordinates on a line; expected 2, x,y");
    EXPECT_EQ(complaint("0,0\n1,0\n0,one\n"),
              ":3:3: 'one' is not a number; expected one such as 0.5 or 1e-3");
    EXPECT_EQ(complaint("0,0\n1,0\n"), ": ring 1 has 2 different vertices; expected at least 3");
    EXPECT_EQ(error("polygon:file=/nowhere/at/all.csv").substr(0, 4), "io: ");
    EXPECT_EQ(error("polygon:vertices=[0,0 1,0 0,1],file=a.csv"),
              "usage: --file: cannot be combined with --vertices; give one of them");
}

}  // namespace stipple::testing::polygon_test
