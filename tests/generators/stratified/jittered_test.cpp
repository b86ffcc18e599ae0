// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "math/functions/powers.hpp"
#include "support/exact.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::jittered_test {
namespace {

struct Rectangle {
    Fraction x0, x1, y0, y1;
};

/// Oracle: cells of n points in the plane, row after row, as described in the header.
std::vector<Rectangle> cells_of(std::int64_t n) {
    const auto rows = static_cast<std::int64_t>(rounded_root(static_cast<std::uint64_t>(n)));
    std::vector<Rectangle> cells;
    for (std::int64_t r = 0; r < rows; ++r) {
        const std::int64_t begin = r * n / rows;
        const std::int64_t end = (r + 1) * n / rows;
        for (std::int64_t j = 0; j < end - begin; ++j)
            cells.push_back({Fraction(j, end - begin), Fraction(j + 1, end - begin),
                             Fraction(begin, n), Fraction(end, n)});
    }
    return cells;
}

}  // namespace

TEST(Jittered, PutsOnePointIntoEachCellOfEqualArea) {
    for (const std::int64_t n : {1, 2, 3, 5, 7, 10, 64, 97, 1000, 1023, 1024, 1025}) {
        const auto cells = cells_of(n);
        ASSERT_EQ(cells.size(), static_cast<std::size_t>(n));
        for (const char* where : {"random", "center"}) {
            const PointSet set =
                make("jittered", points(static_cast<std::uint64_t>(n), 2), {{"cell", where}});
            for (std::size_t i = 0; i < cells.size(); ++i) {
                const auto& [x0, x1, y0, y1] = cells[i];
                ASSERT_EQ((x1 - x0) * (y1 - y0), Fraction(1, n));
                const Fraction x = exactly(set[i][0]);
                const Fraction y = exactly(set[i][1]);
                ASSERT_TRUE(x >= x0 && x < x1 && y >= y0 && y < y1) << n << ", point " << i;
            }
        }
    }
}

// Grids of any shape; the first coordinate varies fastest.
TEST(Jittered, PutsOnePointIntoEachCellOfAShape) {
    for (const auto& shape : {std::vector<std::int64_t>{7}, {16, 4}, {1, 5, 3}, {3, 2, 1, 2}}) {
        std::string text;
        std::int64_t n = 1;
        for (const std::int64_t k : shape) {
            text += (text.empty() ? "" : "x") + std::to_string(k);
            n *= k;
        }
        const PointSet set = make("jittered", {}, {{"shape", text}});
        const PointSet grid = make("grid", {}, {{"shape", text}});
        ASSERT_EQ(set.count(), static_cast<std::size_t>(n)) << text;
        ASSERT_EQ(set.dimension(), shape.size());
        for (std::size_t i = 0; i < set.count(); ++i)
            for (std::size_t k = 0; k < shape.size(); ++k) {
                const Fraction half(1, 2 * shape[k]);
                const Fraction off =
                    exactly(set[i][k]) -
                    Fraction(std::lround(grid[i][k] * 2 * static_cast<double>(shape[k])),
                             2 * shape[k]);
                ASSERT_TRUE(off >= -half && off < half) << text << ", point " << i;
            }
        EXPECT_EQ(make("jittered", {}, {{"shape", text}, {"cell", "center"}}), grid) << text;
    }
    EXPECT_EQ(make("jittered", points(1000, 3), {}), make("jittered", {}, {{"shape", "10x10x10"}}));
    EXPECT_EQ(error_of([] {
                  make("jittered", points(7, 2), {{"shape", "2x3"}});
              }),
              error_of([] {
                  make("multi-jittered", points(7, 2), {{"shape", "2x3"}});
              }));
}

TEST(Jittered, CellsAreNearlySquare) {
    for (std::int64_t n = 64; n < 2000; n += 13)
        for (const auto& [x0, x1, y0, y1] : cells_of(n)) {
            const auto aspect = static_cast<double>((x1 - x0) / (y1 - y0));
            EXPECT_TRUE(aspect > 0.75 && aspect < 1.35) << n << ": " << aspect;
        }
}

TEST(Jittered, CentersOfASquareCountAreTheGrid) {
    for (const std::uint64_t k : {1, 2, 7, 32}) {
        EXPECT_EQ(make("jittered", points(k * k, 2), {{"cell", "center"}}),
                  make("grid", points(k * k, 2)));
        EXPECT_EQ(make("jittered", points(k * k * k, 3), {{"cell", "center"}}),
                  make("grid", points(k * k * k, 3)));
        EXPECT_EQ(make("jittered", points(k, 1), {{"cell", "center"}}), make("grid", points(k, 1)));
    }
}

TEST(Jittered, OnePointInEachCellInAnyDimension) {
    for (const auto& [k, d] : {std::pair{1000, 1}, {10, 3}, {5, 4}, {2, 8}, {1, 20}}) {
        const auto n = saturating_power(static_cast<std::uint64_t>(k), static_cast<std::size_t>(d));
        const PointSet set = make("jittered", points(n, static_cast<std::size_t>(d)));
        for (std::size_t i = 0; i < n; ++i) {
            std::size_t cell = i;
            for (const double x : set[i]) {
                EXPECT_EQ(std::floor(x * k),
                          static_cast<double>(cell % static_cast<std::size_t>(k)));
                cell /= static_cast<std::size_t>(k);
            }
        }
    }
}

// Offsets in cells are uniform: the mean of 2e5 offsets is within 5 standard deviations of 1/2
// (false alarm 1.2e-6), and no two are equal.
TEST(Jittered, OffsetsAreUniform) {
    const PointSet set = make("jittered", points(100, 2), {}, {.seed = 3});
    std::set<double> offsets;
    for (const double x : set.flat()) offsets.insert(x * 10 - std::floor(x * 10));
    EXPECT_EQ(offsets.size(), 200);
    const PointSet large = make("jittered", points(100'000, 1), {}, {.seed = 3});
    double sum = 0;
    for (const double x : large.flat()) sum += x * 1e5 - std::floor(x * 1e5) - 0.5;
    EXPECT_LT(std::abs(sum), 5 * std::sqrt(1e5 / 12));
}

TEST(Jittered, StaysInItsCellAtTheLargestCounts) {
    for (const std::uint64_t n : {(std::uint64_t{1} << 53) - 1, std::uint64_t{1} << 53})
        for (const std::size_t d : {1, 2})
            for (const char* where : {"random", "center"}) {
                const auto sequence = sequence_of("jittered", points(n, d), {{"cell", where}});
                for (const std::uint64_t first : {std::uint64_t{0}, n / 2, n - 100}) {
                    const PointSet part = stretch(*sequence, d, first, 100);
                    for (const double x : part.flat())
                        EXPECT_TRUE(x >= 0 && x < 1) << n << " " << d << " " << where;
                }
            }
}

TEST(Jittered, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("jittered", points(50, 2)));
    EXPECT_TRUE(stretches_agree("jittered", points(53, 1)));
    EXPECT_TRUE(stretches_agree("jittered", points(64, 3)));
    EXPECT_TRUE(stretches_agree("jittered", points(53, 2), {{"cell", "center"}}));
}

TEST(Jittered, ThreadsChangeNothingAndSeedsDo) {
    const PointSet one = make("jittered", points(30'000, 2), {}, {.seed = 1, .threads = 1});
    EXPECT_EQ(make("jittered", points(30'000, 2), {}, {.seed = 1, .threads = 5}), one);
    EXPECT_NE(make("jittered", points(30'000, 2), {}, {.seed = 2}), one);
}

TEST(Jittered, RefusesCountsThatAreNoPower) {
    EXPECT_EQ(error_of([] { make("jittered", points(1001, 3)); }),
              "usage: --count: 1001 is not k^3, as jittered needs; 1000 and 1331 are the nearest");
    EXPECT_EQ(error_of([] { make("jittered", points(1001, 1)); }), "");
    EXPECT_EQ(make("jittered", {.dimension = 3}).count(), 1000);
    EXPECT_NE(error_of([] { make("jittered", points(10, 2, 3)); }), "");
}

}  // namespace stipple::testing::jittered_test
