// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/chain.hpp"
#include "support/units.hpp"

namespace stipple::testing::spanning_tree_test {
namespace {

constexpr const char* unit = "spanning-tree";

Report report(const PointSet& set, const Settings& settings = {}) {
    return analyze(unit, set, settings);
}

}  // namespace

TEST(SpanningTree, ByHand) {
    // Euclidean: 0.3, 0.4, and 0.575 to the last point, which is nearer across the face on the
    // torus.
    const PointSet set = points_of({{0, 0.5}, {0.3, 0.5}, {0.3, 0.1}, {0.875, 0.5}});
    const Report straight = report(set, {{"metric", "euclidean"}});
    EXPECT_NEAR(straight.number("length"), 0.3 + 0.4 + 0.575, 1e-15);
    EXPECT_NEAR(straight.number("mean"), 1.275 / 3, 1e-15);
    EXPECT_NEAR(straight.number("minimum"), 0.3, 1e-15);
    EXPECT_NEAR(straight.number("maximum"), 0.575, 1e-15);
    EXPECT_NEAR(straight.number("normalized_mean"), 1.275 / 2, 1e-15);  // divided by sqrt(4) = 2
    const double squares =
        std::pow(0.3 - 0.425, 2) + std::pow(0.4 - 0.425, 2) + std::pow(0.575 - 0.425, 2);
    EXPECT_NEAR(straight.number("standard_deviation"), std::sqrt(squares / 3), 1e-15);
    EXPECT_NEAR(straight.number("normalized_deviation"), std::sqrt(squares / 3) * 1.5, 1e-15);
    EXPECT_EQ(straight.number("edges"), 3);
    EXPECT_EQ(straight.text("metric"), "euclidean");
    EXPECT_NEAR(report(set).number("length"), 0.3 + 0.4 + 0.125, 1e-15);
}

TEST(SpanningTree, LatticesHaveEdgesOfOneLength) {
    for (const std::size_t d : {1U, 2U, 3U, 4U}) {
        const auto n = static_cast<std::size_t>(std::pow(4, d));
        const Report found = report(make("regular", points(n, d)));
        EXPECT_NEAR(found.number("mean"), 0.25, 1e-15) << d;
        EXPECT_NEAR(found.number("standard_deviation"), 0, 1e-15) << d;
        EXPECT_NEAR(found.number("normalized_mean"),
                    static_cast<double>(n - 1) / static_cast<double>(n), 1e-14)
            << d;
    }
    PointSet hexagons(144, 2);
    const double height = std::sqrt(3) / 2;
    for (std::size_t i = 0; i < 144; ++i) {
        hexagons[i][0] = static_cast<double>(i % 12) + 0.5 * static_cast<double>(i / 12 % 2);
        hexagons[i][1] = height * static_cast<double>(i / 12);
    }
    hexagons.domain = box_domain({{0, 0}, {12, 12 * height}});
    const Report found = report(hexagons);
    EXPECT_NEAR(found.number("mean"), 1, 1e-14);
    EXPECT_NEAR(found.number("normalized_mean"), std::sqrt(2 / std::sqrt(3)) * 143 / 144, 1e-13);
}

// On a line, the tree consists of all gaps except the largest: for independent points their mean
// and standard deviation are 1 / n. In the plane, NumPy's 50,000 points with SciPy's triangulation
// and tree give 0.6463 and 0.2960. Every bound is at least 4 standard deviations over seeds.
TEST(SpanningTree, IndependentPointsAsTheBooksHaveThem) {
    const Report line = report(make("random", points(40'000, 1)));
    EXPECT_NEAR(line.number("normalized_mean"), 1, 0.001);
    EXPECT_NEAR(line.number("normalized_deviation"), 1, 0.03);
    const Report plane = report(make("random", points(50'000, 2)));
    EXPECT_NEAR(plane.number("normalized_mean"), 0.6463, 0.006);
    EXPECT_NEAR(plane.number("normalized_deviation"), 0.2960, 0.005);
    const Report even = report(make("jittered", points(50'176, 2)));
    EXPECT_GT(even.number("normalized_mean"), 0.66);
}

TEST(SpanningTree, UnitsDoNotMatterOnceNormalized) {
    PointSet set = make("random", points(300, 3));
    const Report plain = report(set);
    const Box box{{-1, -1, -1}, {3, 3, 3}};
    scale_into(box, set.flat());
    set.domain = box_domain(box);
    const Report scaled = report(set);
    EXPECT_NEAR(scaled.number("mean"), 4 * plain.number("mean"), 1e-14);
    EXPECT_NEAR(scaled.number("normalized_mean"), plain.number("normalized_mean"), 1e-13);
    EXPECT_NEAR(scaled.number("normalized_deviation"), plain.number("normalized_deviation"), 1e-13);
    set.domain = parse_domain("ball:radius=9", 3);
    EXPECT_EQ(report(set).find("normalized_mean"), nullptr);
    EXPECT_EQ(report(set).text("metric"), "euclidean");
}

TEST(SpanningTree, DuplicatesAreEdgesOfNoLength) {
    const PointSet set = points_of({{0.1, 0.2}, {0.4, 0.6}, {0.1, 0.2}, {0.1, 0.2}});
    EXPECT_EQ(report(set).number("duplicates"), 2);
    EXPECT_NEAR(report(set).number("length"), 0.5, 1e-15);
    EXPECT_EQ(report(points_of({{0, 0.5}, {1, 0.5}, {0.5, 0.5}})).number("duplicates"), 1);
}

TEST(SpanningTree, RefusesWhatHasNoEdges) {
    const auto refusal = [](const PointSet& set) { return error_of([&] { report(set); }); };
    EXPECT_EQ(refusal(points_of({{0.5}})),
              "input: spanning-tree needs at least two points; this is one");
    EXPECT_EQ(refusal(points_of({{0.5, 0}, {0.5, 0}})),
              "input: spanning-tree needs points at two or more places; all 2 are at one");
}

}  // namespace stipple::testing::spanning_tree_test
