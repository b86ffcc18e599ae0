// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/text.hpp"
#include "support/units.hpp"

namespace stipple::testing::poisson_disk_test {

using ::testing::HasSubstr;

namespace {

constexpr const char* unit = "poisson-disk";

Settings with(double radius, bool torus = true, Settings more = {}) {
    more.emplace_back("radius", format_number(radius));
    more.emplace_back("metric", torus ? "torus" : "euclidean");
    return more;
}

/// 8 x 8 points.
PointSet grid() {
    std::vector<double> rows;
    for (int i = 0; i < 64; ++i) rows.insert(rows.end(), {i % 8 / 8.0, i / 8 / 8.0});
    return {std::move(rows), 2};
}

/// A maximal set by a slow method: adds a point while some position is too far from all points.
PointSet filled(std::size_t d, double r, bool torus) {
    std::vector<double> rows(d, 0.3);
    for (;;) {
        const PointSet set(rows, d);
        const Report found = analyze("coverage", set, {{"metric", torus ? "torus" : "euclidean"}});
        if (found.number("radius") <= r) return set;
        const auto& center = found.curve("center");
        rows.insert(rows.end(), center.begin(), center.end());
    }
}

bool flag(const Report& report, const char* key) { return std::get<bool>(*report.find(key)); }

Report::Integers first_conflict(const Report& report) {
    return std::get<Report::Integers>(*report.find("first_conflict"));
}

}  // namespace

// Neighbours in the grid are 1/8 apart, and the centres of its cells sqrt(2) / 16 from them.
TEST(PoissonDiskVerification, OfAGridByHand) {
    const Report valid = analyze(unit, grid(), with(0.125));
    EXPECT_TRUE(flag(valid, "valid"));
    EXPECT_TRUE(flag(valid, "maximal"));
    EXPECT_EQ(valid.number("minimum"), 0.125);
    EXPECT_EQ(valid.number("conflicts"), 0);
    EXPECT_TRUE(first_conflict(valid).empty());
    EXPECT_NEAR(valid.number("coverage_radius"), std::sqrt(2.0) / 16, 1e-15);

    const Report crowded = analyze(unit, grid(), with(0.1251));
    EXPECT_FALSE(flag(crowded, "valid"));
    EXPECT_TRUE(flag(crowded, "maximal"));
    EXPECT_EQ(crowded.number("conflicts"), 128);
    EXPECT_EQ(first_conflict(crowded), (Report::Integers{0, 1}));
    EXPECT_EQ(analyze(unit, grid(), with(0.1251, false)).number("conflicts"), 112);
    EXPECT_EQ(analyze(unit, grid(), with(0.18)).number("conflicts"), 256);  // including diagonals

    const Report sparse = analyze(unit, grid(), with(0.088));
    EXPECT_FALSE(flag(sparse, "valid"));
    EXPECT_FALSE(flag(sparse, "maximal"));
    EXPECT_EQ(sparse.number("conflicts"), 0);
}

TEST(PoissonDiskVerification, AcceptsMaximalSetsAndMissesNoFault) {
    for (const auto& [d, r] : {std::pair<std::size_t, double>{1, 0.02}, {2, 0.15}, {3, 0.4}})
        for (const bool torus : {true, false}) {
            SCOPED_TRACE(::testing::Message() << d << " dimensions, torus " << torus);
            const PointSet set = filled(d, r, torus);
            EXPECT_TRUE(flag(analyze(unit, set, with(r, torus)), "valid"));
            const auto flat = set.flat();
            std::vector<double> rows(flat.begin() + static_cast<std::ptrdiff_t>(d), flat.end());
            const Report hole = analyze(unit, PointSet(rows, d), with(r, torus));
            EXPECT_FALSE(flag(hole, "maximal"));
            EXPECT_GE(hole.number("coverage_radius"), r);
            rows.insert(rows.end(), flat.begin(), flat.begin() + static_cast<std::ptrdiff_t>(d));
            rows.insert(rows.end(), rows.begin() + static_cast<std::ptrdiff_t>(d),
                        rows.begin() + static_cast<std::ptrdiff_t>(2 * d));
            const Report twice = analyze(unit, PointSet(rows, d), with(r, torus));
            EXPECT_TRUE(flag(twice, "maximal"));
            EXPECT_EQ(twice.number("conflicts"), 1);
            EXPECT_EQ(first_conflict(twice),
                      (Report::Integers{1, static_cast<std::int64_t>(set.count())}));
        }
}

// Oracle: all pairs, with a radius for which many are too near.
TEST(PoissonDiskVerification, CountsEveryPairThatIsTooNear) {
    for (const std::size_t d : {1, 2, 3})
        for (const double r : {0.01, 0.3, 2.0}) {
            const PointSet set = make("random", points(300, d));
            double conflicts = 0;
            for (std::size_t i = 0; i < 300; ++i)
                for (std::size_t j = 0; j < i; ++j) {
                    double sum = 0;
                    for (std::size_t k = 0; k < d; ++k) {
                        const double gap = std::abs(set[i][k] - set[j][k]);
                        sum += std::min(gap, 1 - gap) * std::min(gap, 1 - gap);
                    }
                    conflicts += sum < r * r ? 1 : 0;
                }
            EXPECT_EQ(analyze(unit, set, with(r)).number("conflicts"), conflicts) << d << " " << r;
        }
}

TEST(PoissonDiskVerification, TakesTheRadiusFromTheProvenanceElseTheSmallestDistance) {
    PointSet set = grid();
    EXPECT_EQ(measure(unit, "radius", set), 0.125);
    set.provenance.options = {{"radius", "0.1"}};
    EXPECT_EQ(measure(unit, "radius", set), 0.1);
    EXPECT_EQ(analyze(unit, set).text("metric"), "torus");
    EXPECT_TRUE(flag(analyze(unit, set), "valid"));
    set.provenance.options = {{"radius", "0.1"}, {"bounded", "true"}};
    EXPECT_EQ(analyze(unit, set).text("metric"), "euclidean");
    EXPECT_FALSE(flag(analyze(unit, set), "maximal"));  // the corner of the square
    EXPECT_EQ(analyze(unit, set, {{"metric", "torus"}}).text("metric"), "torus");
    EXPECT_EQ(measure(unit, "radius", set, {{"radius", "0.2"}}), 0.2);
    for (const char* varied : {"density", "radius-map", "mask"}) {
        set.provenance.options = {{"radius", "0.1"}, {varied, "file.npy"}};
        EXPECT_THAT(error_of([&] { analyze(unit, set); }),
                    HasSubstr(std::string("the points were made with --") + varied));
        EXPECT_EQ(measure(unit, "radius", set, {{"radius", "0.1"}}), 0.1);
    }
    set.provenance.warps = {"disk"};  // the radius belonged to the points before the warp
    EXPECT_EQ(measure(unit, "radius", set), 0.125);
}

TEST(PoissonDiskVerification, GeneratedSetsAreSpacedByTheRadiusThatTheyTell) {
    for (const bool torus : {true, false}) {
        const PointSet set =
            make("poisson-disk", points(500, 2), {{torus ? "torus" : "bounded", "true"}});
        const Report found = analyze(unit, set);
        EXPECT_EQ(found.number("conflicts"), 0);
        EXPECT_EQ(found.text("metric"), torus ? "torus" : "euclidean");
        EXPECT_GE(found.number("minimum"), found.number("radius"));
    }
}

TEST(PoissonDiskVerification, LetsGapsPassThatAreAsSmallAsTheTolerance) {
    const double gap = std::sqrt(2.0) / 16;
    EXPECT_TRUE(flag(analyze(unit, grid(), with(gap * (1 - 1e-10))), "maximal"));
    EXPECT_FALSE(flag(analyze(unit, grid(), with(gap * (1 - 1e-8))), "maximal"));
    EXPECT_TRUE(
        flag(analyze(unit, grid(), with(gap * 0.99, true, {{"tolerance", "0.02"}})), "maximal"));
}

TEST(PoissonDiskVerification, AnExpectationThatDoesNotHoldSaysWhy) {
    EXPECT_TRUE(analyze(unit, grid(), with(0.125, true, {{"expect", "valid"}})).unmet().empty());
    EXPECT_TRUE(analyze(unit, grid(), with(0.2)).unmet().empty());
    EXPECT_EQ(analyze(unit, grid(), with(0.15, true, {{"expect", "valid"}})).unmet(),
              std::vector<std::string>{"the set is not a maximal Poisson-disk set of radius 0.15: "
                                       "128 pairs are closer, the first is 0, 1"});
    const PointSet lone = points_of({{0.25, 0.25}});
    EXPECT_EQ(
        analyze(unit, lone, with(0.5, true, {{"expect", "valid"}})).unmet(),
        std::vector<std::string>{"the set is not a maximal Poisson-disk set of radius 0.5: (0.75, "
                                 "0.75) is 0.7071067811865476 from the nearest point"});
}

TEST(PoissonDiskVerification, AMeanOfSetsIsValidWhereAllAre) {
    const Analyzer& analyzer = find_analyzer(unit);
    Values options = analyzer.options.defaults();
    analyzer.options.set(options, "expect", "valid");
    for (const std::optional<bool> valid : {std::optional<bool>(), {false}, {true}}) {
        Report mean;
        if (valid) mean.add("valid", *valid);
        analyzer.refine(mean, 2, options);
        EXPECT_EQ(mean.unmet().empty(), valid == true);
    }
}

TEST(PoissonDiskVerification, OfASinglePoint) {
    const PointSet lone = points_of({{0.25, 0.25}});
    EXPECT_TRUE(flag(analyze(unit, lone, with(0.75)), "valid"));
    EXPECT_TRUE(flag(analyze(unit, lone, with(1.07, false)), "valid"));
    EXPECT_FALSE(flag(analyze(unit, lone, with(1.06, false)), "valid"));
    EXPECT_EQ(
        error_of([&] {
            analyze(unit, lone, {{"metric", "euclidean"}});
        }),
        "usage: --radius: a single point has no distance from which to take the radius; give one");
}

TEST(PoissonDiskVerification, RefusesARadiusThatIsNone) {
    for (const char* text : {"0", "-1", "nan", "inf", "x"})
        EXPECT_TRUE(error_of([&] {
                        analyze(unit, grid(), {{"radius", text}});
                    }).starts_with("usage: --radius: "))
            << text;
}

}  // namespace stipple::testing::poisson_disk_test
