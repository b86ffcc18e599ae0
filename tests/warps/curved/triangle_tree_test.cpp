// SPDX-License-Identifier: MIT
#include "warps/curved/triangle_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/rng.hpp"

namespace stipple::testing::triangle_tree_test {
namespace {

/// Triangles with random corners in the unit cube.
TriangleMesh random_triangles(std::uint32_t count) {
    TriangleMesh mesh;
    const Rng rng(5);
    for (std::uint32_t i = 0; i < 3 * count; ++i)
        mesh.vertices.push_back(
            {rng.uniform(3 * i), rng.uniform(3 * i + 1), rng.uniform(3 * i + 2)});
    for (std::uint32_t i = 0; i < count; ++i)
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    return mesh;
}

}  // namespace

TEST(TriangleTree, FootByHand) {
    const std::array<Vector3, 3> corners = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
    const Foot inside = foot_on(corners, {1, 1, 2});
    EXPECT_EQ(inside.weights, (std::array{0.5, 0.25, 0.25}));
    EXPECT_EQ(inside.distance, 2);
    const Foot edge = foot_on(corners, {1, -3, 4});
    EXPECT_EQ(edge.weights, (std::array{0.75, 0.25, 0.0}));
    EXPECT_EQ(edge.distance, 5);
    const Foot corner = foot_on(corners, {7, -4, 0});
    EXPECT_EQ(corner.weights, (std::array{0.0, 1.0, 0.0}));
    EXPECT_EQ(corner.distance, 5);
    const std::array<Vector3, 3> flat = {{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}}};
    EXPECT_EQ(foot_on(flat, {1, 3, 0}).distance, 3);
    const std::array<Vector3, 3> dot = {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}};
    EXPECT_EQ(foot_on(dot, {1, 1, 3}).distance, 2);
}

// Oracle: all triangles, one after the other.
TEST(TriangleTree, VisitsWhatASearchThroughAllFinds) {
    const TriangleMesh mesh = random_triangles(700);
    const TriangleTree tree(mesh, {});
    const Rng rng(6);
    std::size_t hits = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
        const Vector3 point = {rng.uniform(3 * i), rng.uniform(3 * i + 1), rng.uniform(3 * i + 2)};
        for (const double reach : {0.001, 0.01, 0.1}) {
            std::set<std::uint32_t> near, seen;
            for (std::uint32_t t = 0; t < 700; ++t)
                if (foot_on(mesh.corners(t), point).distance <= reach) near.insert(t);
            tree.visit(point, reach, [&](std::uint32_t t, const Foot& foot) {
                EXPECT_EQ(foot.distance, foot_on(mesh.corners(t), point).distance);
                EXPECT_TRUE(seen.insert(t).second) << "twice";
            });
            ASSERT_EQ(seen, near);
            hits += near.size();
        }
    }
    EXPECT_GT(hits, 1000U);
}

TEST(TriangleTree, ManyTrianglesInOnePlaceAreAllVisited) {
    TriangleMesh mesh = random_triangles(99);
    for (auto& triangle : mesh.triangles) triangle = {0, 1, 2};
    const TriangleTree tree(mesh, {});
    const auto count = [&](const Vector3& point) {
        int visits = 0;
        tree.visit(point, 1e-9, [&](std::uint32_t, const Foot&) { ++visits; });
        return visits;
    };
    EXPECT_EQ(count(mesh.vertices[0]), 99);
    EXPECT_EQ(count({2, 2, 2}), 0);
    EXPECT_EQ(count({std::nan(""), 0, 0}), 0);
}

}  // namespace stipple::testing::triangle_tree_test
