// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/rng.hpp"
#include "math/geometry/planar_area.hpp"
#include "support/units.hpp"

namespace stipple::testing::voronoi_test {
namespace {

constexpr const char* unit = "voronoi";

Report report(const PointSet& set, const Settings& settings = {}, const RunContext& run = {}) {
    const Analyzer& analyzer = find_analyzer(unit);
    Values values = analyzer.options.defaults();
    for (const auto& [name, text] : settings) analyzer.options.set(values, name, text);
    return analyze(analyzer, set, values, run);
}

PointSet on(PointSet set, const Box& box) {
    set.domain = box_domain(box);
    return set;
}

PointSet moved(PointSet set, double x, double y) {
    for (std::size_t i = 0; i < set.count(); ++i) {
        set[i][0] += x - std::floor(set[i][0] + x);
        set[i][1] += y - std::floor(set[i][1] + y);
    }
    return set;
}

/// Hexagonal lattice with distance 1 and `side` rows, in a rectangle that it fills periodically.
PointSet hexagons(std::size_t side) {
    const double height = std::sqrt(3) / 2;
    PointSet set(side * side, 2);
    for (std::size_t i = 0; i < set.count(); ++i) {
        const std::size_t row = i / side;
        set[i][0] = static_cast<double>(i % side) + 0.5 * static_cast<double>(row % 2);
        set[i][1] = height * static_cast<double>(row);
    }
    const auto n = static_cast<double>(side);
    return on(std::move(set), {{0, 0}, {n, n * height}});
}

struct Oracle {
    double squared_deviation = 0;
    double second_moment = 0;
    double offset = 0;
    double local_order = 0;
    std::complex<double> global_order;
    std::complex<double> bond_sum;
    double bonds = 0;
    double inner = 0;
};

/// Integral of |x - c|^2 over a triangle from its edges' midpoints, which is exact.
double second_moment(const PlanePair& a, const PlanePair& b, const PlanePair& c) {
    const double area = signed_area({a, b, c});
    const auto squared = [](const PlanePair& p, const PlanePair& q) {
        const double x = (p[0] + q[0]) / 2;
        const double y = (p[1] + q[1]) / 2;
        return x * x + y * y;
    };
    return area / 3 * (squared(a, b) + squared(b, c) + squared(c, a));
}

/// The other points and, on the torus, all copies in the eight boxes around, relative to point i.
std::vector<PlanePair> others_of(const PointSet& set, std::size_t i, bool torus) {
    const Box box = set.domain->bounding_box();
    std::vector<PlanePair> others;
    const int turns = torus ? 1 : 0;
    for (std::size_t j = 0; j < set.count(); ++j)
        for (int u = -turns; u <= turns; ++u)
            for (int v = -turns; v <= turns; ++v)
                if (j != i || u != 0 || v != 0)
                    others.push_back({set[j][0] + u * box.extent(0) - set[i][0],
                                      set[j][1] + v * box.extent(1) - set[i][1]});
    return others;
}

/// A cell cut out of the box, or on the torus of a large one, by all others.
Polygon cell_of(const PointSet& set, std::size_t i, bool torus) {
    const Box box = set.domain->bounding_box();
    const double a = box.extent(0);
    const double b = box.extent(1);
    Polygon cell = {{-a, -b}, {a, -b}, {a, b}, {-a, b}};
    const PlanePair normals[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    for (std::size_t k = 0; !torus && k < 4; ++k) {
        const auto& face = k % 2 ? box.high : box.low;
        cell = clipped(cell, {face[0] - set[i][0], face[1] - set[i][1]}, normals[k]);
    }
    for (const auto& o : others_of(set, i, torus)) cell = clipped(cell, {o[0] / 2, o[1] / 2}, o);
    return cell;
}

/// Length of the part of the cell's boundary that is equally far from the other point and the site.
double shared_edge(const Polygon& cell, const PlanePair& other) {
    double low = INFINITY;
    double high = -INFINITY;
    for (const auto& [x, y] : cell) {
        const double half = (other[0] * other[0] + other[1] * other[1]) / 2;
        if (std::abs(x * other[0] + y * other[1] - half) > 1e-11) continue;
        const double along = (y * other[0] - x * other[1]) / std::hypot(other[0], other[1]);
        low = std::min(low, along);
        high = std::max(high, along);
    }
    return std::max(0.0, high - low);
}

double rim_of(const Polygon& cell) {
    double rim = 0;
    for (std::size_t k = 0; k < cell.size(); ++k) {
        const PlanePair& p = cell[k];
        const PlanePair& q = cell[(k + 1) % cell.size()];
        rim += std::hypot(q[0] - p[0], q[1] - p[1]);
    }
    return rim;
}

void add_shape(const Polygon& cell, double mean, Oracle& sums) {
    const double area = signed_area(cell);
    sums.squared_deviation += std::pow(area / mean - 1, 2);
    PlanePair first{0, 0};
    for (std::size_t k = 0; k < cell.size(); ++k) {
        const PlanePair& p = cell[k];
        const PlanePair& q = cell[(k + 1) % cell.size()];
        sums.second_moment += second_moment({0, 0}, p, q);
        for (const std::size_t c : {0U, 1U})
            first[c] += signed_area({{0, 0}, p, q}) * (p[c] + q[c]) / 3;
    }
    sums.offset += std::hypot(first[0], first[1]) / area;
}

Oracle by_definition(const PointSet& set, bool torus) {
    const Box box = set.domain->bounding_box();
    const double mean = box.extent(0) * box.extent(1) / static_cast<double>(set.count());
    Oracle sums;
    for (std::size_t i = 0; i < set.count(); ++i) {
        const Polygon cell = cell_of(set, i, torus);
        add_shape(cell, mean, sums);
        std::complex<double> sum;
        double length = 0;
        double bonds = 0;
        for (const auto& other : others_of(set, i, torus)) {
            const double edge = shared_edge(cell, other);
            if (!(edge > 1e-9 * std::sqrt(mean))) continue;
            length += edge;
            sum += std::polar(1.0, 6 * std::atan2(other[1], other[0]));
            ++bonds;
        }
        if (length < rim_of(cell) * (1 - 1e-9)) continue;  // the remaining edges are the box's
        ++sums.inner;
        sums.bonds += bonds;
        sums.bond_sum += sum;
        sums.local_order += std::abs(sum / bonds);
        sums.global_order += sum / bonds;
    }
    return sums;
}

}  // namespace

TEST(Voronoi, SquareLatticeByHand) {
    for (const auto& set : {make("regular", points(400, 2)),
                            moved(make("regular", points(400, 2)), 0.3141, 0.0271)}) {
        const Report found = report(set);
        EXPECT_EQ(found.number("cells"), 400);
        EXPECT_EQ(found.number("duplicates"), 0);
        EXPECT_NEAR(found.number("area.mean"), 1. / 400, 1e-16);
        EXPECT_NEAR(found.number("area.variation"), 0, 1e-12);
        EXPECT_EQ(found.number("valence.mean"), 4);
        EXPECT_EQ(found.number("valence.six"), 0);
        EXPECT_EQ(found.curve("valence.share")[1], 1);
        // exp(6 i theta) is 1, -1, 1, -1.
        EXPECT_NEAR(found.number("bond_order.local"), 0, 1e-12);
        EXPECT_NEAR(found.number("normalized_second_moment"), 1. / 12, 1e-13);
        EXPECT_NEAR(found.number("lloyd_energy"), 1. / 2400, 1e-15);
        EXPECT_NEAR(found.number("centroid_offset.maximum"), 0, 1e-12);
    }
}

TEST(Voronoi, HexagonalLatticeByHand) {
    const Report found = report(hexagons(12));
    EXPECT_NEAR(found.number("area.variation"), 0, 1e-12);
    EXPECT_EQ(found.number("valence.six"), 1);
    EXPECT_NEAR(found.number("bond_order.local"), 1, 1e-12);
    EXPECT_NEAR(found.number("bond_order.global"), 1, 1e-12);
    EXPECT_NEAR(found.number("bond_order.bonds"), 1, 1e-12);
    EXPECT_NEAR(found.number("normalized_second_moment"), 5 / (36 * std::sqrt(3)), 1e-13);
}

// A lattice rotated by 90 degrees is as regular; Lloyd's grains have different orientations.
TEST(Voronoi, GlobalOrderTellsWhetherHexagonsAreParallel) {
    PointSet set = hexagons(12);
    const Box box = set.domain->bounding_box();
    PointSet turned(set.count(), 2);
    for (std::size_t i = 0; i < set.count(); ++i) {
        turned[i][0] = set[i][1];
        turned[i][1] = set[i][0];
    }
    const Report found = report(on(turned, {{0, 0}, {box.high[1], box.high[0]}}));
    EXPECT_NEAR(found.number("bond_order.local"), 1, 1e-12);
    EXPECT_NEAR(found.number("bond_order.global"), 1, 1e-12);
    const Report random = report(make("lloyd", points(1000, 2)));
    EXPECT_GT(random.number("bond_order.local"), 0.6);
    EXPECT_LT(random.number("bond_order.global"), 0.3);
}

// Gilbert's variance of areas, 0.280176; valences of 6 +- 1.3345, of which a fraction of 0.2947 is
// six (Calka 2003). Each bound is at least 5 standard deviations of 20 sets: false alarm 1e-5.
TEST(Voronoi, IndependentPointsAsTheBooksHaveThem) {
    double variance = 0, moment = 0, deviation = 0, six = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const Report found = report(make("random", points(20'000, 2), {}, {.seed = seed}));
        EXPECT_EQ(found.number("valence.mean"), 6);  // Euler's formula on the torus
        variance += found.number("area.capacity_error") / 5;
        moment += found.number("normalized_second_moment") / 5;
        deviation += found.number("valence.standard_deviation") / 5;
        six += found.number("valence.six") / 5;
        EXPECT_LT(found.number("bond_order.global"), 0.02);
    }
    EXPECT_NEAR(variance, 0.280176, 0.008);
    EXPECT_NEAR(moment, 1 / (2 * std::numbers::pi), 0.0015);
    EXPECT_NEAR(deviation, 1.3345, 0.02);
    EXPECT_NEAR(six, 0.2947, 0.007);
    const Report jittered = report(make("jittered", points(16'384, 2)));
    EXPECT_LT(jittered.number("area.capacity_error"), 0.2);
    EXPECT_LT(jittered.number("normalized_second_moment"), 0.13);
}

TEST(Voronoi, CellsAreThoseOfTheDefinition) {
    for (const Box& box : {Box{{0, 0}, {1, 1}}, Box{{-1, 2}, {3, 2.75}}})
        for (const bool torus : {true, false})
            for (const std::size_t n : {2U, 3U, 7U, 60U, 100U}) {
                PointSet set = make("random", points(n, 2), {}, {.seed = n});
                for (std::size_t k = 0; n == 100 && k < 160; ++k)  // a crowd in a corner
                    set.flat()[k] *= 0.04;
                scale_into(box, set.flat());
                set.domain = box_domain(box);
                const Oracle oracle = by_definition(set, torus);
                const Report found = report(set, {{"metric", torus ? "torus" : "euclidean"}});
                const auto count = static_cast<double>(n);
                const double volume = box.extent(0) * box.extent(1);
                const double tolerance = 1e-9;
                const std::string about = fmt::format("{} points, torus {}", n, torus);
                EXPECT_NEAR(found.number("area.capacity_error"), oracle.squared_deviation / count,
                            tolerance)
                    << about;
                EXPECT_NEAR(found.number("lloyd_energy"), oracle.second_moment / volume, tolerance)
                    << about;
                EXPECT_NEAR(found.number("mean_distance"), std::sqrt(volume / count), tolerance);
                EXPECT_NEAR(found.number("centroid_offset.mean") * found.number("mean_distance"),
                            oracle.offset / count, tolerance)
                    << about;
                EXPECT_EQ(found.number("inner_cells"), oracle.inner) << about;
                EXPECT_EQ(found.find("valence") != nullptr, oracle.inner > 0) << about;
                if (oracle.inner == 0) continue;
                EXPECT_EQ(found.number("valence.mean"), oracle.bonds / oracle.inner) << about;
                EXPECT_NEAR(found.number("bond_order.local"), oracle.local_order / oracle.inner,
                            tolerance)
                    << about;
                EXPECT_NEAR(found.number("bond_order.global"),
                            std::abs(oracle.global_order) / oracle.inner, tolerance)
                    << about;
                EXPECT_NEAR(found.number("bond_order.bonds"),
                            std::abs(oracle.bond_sum) / oracle.bonds, tolerance)
                    << about;
            }
}

TEST(Voronoi, PlacesCountOnceAndTheirOrderNot) {
    const PointSet set = make("random", points(500, 2));
    PointSet mixed(500, 2);
    PointSet tripled(1500, 2);
    for (std::size_t i = 0; i < tripled.count(); ++i) {
        std::ranges::copy(set[i * 7 % 500], mixed[i % 500].begin());
        std::ranges::copy(set[i * 7 % 500], tripled[i].begin());
    }
    EXPECT_EQ(report(mixed), report(set));
    const Report found = report(tripled);
    EXPECT_EQ(found.number("cells"), 500);
    EXPECT_EQ(found.number("duplicates"), 1000);
    for (const char* key : {"area.variation", "bond_order.local", "lloyd_energy", "valence.six"})
        EXPECT_NEAR(found.number(key), report(set).number(key), 1e-12) << key;
    // Upper faces of the torus equal the lower ones.
    const Report faces =
        report(points_of({{0, 0.25}, {1, 0.25}, {0.5, 0}, {0.5, 1}, {0, 0}, {1, 1}}));
    EXPECT_EQ(faces.number("cells"), 3);
}

// Crowded points are handled by another algorithm with the same result.
TEST(Voronoi, CrowdsAreCutAsOthers) {
    PointSet set = make("random", points(4000, 2));
    const Report plain = report(set);
    for (double& x : set.flat()) x /= 64;
    const Report small = report(on(set, {{0, 0}, {1. / 64, 1. / 64}}));
    EXPECT_NEAR(small.number("area.variation"), plain.number("area.variation"), 1e-12);
    const Report crowd = report(set);  // in a corner of the unit square
    EXPECT_GT(crowd.number("area.largest"), 500);
    EXPECT_NEAR(crowd.number("bond_order.local"), plain.number("bond_order.local"), 0.02);
    for (const int threads : {1, 4})
        EXPECT_EQ(report(set, {}, {.threads = static_cast<unsigned>(threads)}), crowd);
}

TEST(Voronoi, TakesPointsOnALine) {
    PointSet line(10, 2);
    for (std::size_t i = 0; i < 10; ++i) line[i][0] = 0.1 * static_cast<double>(i) + 0.05;
    for (const char* metric : {"torus", "euclidean"}) {
        const Report found = report(line, {{"metric", metric}});
        EXPECT_NEAR(found.number("area.variation"), 0, 1e-12) << metric;
        EXPECT_NEAR(found.number("area.mean"), 0.1, 1e-16) << metric;
    }
    // Each cell is 0.1 wide and 1 high: its own copies are its neighbours above and below.
    EXPECT_EQ(report(line).number("valence.mean"), 4);
    EXPECT_NEAR(report(line).number("lloyd_energy"), (0.01 + 1) / 12, 1e-12);
    EXPECT_EQ(report(line, {{"metric", "euclidean"}}).find("valence"), nullptr);
    // Fast, by triangulation; apart from edges due to rounding.
    PointSet crowded = make("random", points(20000, 2));
    for (std::size_t i = 0; i < crowded.count(); ++i) crowded[i][1] = 0.5;
    EXPECT_NEAR(report(crowded).number("valence.mean"), 4, 5e-4);
}

TEST(Voronoi, ShortestEdgeIsTheUsersToSay) {
    PointSet set = make("regular", points(100, 2));
    const Rng rng(3);
    for (std::size_t i = 0; i < 200; ++i) set.flat()[i] += 1e-6 * rng.uniform(i);
    EXPECT_GT(report(set).number("valence.mean"), 5.9);
    EXPECT_EQ(report(set, {{"shortest-edge", "1e-3"}}).number("valence.mean"), 4);
}

TEST(Voronoi, RefusesWhatHasNoCells) {
    const auto refusal = [](const PointSet& set) { return error_of([&] { report(set); }); };
    EXPECT_EQ(refusal(points_of({{0.5, 0.5}})),
              "input: voronoi needs at least two points; this is one");
    EXPECT_EQ(refusal(points_of({{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}})),
              "input: voronoi needs points at two or more places; all 3 are at one");
    EXPECT_EQ(refusal(make("random", points(10, 3))),
              "input: voronoi requires points of dimension 2; these have 3");
}

// A cluster's inner cells are the same in its own units, however small it is.
TEST(Voronoi, CellsOfTinyClustersKeepTheirDigits) {
    const PointSet random = make("random", points(12, 2), {}, {.seed = 5});
    const auto smallest = [&](double scale, const char* metric) {
        PointSet set = random;
        for (double& x : set.flat()) x *= scale;
        return measure(unit, "area.smallest", set, {{"metric", metric}}) / scale / scale;
    };
    for (const char* metric : {"torus", "euclidean"}) {
        const double expected = smallest(0x1p-12, metric);
        for (const double scale : {0x1p-26, 0x1p-45, 0x1p-100, 0x1p-300})
            EXPECT_NEAR(smallest(scale, metric) / expected, 1, 1e-8) << scale << metric;
    }
}

TEST(Voronoi, RefusesBoxesWhosePowersLeaveFloat64) {
    for (const double side : {1e-170, 1e-85, 1e85}) {
        const PointSet set =
            on(points_of({{0, 0}, {side / 2, side / 4}, {side / 8, side}}), {{0, 0}, {side, side}});
        EXPECT_NE(error_of([&] { report(set); }), "") << side;
    }
}

}  // namespace stipple::testing::voronoi_test
