// SPDX-License-Identifier: MIT
#include "math/geometry/polygon_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/rng.hpp"

namespace stipple::testing::polygon_contact_test {
namespace {

struct Cell {
    long x;
    long y;
};

long twice_area(Cell a, Cell b, Cell c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool on_segment(Cell a, Cell b, Cell c) {
    return twice_area(a, b, c) == 0 && c.x >= std::min(a.x, b.x) && c.x <= std::max(a.x, b.x) &&
           c.y >= std::min(a.y, b.y) && c.y <= std::max(a.y, b.y);
}

/// Oracle, in integers: whether the closed segments a b and c d have a common point.
bool share_a_point(Cell a, Cell b, Cell c, Cell d) {
    const auto sign = [](long v) { return (v > 0) - (v < 0); };
    const bool proper = sign(twice_area(a, b, c)) * sign(twice_area(a, b, d)) < 0 &&
                        sign(twice_area(c, d, a)) * sign(twice_area(c, d, b)) < 0;
    return proper || on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) ||
           on_segment(c, d, b);
}

/// Oracle: all pairs of edges of one ring; neighbours may only share their corner.
bool ring_meets_itself(const std::vector<Cell>& p) {
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) {
            const Cell a = p[i], b = p[(i + 1) % n], c = p[j], d = p[(j + 1) % n];
            if (j == i + 1) {
                if (on_segment(a, b, d) || on_segment(b, d, a)) return true;
            } else if (i == 0 && j + 1 == n) {
                if (on_segment(a, b, c) || on_segment(c, d, b)) return true;
            } else if (share_a_point(a, b, c, d)) {
                return true;
            }
        }
    return false;
}

}  // namespace

// Rings of 3 to 7 corners on a 6 x 6 grid: all kinds of contacts and overlaps occur.
TEST(PolygonContact, AgreesWithWholeNumbersOnRandomRings) {
    const Rng rng(3);
    std::uint64_t draw = 0;
    int met = 0;
    for (int trial = 0; trial < 20'000; ++trial) {
        std::vector<Cell> cells;
        const auto n = 3 + rng.below(draw++, 5);
        while (cells.size() < n) {
            const Cell cell{static_cast<long>(rng.below(draw, 6)),
                            static_cast<long>(rng.below(draw + 1, 6))};
            draw += 2;
            const bool last = cells.size() + 1 == n;
            const auto same = [&](const Cell& c) { return c.x == cell.x && c.y == cell.y; };
            if (!cells.empty() && (same(cells.back()) || (last && same(cells.front())))) continue;
            cells.push_back(cell);
        }
        Ring ring;
        for (const Cell& c : cells)
            ring.push_back({0.125 * static_cast<double>(c.x), 100 + static_cast<double>(c.y)});
        const bool expected = ring_meets_itself(cells);
        met += expected;
        ASSERT_EQ(find_contact({ring}, {}).has_value(), expected) << "trial " << trial;
    }
    EXPECT_GT(met, 5000);
    EXPECT_LT(met, 19'000);
}

TEST(PolygonContact, NamesBothEdgesAndTellsCrossingFromTouching) {
    const Ring square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    const auto crossing = find_contact({square, {{3, 1}, {5, 1}, {5, 2}, {3.5, 2}}}, {});
    ASSERT_TRUE(crossing);
    EXPECT_TRUE(crossing->crossing);
    EXPECT_EQ(crossing->first, (RingEdge{0, 1}));
    EXPECT_EQ(crossing->second, (RingEdge{1, 0}));
    const auto touching = find_contact({square, {{2, 0}, {3, 0}, {2, 2}}}, {});
    ASSERT_TRUE(touching) << "along an edge";
    EXPECT_FALSE(touching->crossing);
    EXPECT_EQ(touching->first, (RingEdge{0, 0}));
    EXPECT_FALSE(find_contact({square, {{1, 1}, {2, 1}, {2, 2}}, {{5, 0}, {6, 0}, {6, 5}}}, {}));
}

// As in the simple features of the OGC: rings may touch or cross where both have a vertex.
TEST(PolygonContact, TwoRingsMayTouchInPoints) {
    const Ring square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    for (const Ring& other : {Ring{{2, 0}, {3, 1}, {2, 2}}, Ring{{4, 4}, {5, 4}, {5, 5}},
                              Ring{{0, 0}, {2, 1}, {4, 2}, {1, 3}}, Ring{{2, 0}, {4, 2}, {2, 4}}})
        EXPECT_FALSE(find_contact({square, other}, {})) << other[0].x << ", " << other[0].y;
    const auto through = find_contact({square, {{4, 4}, {5, 2}, {3, 2}}}, {});
    ASSERT_TRUE(through);
    EXPECT_TRUE(through->crossing);
    const Ring diamond = {{2, 0}, {4, 2}, {2, 4}, {0, 2}};
    EXPECT_FALSE(find_contact({square, diamond, {{2, 0}, {2.5, 2}, {2, 4}, {1.5, 2}}}, {}));
    // Through two corners of the diamond.
    EXPECT_TRUE(find_contact({diamond, {{2, -1}, {3, -1}, {2, 0}, {2, 4}, {1, 5}}}, {}));
    EXPECT_TRUE(find_contact({square, square}, {}));
    // On a slanted edge, a hole's vertex is at its rounded position.
    const Ring slanted = {{0, 0}, {3, 1}, {3, 3}, {0, 3}};
    std::vector<RingSegment> edges;
    EXPECT_FALSE(find_contact({slanted, {{1, 1. / 3}, {2, 2}, {1, 2}}}, {}, &edges));
    EXPECT_EQ(edges.size(), 8U) << "the slanted edge is cut";
}

// A comb rotated by 45 degrees, all of whose edges share rows and columns.
TEST(PolygonContact, LooksAtFewPairsOfManyEdges) {
    Ring comb;
    for (int k = 0; k < 20'000; ++k) {
        const double x = k;
        const double y = k % 2 == 0 ? 0 : 10'000;
        comb.push_back({x - y, x + y});
    }
    comb.push_back({19'999 + 1.0, 19'999 - 1.0});
    comb.push_back({1, -1});
    EXPECT_FALSE(find_contact({comb}, {}));
}

TEST(PolygonContact, NearIsNotTouching) {
    const Ring square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    EXPECT_FALSE(find_contact({square, {{2, 1e-12}, {3, 1}, {2, 2}}}, {}));
    EXPECT_TRUE(find_contact({square, {{2, -1e-12}, {3, 1}, {2, 2}}}, {})->crossing);
}

}  // namespace stipple::testing::polygon_contact_test
