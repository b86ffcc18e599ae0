// SPDX-License-Identifier: MIT
//
// Promises of every registered scramble, with default options.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"
#include "pipeline/pipeline.hpp"
#include "support/contract.hpp"
#include "support/scrambling.hpp"

namespace stipple::testing::scrambles_test {
namespace {

class EveryScramble : public ::testing::TestWithParam<std::string> {
  protected:
    const Scramble& unit = *scramble_named(GetParam());
};

/// Random points, and all pairs of edge values, including 1.
PointSet closed_cube() {
    std::vector<double> rows(2000);
    Rng(5).fill(0, rows);
    const std::vector<double> edges = {0, 0x1p-60, 1. / 3, 0.5, 0.75, one_minus_ulp, 1};
    for (const double x : edges)
        for (const double y : edges) rows.insert(rows.end(), {x, y});
    return {std::move(rows), 2};
}

}  // namespace

TEST_P(EveryScramble, StaysInTheHalfOpenCube) {
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
        const PointSet points = scrambled(closed_cube(), unit.name, seed);
        for (const double x : points.flat()) EXPECT_TRUE(x >= 0 && x < 1) << x;
    }
}

TEST_P(EveryScramble, DependsOnTheSeedAndTheCoordinate) {
    const PointSet cube = closed_cube();
    EXPECT_EQ(scrambled(cube, unit.name, 7), scrambled(cube, unit.name, 7));
    EXPECT_NE(scrambled(cube, unit.name, 7), scrambled(cube, unit.name, 8));
    const PointSet diagonal = scrambled(points_of({{0.3, 0.3}, {0.6, 0.6}}), unit.name);
    EXPECT_NE(diagonal[0][0], diagonal[0][1]);
    EXPECT_NE(diagonal[1][0], diagonal[1][1]);
}

namespace {

/// Kolmogorov-Smirnov distance of a coordinate from uniformity, and chi-square in 31 cells.
struct Marginal {
    double distance = 0;
    double statistic = 0;
};

Marginal marginal(const PointSet& set, std::size_t k) {
    std::vector<double> x;
    for (std::size_t i = 0; i < set.count(); ++i) x.push_back(set[i][k]);
    std::ranges::sort(x);
    const auto n = static_cast<double>(x.size());
    Marginal found;
    std::vector<double> held(31);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const auto below = static_cast<double>(i);
        found.distance = std::max({found.distance, x[i] - below / n, (below + 1) / n - x[i]});
        held[static_cast<std::size_t>(x[i] * 31)] += 1;
    }
    for (const double h : held) found.statistic += (h - n / 31) * (h - n / 31) / (n / 31);
    return found;
}

/// Level 1e-7 for each test; about 400 tests of each kind give a false alarm of 1e-4.
bool is_uniform(const Marginal& found, std::size_t count) {
    return found.distance < 2.9 / std::sqrt(static_cast<double>(count)) && found.statistic < 88;
}

}  // namespace

TEST_P(EveryScramble, EveryReplicationHasUniformMarginals) {
    for (const char* generator : {"halton", "sobol", "random"})
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            PointSet set =
                scrambled(make(generator, points(1024, 3), {}, {.seed = 99}), unit.name, seed);
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_TRUE(is_uniform(marginal(set, k), 1024))
                    << generator << ", seed " << seed << ", axis " << k;
            for (std::size_t i = 0; i < 1024; ++i) set[i][0] *= 0.4 + 0.6 * set[i][0];
            EXPECT_FALSE(is_uniform(marginal(set, 0), 1024)) << "blind";
        }
}

// The image of a point is uniform in the cube over many seeds. (With a single point, the cell of
// micro-jitter is the whole cube.) Chi-square with 48 degrees of freedom, level 1e-6.
TEST_P(EveryScramble, ImagesOfOnePointAreUniform) {
    for (const double x : {0.0, 0.3, 0.75}) {
        std::vector<double> cells(49);
        const int seeds = 4900;
        for (int seed = 0; seed < seeds; ++seed) {
            const PointSet image =
                scrambled(points_of({{x, 1 - x}}), unit.name, static_cast<std::uint64_t>(seed));
            cells[static_cast<std::size_t>(image[0][0] * 7) * 7 +
                  static_cast<std::size_t>(image[0][1] * 7)] += 1;
        }
        double statistic = 0;
        for (const double held : cells) statistic += (held - 100) * (held - 100) / 100;
        EXPECT_LT(statistic, 110) << "image of " << x;
    }
}

TEST_P(EveryScramble, MovesPiecesAsTheWhole) {
    const PointSet cube = closed_cube();
    const PointSet whole = scrambled(cube, unit.name, 3);
    ScrambleRequest request{.coordinates = {0, 1}, .seed = 3, .count = cube.count()};
    const auto randomization = unit.make(unit.options.defaults(), request);
    for (const std::size_t piece : {1, 7, 511, 513}) {
        PointSet parts = cube;
        for (std::size_t i = 0; i < cube.count(); i += piece)
            randomization(i, parts.flat().subspan(2 * i, 2 * std::min(piece, cube.count() - i)));
        EXPECT_EQ(parts, whole) << "pieces of " << piece;
    }
}

// owen@3,1 scrambles these coordinates as owen scrambles all.
TEST_P(EveryScramble, NamedCoordinatesKeepTheirNumbers) {
    PointSet points(100, 3);
    Rng(9).fill(0, points.flat());
    const PointSet whole = scrambled(points, unit.name, 2);
    const auto values = unit.options.defaults();
    const auto part = unit.make(values, {.coordinates = {2, 0}, .seed = 2, .count = 100});
    std::vector<double> rows;
    for (std::size_t i = 0; i < 100; ++i) rows.insert(rows.end(), {points[i][2], points[i][0]});
    part(0, rows);
    for (std::size_t i = 0; i < 100; ++i) {
        EXPECT_EQ(rows[2 * i], whole[i][2]);
        EXPECT_EQ(rows[2 * i + 1], whole[i][0]);
    }
}

TEST_P(EveryScramble, HasACompleteRecord) { expect_complete_record(unit); }

INSTANTIATE_TEST_SUITE_P(Registry, EveryScramble, ::testing::ValuesIn(names_of(scrambles::all())),
                         case_name);

}  // namespace stipple::testing::scrambles_test
