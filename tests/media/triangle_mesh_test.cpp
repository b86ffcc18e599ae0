// SPDX-License-Identifier: MIT
#include "media/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/rng.hpp"
#include "places.hpp"
#include "support/units.hpp"

namespace stipple::testing::triangle_mesh_test {
namespace {

using Corners = std::vector<std::array<std::uint32_t, 3>>;

TriangleMesh obj(const std::string& text) { return parse_obj(text, "m.obj", {}); }
TriangleMesh ply(const std::string& text) { return parse_ply(text, "m.ply", {}); }
std::string obj_error(const std::string& text) {
    return error_of([&] { obj(text); });
}
std::string ply_error(const std::string& text) {
    return error_of([&] { ply(text); });
}

const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

const std::string ascii_head =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\n"
    "property float y\nproperty float z\nproperty uchar red\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n";
const std::string ascii_points = "0 0 0 9\n1 0 0 9\n1 1 0 9\n0 1 0 9\n";

/// Numbers in the representation of a binary file.
template <class T>
void put(std::string& bytes, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
}

std::string binary_square(double last = 1) {
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\n"
        "property float y\nproperty short z\nelement edge 1\nproperty list ushort double weight\n"
        "element face 1\nproperty uchar flag\nproperty list uint ushort vertex_index\nend_header\n";
    for (const auto& [x, y] : {std::pair{0.0, 0.0F}, {1.0, 0.0F}, {1.0, 1.0F}, {0.0, 1.0F}}) {
        put(bytes, y == 1 && x == 0 ? last - 1 : x);
        put(bytes, y);
        put(bytes, std::int16_t{-3});
    }
    put(bytes, std::uint16_t{2});
    put(bytes, 0.5);
    put(bytes, 0.25);
    put(bytes, std::uint8_t{7});
    put(bytes, std::uint32_t{4});
    for (std::uint16_t k = 0; k < 4; ++k) put(bytes, k);
    return bytes;
}

}  // namespace

TEST(TriangleMesh, ReadsObjWithAllThatItMaySay) {
    const TriangleMesh mesh = obj(
        "# a comment\nmtllib x.mtl\no thing\n" + three +
        "vn 0 0 1\nvt 0.5 0.5\nv 1.5 -2e-1 +3 1 0.5 0.5 0.5\ns off\nf 1/1 2/1/1 3//1 4\r\nf -3 -2 "
        "-1\nl 1 2\n");
    EXPECT_EQ(mesh.vertices.size(), 4U);
    EXPECT_EQ(mesh.vertices[3], (Vector3{1.5, -0.2, 3}));
    EXPECT_EQ(mesh.triangles, (Corners{{0, 1, 2}, {0, 2, 3}, {1, 2, 3}}));
    EXPECT_EQ(mesh.corners(0)[1], (Vector3{1, 0, 0}));
}

TEST(TriangleMesh, FacesOfAnObjMayComeBeforeTheirVertices) {
    EXPECT_EQ(obj("f 1 2 3\n" + three).triangles, obj(three + "f 1 2 3\n").triangles);
}

TEST(TriangleMesh, RefusesBadObjNamingThePlace) {
    EXPECT_EQ(obj_error(three + "f 1 2 4\n"),
              "input: m.obj:4:7: there is no vertex 4; the file has 3");
    EXPECT_NE(obj_error(three + "f 1 2 -4\n"), "");
    EXPECT_NE(obj_error(three + "f 0 1 2\n"), "");
    EXPECT_EQ(obj_error("f 1 2 3\nf 1 2 7\nf 2 3 5\n" + three),
              "input: m.obj:2:7: there is no vertex 7; the file has 3");
    EXPECT_EQ(obj_error("f -1 -2 -3\n" + three),
              "input: m.obj:1:3: there is no vertex -1; 0 are given before this line");
    EXPECT_EQ(obj_error(three + "f 1 2\n"),
              "input: m.obj:4:1: a face of 2 corners; at least 3 are needed");
    EXPECT_EQ(obj_error(three + "f 1 2 x\n"),
              "input: m.obj:4:7: 'x' is not a corner; expected the number of a vertex");
    EXPECT_EQ(obj_error("v 0 nan 0\n"),
              "input: m.obj:1:5: 'nan' is not a finite number; expected coordinate y");
    EXPECT_EQ(obj_error("v 0 1\nv 0 0 0\n"),
              "input: m.obj:1:6: the line ends here; expected coordinate z");
    EXPECT_EQ(obj_error("v 0 1 1e151\n"), "input: m.obj:1:7: '1e151' is outside [-1e150, 1e150]");
    EXPECT_EQ(obj_error(three), "input: m.obj: no faces; expected a PLY or OBJ mesh");
    EXPECT_NE(obj_error("x,y\n1,2\n"), "");
    EXPECT_NE(obj_error(""), "");
}

TEST(TriangleMesh, ReadsAsciiPly) {
    const TriangleMesh mesh = ply(ascii_head + ascii_points + "4 0 1 2 3\n");
    EXPECT_EQ(mesh.vertices[2], (Vector3{1, 1, 0}));
    EXPECT_EQ(mesh.triangles, (Corners{{0, 1, 2}, {0, 2, 3}}));
}

TEST(TriangleMesh, ReadsBinaryPlyOfAllTypes) {
    const TriangleMesh mesh = ply(binary_square());
    EXPECT_EQ(mesh.vertices[2], (Vector3{1, 1, -3}));
    EXPECT_EQ(mesh.vertices[3], (Vector3{0, 1, -3}));
    EXPECT_EQ(mesh.triangles, (Corners{{0, 1, 2}, {0, 2, 3}}));
}

TEST(TriangleMesh, RefusesBadPlyNamingThePlace) {
    EXPECT_EQ(ply_error(ascii_head + ascii_points + "3 0 1 4\n"),
              "input: m.ply:16:7: '4': there is no vertex 4, used in vertex_indices of face 1 of "
              "1; there are 4, from 0");
    EXPECT_NE(ply_error(ascii_head + ascii_points + "3 0 1 -1\n"), "");
    EXPECT_NE(ply_error(ascii_head + ascii_points + "3 0 1 1.5\n"), "");
    EXPECT_NE(ply_error(ascii_head + ascii_points + "2 0 1\n"), "");
    EXPECT_NE(ply_error(ascii_head + ascii_points + "-3 0 1\n"), "");
    EXPECT_EQ(ply_error(ascii_head + "0 0 inf 9\n"),
              "input: m.ply:12:5: 'inf': not a finite number; expected z of vertex 1 of 4");
    EXPECT_EQ(ply_error(ascii_head + "0 0 0 9\n1 0\n"),
              "input: m.ply:14:1: the file ends here; expected z of vertex 2 of 4");
    EXPECT_EQ(
        ply_error(ascii_head + ascii_points + "3 0 1 2\n7\n"),
        "input: m.ply:17:1: '7': more than the header announces; expected the end of the file");
    EXPECT_EQ(ply_error("ply\nformat binary_big_endian 1.0\nend_header\n"),
              "input: m.ply:2:8: format 'binary_big_endian' is not read; expected ascii or "
              "binary_little_endian");
    EXPECT_EQ(
        ply_error("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n"),
        "input: m.ply: no property y of element vertex in the header");
    EXPECT_EQ(ply_error("ply\nformat ascii 1.0\n"),
              "input: m.ply: no line end_header; the header is cut off");
    EXPECT_NE(ply_error("ply\nformat ascii 1.0\nproperty float x\nend_header\n"), "");
    EXPECT_NE(ply_error("ply\nformat ascii 1.0\nelement vertex -1\nend_header\n"), "");
}

TEST(TriangleMesh, EveryCutOfABinaryPlyIsRefusedNamingAByte) {
    const std::string whole = binary_square();
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_NE(ply_error(whole.substr(0, size)), "") << size;
    EXPECT_EQ(
        ply_error(whole.substr(0, whole.size() - 1)),
        fmt::format("input: m.ply: byte {}: the file ends here; expected vertex_index of face "
                    "1 of 1",
                    whole.size()));
    EXPECT_NE(ply_error(whole + "x"), "");
    const std::string error = ply_error(binary_square(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_NE(error.find("x of vertex 4 of 4 is nan"), std::string::npos) << error;
}

/// Twice the signed area of the triangles in the plane z = 0.
double twice_area(const TriangleMesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto [a, b, c] = mesh.corners(i);
        sum += cross(minus(b, a), minus(c, a))[2];
    }
    return sum;
}

// The polygon (0,2) (1,.2) (2,2) (2,0) (0,0) has area 4 - 1.8; a fan from its first corner has
// more. Triangles have the orientation of their polygon.
TEST(TriangleMesh, TriangulatesFacesThatAreNotConvex) {
    const std::string notch = "v 0 2 0\nv 1 0.2 0\nv 2 2 0\nv 2 0 0\nv 0 0 0\n";
    const TriangleMesh one = obj(notch + "f 1 2 3 4 5\n");
    EXPECT_EQ(one.triangles.size(), 3U);
    EXPECT_NEAR(twice_area(one), -2 * 2.2, 1e-15);
    EXPECT_NEAR(twice_area(obj(notch + "f 5 4 3 2 1\n")), 2 * 2.2, 1e-15);
    for (std::size_t i = 0; i < one.triangles.size(); ++i) {
        const auto [a, b, c] = one.corners(i);
        EXPECT_LE(cross(minus(b, a), minus(c, a))[2], 0);
    }
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const TriangleMesh arrow = ply(head + "0 0 0\n4 0 0\n1 1 0\n0 4 0\n4 1 2 3 0\n");
    EXPECT_NEAR(twice_area(arrow), 8, 1e-15);
    EXPECT_EQ(arrow.triangles.size(), 2U);
}

// Combs with integer corners in arbitrary planes in space; the shoelace formula gives their area.
TEST(TriangleMesh, TrianglesOfAPolygonHaveItsArea) {
    const Rng rng(4);
    for (std::uint64_t teeth = 1; teeth <= 30; ++teeth) {
        std::string vertices = "v 0 0 0\n";
        std::string face = "f 1";
        double twice = 0;
        double x = 0;
        double y = 0;
        const auto add = [&](double to_x, double to_y) {
            twice += x * to_y - to_x * y;
            x = to_x;
            y = to_y;
            vertices += fmt::format("v {} {} {}\n", x, y, 2 * x - 3 * y);
            face += fmt::format(" {}", 1 + std::ranges::count(vertices, 'v') - 1);
        };
        add(static_cast<double>(2 * teeth), 0);
        for (std::uint64_t k = 2 * teeth; k-- > 0;)
            add(static_cast<double>(k),
                static_cast<double>(k % 2 == 0 ? 1 : 2) + static_cast<double>(rng.below(k, 9)));
        EXPECT_NEAR(twice_area(obj(vertices + face + "\n")), twice, 1e-9) << teeth;
    }
}

TEST(TriangleMesh, RefusesPolygonsThatAreNotSimple) {
    const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    EXPECT_EQ(obj_error(square + "f 1 2 3 4\nf 1 3 2 4\n"),
              "input: m.obj: face 2: edges of its 4 corners cross or touch; a simple polygon is "
              "needed");
    EXPECT_NE(obj_error(square + "v 0.5 0 0\nf 1 2 3 5 4\n"), "") << "touches an edge";
    EXPECT_EQ(obj(square + "f 1 1 2 3\n").triangles.size(), 2U) << "one of them without area";
    std::vector<std::string> notes;
    RunContext run;
    run.warn = [&](const std::string& note) { notes.push_back(note); };
    parse_obj(square + "v 0 1 1\nf 1 2 3 4\nf 1 2 3 5\n", "m.obj", run);
    EXPECT_EQ(notes,
              std::vector<std::string>{"m.obj: 1 of 2 faces are not flat, the first is face 2; "
                                       "they are replaced by triangles between their corners"});
}

TEST(TriangleMesh, ReadMeshTellsKindsByTheirFirstLine) {
    EXPECT_EQ(read_mesh(STIPPLE_SOURCE_DIR "/tests/support/tetrahedron.obj", {}).triangles.size(),
              4U);
    EXPECT_NE(error_of([] { read_mesh("/no/such/file.ply", {}); }).find("io: "), std::string::npos);
}

}  // namespace stipple::testing::triangle_mesh_test
