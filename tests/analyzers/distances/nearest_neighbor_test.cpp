// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "pipeline/chain.hpp"
#include "support/units.hpp"

namespace stipple::testing::nearest_neighbor_test {
namespace {

constexpr const char* unit = "nearest-neighbor";

struct Expected {
    double minimum = std::numeric_limits<double>::infinity();
    double mean = 0;
    double maximum = 0;
    std::int64_t duplicates = 0;
    Report::Integers pair;
};

/// Oracle: all pairs, by the definition, in a torus with these sides (empty: Euclidean).
Expected by_definition(const PointSet& p, const std::vector<double>& sides,
                       const std::string& norm = "") {
    Expected found;
    for (std::size_t i = 0; i < p.count(); ++i) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t j = 0; j < p.count(); ++j) {
            double sum = 0;
            double all = 0;
            double largest = 0;
            for (std::size_t k = 0; k < p.dimension(); ++k) {
                double gap = std::abs(p[i][k] - p[j][k]);
                if (!sides.empty()) gap = std::min(gap, sides[k] - gap);
                sum += gap * gap;
                all += gap;
                largest = std::max(largest, gap);
            }
            const double distance = norm == "manhattan"   ? all
                                    : norm == "chebyshev" ? largest
                                                          : std::sqrt(sum);
            if (i != j) nearest = std::min(nearest, distance);
            if (i != j && distance < found.minimum) {
                found.minimum = distance;
                found.pair = {static_cast<std::int64_t>(i), static_cast<std::int64_t>(j)};
            }
        }
        found.mean += nearest / static_cast<double>(p.count());
        found.maximum = std::max(found.maximum, nearest);
        found.duplicates += nearest == 0 ? 1 : 0;
    }
    return found;
}

void expect_as_defined(const PointSet& set, const std::vector<double>& sides,
                       const std::string& norm = "") {
    std::string metric = sides.empty() ? "euclidean" : "torus";
    if (!norm.empty()) metric = sides.empty() ? norm : metric + "-" + norm;
    const Report report = analyze(unit, set, {{"metric", metric}});
    const Expected expected = by_definition(set, sides, norm);
    EXPECT_EQ(report.number("minimum"), expected.minimum);
    EXPECT_NEAR(report.number("mean"), expected.mean, 1e-12 * expected.mean);
    EXPECT_EQ(report.number("maximum"), expected.maximum);
    EXPECT_EQ(report.number("duplicates"), static_cast<double>(expected.duplicates));
    EXPECT_EQ(*std::get_if<Report::Integers>(report.find("pair")), expected.pair);
    EXPECT_EQ(report.text("metric"), metric);
}

/// Points c / 2 for the words of d binary digits that `keep` accepts.
template <class Keep>
PointSet half_integers(std::size_t d, const Keep& keep) {
    std::vector<double> rows;
    for (unsigned word = 0; word < (1U << d); ++word)
        for (std::size_t k = 0; k < d && keep(word); ++k)
            rows.push_back((word >> k & 1U) != 0 ? 0.5 : 0);
    return {std::move(rows), d};
}

bool even(unsigned word) { return std::popcount(word) % 2 == 0; }

}  // namespace

// Points 0 and 2 are 0.2 apart across the left face; 0 and 1 are 0.3 apart inside the cube.
TEST(NearestNeighbor, ByHand) {
    const PointSet set = points_of({{0.1, 0.5}, {0.4, 0.5}, {0.9, 0.5}});
    const Report torus = analyze(unit, set);
    EXPECT_NEAR(torus.number("minimum"), 0.2, 1e-15);
    EXPECT_NEAR(torus.number("mean"), (0.2 + 0.3 + 0.2) / 3, 1e-15);
    EXPECT_NEAR(torus.number("standard_deviation"), std::sqrt(0.02 / 9), 1e-15);
    EXPECT_EQ(*std::get_if<Report::Integers>(torus.find("pair")), (Report::Integers{0, 2}));
    EXPECT_EQ(torus.text("metric"), "torus");
    const Report straight = analyze(unit, set, {{"metric", "euclidean"}});
    EXPECT_NEAR(straight.number("minimum"), 0.3, 1e-15);
    EXPECT_NEAR(straight.number("maximum"), 0.5, 1e-15);
    EXPECT_EQ(*std::get_if<Report::Integers>(straight.find("pair")), (Report::Integers{0, 1}));
}

TEST(NearestNeighbor, IsWhatAllPairsGive) {
    for (const std::size_t d : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10})
        for (const std::uint64_t n : {2, 3, 200}) {
            SCOPED_TRACE(::testing::Message() << n << " points in " << d << " dimensions");
            PointSet set = make("random", points(n, d));
            expect_as_defined(set, {});
            expect_as_defined(set, std::vector<double>(d, 1));
            for (double& x : set.flat()) x = std::floor(8 * x) / 8;  // ties, duplicates
            set[0][0] = 0;
            set[1][0] = 1;
            expect_as_defined(set, {});
            expect_as_defined(set, std::vector<double>(d, 1));
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t k = 1; k < d; ++k) set[i][k] = set[i][0];  // a diagonal
            expect_as_defined(set, {});
            expect_as_defined(set, std::vector<double>(d, 1));
        }
}

TEST(NearestNeighbor, IsWhatAllPairsGiveInOtherNorms) {
    for (const char* norm : {"manhattan", "chebyshev"})
        for (const std::size_t d : {1, 2, 3, 4, 7})
            for (const std::uint64_t n : {2, 3, 200}) {
                SCOPED_TRACE(::testing::Message() << norm << ", " << n << " points, " << d);
                PointSet set = make("random", points(n, d));
                expect_as_defined(set, {}, norm);
                expect_as_defined(set, std::vector<double>(d, 1), norm);
                for (double& x : set.flat()) x = std::floor(8 * x) / 8;  // ties, duplicates
                set[0][0] = 0;
                set[1][0] = 1;
                expect_as_defined(set, {}, norm);
                expect_as_defined(set, std::vector<double>(d, 1), norm);
            }
    const Report report =
        analyze(unit, make("random", points(9, 2)), {{"metric", "torus-chebyshev"}});
    EXPECT_EQ(report.find("relative_radius"), nullptr);
}

TEST(NearestNeighbor, HoldsInTheBoxThatThePointsLiveOn) {
    PointSet set = make("random", {.count = 300, .dimension = 2});
    set.domain = box_domain({{-1, 10}, {1, 10.1}});
    scale_into(set.domain->bounding_box(), set.flat());
    expect_as_defined(set, {2, set.domain->bounding_box().extent(1)});
    expect_as_defined(set, {});
    EXPECT_EQ(analyze(unit, set).text("metric"), "torus");
}

// On the torus 0 and 1 are the same position.
TEST(NearestNeighbor, DuplicatesAreAtDistanceZero) {
    const PointSet set = points_of({{0.5, 0.5}, {0.2, 0}, {0.5, 0.5}, {0.2, 1}, {0.9, 0.9}});
    EXPECT_EQ(measure(unit, "minimum", set), 0);
    EXPECT_EQ(measure(unit, "duplicates", set), 4);
    EXPECT_EQ(measure(unit, "duplicates", set, {{"metric", "euclidean"}}), 2);
    EXPECT_EQ(measure(unit, "relative_radius", set), 0);
}

// The densest lattices with half-integer coordinates: Z, D3, D4, D5, E7 and E8, each with the
// density published by Conway and Sloane.
TEST(NearestNeighbor, DensestLatticesHaveRelativeRadiusOne) {
    const auto d3 = half_integers(3, even);
    const auto d4 = points_of({{0, 0, 0, 0}, {0.5, 0.5, 0.5, 0.5}});
    const auto d5 = half_integers(5, even);
    const auto e7 = half_integers(7, [](unsigned w) {  // orthogonal to the Hamming code
        return even(w & 0b1010101U) && even(w & 0b1100110U) && even(w & 0b1111000U) && even(w);
    });
    const PointSet d8 = half_integers(8, even);
    std::vector<double> e8(d8.flat().begin(), d8.flat().end());
    for (const double x : d8.flat()) e8.push_back(x + 0.25);
    EXPECT_EQ(e7.count(), 8U);
    for (const PointSet& lattice :
         {points_of({{0}, {0.25}, {0.5}, {0.75}}), d3, d4, d5, e7, PointSet(e8, 8)})
        EXPECT_NEAR(measure(unit, "relative_radius", lattice), 1, 1e-14) << lattice.dimension();
}

// 24 = 4 x 6 points in columns with spacings 1 and sqrt(3) / 2, in a box that fits them.
TEST(NearestNeighbor, HexagonsInABoxThatFitsThemHaveRelativeRadiusOne) {
    const double height = std::sqrt(3.0) / 2;
    std::vector<double> rows;
    for (int j = 0; j < 6; ++j)
        for (int i = 0; i < 4; ++i) rows.insert(rows.end(), {i + 0.5 * (j % 2), j * height});
    PointSet set(std::move(rows), 2);
    set.domain = box_domain({{0, 0}, {4, 6 * height}});
    EXPECT_NEAR(measure(unit, "relative_radius", set), 1, 1e-14);
    const PointSet square = make("hexagonal", points(100'000, 2));
    EXPECT_GT(measure(unit, "relative_radius", square), 0.996);
    EXPECT_LE(measure(unit, "relative_radius", square), 1);
}

// On a torus of 100 by 1, two points 50 apart have distance 1 to their own copies.
TEST(NearestNeighbor, RelativeRadiusIsAtMostOneOnALongTorus) {
    PointSet set({0.0, 0.5, 50.0, 0.5}, 2);
    set.domain = box_domain(Box{{0, 0}, {100, 1}});
    EXPECT_EQ(measure(unit, "minimum", set), 50);
    EXPECT_NEAR(measure(unit, "relative_radius", set), 1 / std::sqrt(200 / (2 * std::sqrt(3))),
                1e-14);
}

TEST(NearestNeighbor, HasNoRelativeRadiusWhereNoPackingIsKnown) {
    EXPECT_EQ(analyze(unit, make("random", points(9, 9))).find("relative_radius"), nullptr);
}

// Random points have the mean distance 1 / (2 sqrt n) for large n. Standard error of the mean:
// sqrt((4 - pi) / (4 pi n)) / sqrt n, below 0.001 / sqrt n here; the bound is ten of these.
TEST(NearestNeighbor, RandomPointsHaveTheMeanDistanceOfAPoissonProcess) {
    const double mean = measure(unit, "mean", make("random", points(100'000, 2)));
    EXPECT_NEAR(mean * std::sqrt(100'000), 0.5, 0.01);
}

TEST(NearestNeighbor, RefusesASinglePoint) {
    PointSet one = points_of({{0.5, 0.5}});
    const char* message = "input: nearest-neighbor needs at least two points; this is one";
    for (const char* metric : {"torus", "euclidean"})
        EXPECT_EQ(error_of([&] { analyze(unit, one, {{"metric", metric}}); }), message);
    one.domain = box_domain({{0, 0}, {3, 2}});
    EXPECT_EQ(error_of([&] { analyze(unit, one); }), message);
}

TEST(NearestNeighbor, NamesWhatIsNoFiniteNumber) {
    const double inf = std::numeric_limits<double>::infinity();
    for (const char* analyzer : {"nearest-neighbor", "spanning-tree", "coverage"})
        for (const char* metric : {"torus", "euclidean"}) {
            const auto refusal = [&](double x) {
                const PointSet set = points_of({{0.25, 0.5}, {0.5, x}, {0.75, 0.5}});
                return error_of([&] { analyze(analyzer, set, {{"metric", metric}}); });
            };
            EXPECT_EQ(refusal(std::nan("")), "input: x2 of point 1 is nan, not a finite number");
            EXPECT_EQ(refusal(-inf), "input: x2 of point 1 is -inf, not a finite number");
        }
    PointSet ball = points_of({{0, inf}, {0, 0}});
    ball.domain = parse_domain("disk", 2);
    EXPECT_EQ(error_of([&] { analyze(unit, ball); }),
              "input: x2 of point 0 is inf, not a finite number");
}

// The square of 1e154 is 1e308, but the sum of two of them overflows; that of 2e200 far more.
TEST(NearestNeighbor, RefusesSquaresBeyondFloat64) {
    const PointSet far = points_of({{1e200, 1e-320}, {-1e200, 0.5}, {3, 3}});
    const auto refusal = [](const char* analyzer, const PointSet& set) {
        return error_of([&] { analyze(analyzer, set, {{"metric", "euclidean"}}); });
    };
    for (const char* analyzer : {"nearest-neighbor", "spanning-tree"})
        EXPECT_EQ(refusal(analyzer, far),
                  "input: the points are too far apart for squared distances in float64: x1 from "
                  "-1e+200 to 1e+200");
    EXPECT_EQ(refusal(unit, points_of({{0}, {1e154}})), "");
    EXPECT_NE(refusal(unit, points_of({{0, 0}, {0, 1.1e154}, {1.1e154, 0}})), "");
    PointSet wide = points_of({{0.25}, {0.5}});
    wide.domain = box_domain({{0}, {2e155}});
    for (const char* analyzer : {"nearest-neighbor", "pair-correlation"})
        EXPECT_EQ(
            error_of([&] { analyze(analyzer, wide); }),
            "input: the box is too wide for squared distances in float64: x1 from 0 to 2e+155");
}

TEST(NearestNeighbor, MeasuresStraightWhereThereAreNoFaces) {
    PointSet set = points_of({{-0.9, 0}, {0.9, 0}});
    const Report anywhere = analyze(unit, set, {{"metric", "euclidean"}});
    EXPECT_EQ(anywhere.number("minimum"), 1.8);
    EXPECT_EQ(anywhere.find("relative_radius"), nullptr);
    EXPECT_EQ(
        error_of([&] { analyze(unit, set); }),
        "input: 1 of 2 points are outside the domain unit-cube; the first is point 0: (-0.9, 0) | "
        "--domain names the domain of the points; --metric euclidean accepts points anywhere");
    set.domain = parse_domain("disk", 2);
    EXPECT_EQ(analyze(unit, set).text("metric"), "euclidean");
    EXPECT_EQ(analyze(unit, set).number("minimum"), 1.8);
    EXPECT_EQ(error_of([&] {
                  analyze(unit, set, {{"metric", "torus"}});
              }),
              "usage: --metric: a torus joins the faces of a unit cube or a box; the domain of the "
              "points is disk");
}

TEST(NearestNeighbor, AMeanOverSetsHasNoPair) {
    const Analyzer& analyzer = find_analyzer(unit);
    Report mean = analyze(unit, make("random", points(10, 2)));
    analyzer.refine(mean, 1, analyzer.options.defaults());
    EXPECT_NE(mean.find("pair"), nullptr);
    analyzer.refine(mean, 2, analyzer.options.defaults());
    EXPECT_EQ(mean.find("pair"), nullptr);
}

TEST(NearestNeighbor, RefusesSquaresThatUnderflow) {
    const PointSet near = points_of({{0.5, 0.5}, {0.25, 1e-200}, {0.25, 3e-200}});
    for (const char* analyzer : {"nearest-neighbor", "spanning-tree", "coverage", "poisson-disk"})
        EXPECT_EQ(error_of([&] { analyze(analyzer, near); }),
                  "input: points 1 and 2 are too close for squared distances in float64: x2 is "
                  "1e-200 and 3e-200 | divide all coordinates by the same number")
            << analyzer;
    const PointSet apart = points_of({{0.5, 0.5}, {0.25, 1e-200}, {0.75, 1e-200}, {0.75, 1e-200}});
    EXPECT_EQ(measure(unit, "duplicates", apart), 2);
    PointSet narrow = points_of({{1e-170}, {2e-170}});
    narrow.domain = box_domain({{0}, {3e-170}});
    EXPECT_TRUE(error_of([&] {
                    analyze(unit, narrow);
                }).starts_with("input: the box is too narrow for squared distances in float64"));
}

// The product of the sides underflows, its root does not.
TEST(NearestNeighbor, RelativeRadiusInSmallBoxes) {
    PointSet small = make("random", points(20, 8));
    const double radius = measure(unit, "relative_radius", small);
    scale_into({std::vector<double>(8, 0), std::vector<double>(8, 0x1p-150)}, small.flat());
    small.domain = box_domain({std::vector<double>(8, 0), std::vector<double>(8, 0x1p-150)});
    EXPECT_NEAR(measure(unit, "relative_radius", small), radius, 1e-12);
}

}  // namespace stipple::testing::nearest_neighbor_test
