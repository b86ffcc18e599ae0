// SPDX-License-Identifier: MIT
#include "math/neighbors/delaunay.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/rng.hpp"

namespace stipple::testing::delaunay_test {
namespace {

using Edges = std::set<std::pair<std::size_t, std::size_t>>;

Edges edges_of(const Delaunay& triangles, std::size_t n) {
    Edges edges;
    for (std::size_t i = 0; i < n; ++i)
        triangles.for_neighbors(i, [&](std::size_t j) { edges.insert(std::minmax(i, j)); });
    return edges;
}

}  // namespace

// c differs from the line through a and b by one unit in the last place.
TEST(Delaunay, SidesOfLinesAreExact) {
    const double a[] = {0.5, 0.5}, b[] = {12, 12};
    const double up = std::nextafter(24.0, 25.0);
    const double on[] = {24, 24}, left[] = {24, up}, right[] = {up, 24};
    EXPECT_EQ(side_of_line(a, b, on), 0);
    EXPECT_EQ(side_of_line(a, b, left), 1);
    EXPECT_EQ(side_of_line(a, b, right), -1);
    const double tiny = 1e-300;
    const double o[] = {0, 0}, p[] = {tiny, tiny}, q[] = {3 * tiny, std::nextafter(3 * tiny, 1.0)};
    EXPECT_EQ(side_of_line(o, p, q), 1);
    EXPECT_EQ(side_of_line(o, q, p), -1);
}

// Two points are joined by an edge exactly if some circle through them contains no other point.
TEST(Delaunay, JoinsThoseWithAnEmptyCircle) {
    constexpr std::size_t n = 60;
    std::vector<double> rows(2 * n);
    Rng(3).fill(0, rows);
    const Delaunay triangles(rows, {});
    Edges expected;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) {
            // Centres of circles through both are m + t w; each other point bounds t on one side.
            const double mx = (rows[2 * i] + rows[2 * j]) / 2,
                         my = (rows[2 * i + 1] + rows[2 * j + 1]) / 2;
            const double wx = rows[2 * i + 1] - rows[2 * j + 1], wy = rows[2 * j] - rows[2 * i];
            const double own = std::pow(rows[2 * i] - mx, 2) + std::pow(rows[2 * i + 1] - my, 2);
            double low = -INFINITY, high = INFINITY;
            for (std::size_t k = 0; k < n; ++k) {
                if (k == i || k == j) continue;
                const double x = rows[2 * k] - mx, y = rows[2 * k + 1] - my;
                const double along = x * wx + y * wy;
                const double bound = (x * x + y * y - own) / (2 * along);
                (along > 0 ? high : low) = along > 0 ? std::min(high, bound) : std::max(low, bound);
            }
            if (low < high) expected.insert({i, j});
        }
    EXPECT_EQ(edges_of(triangles, n), expected);
}

// With h points on the hull there are 3 n - 3 - h edges: no triangle is missing, for any
// arrangement.
TEST(Delaunay, TriangulatesLatticesLinesAndRepeatedPoints) {
    std::vector<double> lattice, line;
    for (int i = 0; i < 400; ++i) {
        lattice.insert(lattice.end(), {static_cast<double>(i % 20), static_cast<double>(i / 20)});
        line.insert(line.end(), {i * 3.0, i * 7.0});
    }
    EXPECT_EQ(edges_of(Delaunay(lattice, {}), 400).size(), 3U * 400 - 3 - 76);
    EXPECT_EQ(edges_of(Delaunay(line, {}), 400).size(), 399U);
    const std::vector<double> same(20, 0.25);
    EXPECT_TRUE(edges_of(Delaunay(same, {}), 10).empty());
}

}  // namespace stipple::testing::delaunay_test
