// SPDX-License-Identifier: MIT
#include "math/neighbors/point_grid.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/rng.hpp"

namespace stipple::testing::point_grid_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Odd proportions, far from the origin, thin, flat, tiny.
template <std::size_t D>
std::vector<Box> boxes() {
    std::vector<Box> all;
    for (const double stretch : {1.0, 0.01, 37.0, 0.0}) {
        Box box{std::vector<double>(D, -2.5), std::vector<double>(D, 4)};
        box.high[0] = box.low[0] + 6.5 * stretch;
        all.push_back(box);
    }
    all.push_back({std::vector<double>(D, 1e6), std::vector<double>(D, 1e6 + 1)});
    return all;
}

/// Random points, some of them on faces and some in pairs.
template <std::size_t D>
std::vector<double> some_points(const Box& box, std::size_t count) {
    const Rng rng(D);
    std::vector<double> rows;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < D; ++k) {
            double u = rng.uniform(i * D + k);
            if (i % 16 == 1) u = std::round(u);
            if (i % 16 == 2) u = 0.5;
            rows.push_back(box.low[k] + u * box.extent(k));
        }
    return rows;
}

/// Oracle: the formula of the header, over all pairs.
template <std::size_t D>
double distance_squared(const double* p, const double* q, const Box& box, bool torus) {
    double sum = 0;
    for (std::size_t k = 0; k < D; ++k) {
        double d = std::abs(p[k] - q[k]);
        if (torus) d = std::min(d, (box.high[k] - box.low[k]) - d);
        sum += d * d;
    }
    return sum;
}

template <std::size_t D>
std::multiset<std::size_t> within(const std::vector<double>& rows, const double* p, double radius,
                                  const Box& box, bool torus) {
    std::multiset<std::size_t> all;
    for (std::size_t i = 0; i < rows.size() / D; ++i)
        if (distance_squared<D>(p, rows.data() + i * D, box, torus) <= radius * radius)
            all.insert(i);
    return all;
}

template <std::size_t D>
void expect_every_neighbour_once() {
    for (const Box& box : boxes<D>())
        for (const bool torus : {true, false})
            for (const double cell : {0.3, 1.0, 100.0}) {
                const std::vector<double> rows = some_points<D>(box, 120);
                const SortedPoints<D> sorted(GridFrame<D>(box, torus, cell, 3000), rows, {});
                GrowingPoints<D> growing(box, torus);
                for (std::size_t i = 0; i < 120; ++i) growing.add(rows.data() + i * D);
                for (std::size_t i = 0; i < 120; i += 7)
                    for (const double radius : {0.0, 0.2, 1.0, 3.3, 500.0, infinity}) {
                        const double* p = rows.data() + i * D;
                        const auto truth = within<D>(rows, p, radius, box, torus);
                        std::multiset<std::size_t> found;
                        sorted.visit(p, radius, [&](std::size_t s, double squared) {
                            found.insert(sorted.original(s));
                            EXPECT_EQ(squared, distance_squared<D>(p, sorted[s], box, torus));
                        });
                        EXPECT_EQ(found, truth) << D << "-D, radius " << radius;
                        found.clear();
                        growing.visit(p, radius, [&](std::size_t j, double) {
                            found.insert(j);
                            return true;
                        });
                        EXPECT_EQ(found, truth) << D << "-D, radius " << radius << ", growing";
                    }
            }
}

}  // namespace

TEST(PointGrid, VisitsEveryNeighbourOnceInAnyBox) {
    expect_every_neighbour_once<1>();
    expect_every_neighbour_once<2>();
    expect_every_neighbour_once<3>();
    expect_every_neighbour_once<5>();
}

// Points and positions outside a bounded box are found, too.
TEST(PointGrid, PointsBeyondTheFacesAreFound) {
    const Box box{{0, 0}, {1, 1}};
    std::vector<double> rows = some_points<2>({{-3, -2}, {2, 4}}, 200);
    const SortedPoints<2> sorted(GridFrame<2>(box, false, 0.1), rows, {});
    for (std::size_t i = 0; i < 200; ++i) {
        std::multiset<std::size_t> found;
        sorted.visit(rows.data() + 2 * i, 0.7,
                     [&](std::size_t s, double) { found.insert(sorted.original(s)); });
        EXPECT_EQ(found, within<2>(rows, rows.data() + 2 * i, 0.7, box, false));
    }
}

TEST(PointGrid, RemovedPointsAreVisitedNoMore) {
    for (const bool torus : {true, false}) {
        const std::vector<double> rows{0.1, 0.1, 0.2, 0.1, 0.9, 0.9};
        SortedPoints<2> sorted(GridFrame<2>({{0, 0}, {1, 1}}, torus, 0.5), rows, {});
        for (std::size_t s = 0; s < 3; ++s)
            if (sorted.original(s) == 1) sorted.remove(s);
        std::multiset<std::size_t> found;
        sorted.visit(rows.data(), 5,
                     [&](std::size_t s, double) { found.insert(sorted.original(s)); });
        EXPECT_EQ(found, (std::multiset<std::size_t>{0, 2}));
    }
}

TEST(PointGrid, NearestIsTheLeastOfAllWhateverTheGuess) {
    for (const Box& box : boxes<2>())
        for (const bool torus : {true, false}) {
            const std::vector<double> rows = some_points<2>(box, 200);
            GrowingPoints<2> points(box, torus);
            EXPECT_EQ(points.nearest_squared(rows.data(), 1), infinity);
            for (std::size_t i = 0; i < 200; ++i) {
                const double* p = rows.data() + 2 * i;
                double least = infinity;
                for (std::size_t j = 0; j < i; ++j)
                    least = std::min(least, distance_squared<2>(p, points[j], box, torus));
                for (const double guess : {1e-3, 0.5, 1e3}) {
                    EXPECT_EQ(points.nearest_squared(p, guess), least);
                    EXPECT_EQ(points.any_nearer(p, guess), least < guess * guess);
                }
                points.add(p);
            }
        }
}

}  // namespace stipple::testing::point_grid_test
