// SPDX-License-Identifier: MIT
#include "math/spaced_points.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"

using namespace stipple;

namespace {

/// Oracle: the nearest of all images, 3^D of them on the torus, compared one by one.
template <std::size_t D>
bool keeps_distance(const std::vector<std::array<double, D>>& points,
                    const std::array<double, D>& p, const Box& box, bool torus, double radius) {
    for (const auto& q : points) {
        double sum = 0;
        for (std::size_t k = 0; k < D; ++k) {
            double nearest = std::abs(p[k] - q[k]);
            for (const double turn : {-1.0, 1.0})
                if (torus)
                    nearest =
                        std::min(nearest, std::abs(turn * box.extent(k) + std::abs(p[k] - q[k])));
            sum += nearest * nearest;
        }
        if (sum < radius * radius) return false;
    }
    return true;
}

/// Points at random, some of them on the faces; asks about each, and adds those that fit.
template <std::size_t D>
void compare_with_all_pairs(const Box& box, bool torus, double radius, std::uint64_t seed) {
    const Rng rng(seed);
    SpacedPoints<D> points(box, torus, radius, {});
    std::vector<std::array<double, D>> kept;
    for (std::uint64_t i = 0; i < 400; ++i) {
        std::array<double, D> p;
        for (std::size_t k = 0; k < D; ++k) {
            const double u = rng.uniform(2 * (i * D + k));
            p[k] = box.low[k] + u * box.extent(k);
            const double where = rng.uniform(2 * (i * D + k) + 1);
            if (where < 0.1) p[k] = box.low[k];
            if (where > 0.9 || p[k] >= box.high[k]) p[k] = std::nextafter(box.high[k], box.low[k]);
        }
        const bool fits = points.fits(p);
        ASSERT_EQ(fits, keeps_distance(kept, p, box, torus, radius))
            << D << "-D box " << format_box(box) << (torus ? " torus" : "") << ", radius " << radius
            << ", seed " << seed << ", point " << i;
        if (!fits) continue;
        points.add(p);
        kept.push_back(p);
    }
    EXPECT_EQ(points.count(), kept.size());
}

}  // namespace

TEST(SpacedPoints, DistanceByHand) {
    const double p[] = {0.125, 0.5};
    const double q[] = {0.875, 1.0};
    EXPECT_EQ((squared_distance<2>(p, q, {1, 2}, false)), 0.75 * 0.75 + 0.25);
    EXPECT_EQ((squared_distance<2>(p, q, {1, 2}, true)), 0.25 * 0.25 + 0.25);
    EXPECT_EQ((squared_distance<2>(p, p, {1, 2}, true)), 0);
}

TEST(SpacedPoints, AgreesWithAllPairsInBoxesOfAnyProportion) {
    const Rng rng(1);
    for (std::uint64_t trial = 0; trial < 300; ++trial) {
        Box box;
        for (std::uint64_t k = 0; k < 3; ++k) {
            box.low.push_back(20 * rng.uniform(8 * trial + k) - 10);
            box.high.push_back(box.low[k] + 0.05 + 3 * rng.uniform(8 * trial + 3 + k));
        }
        const double radius = 0.03 + 2 * rng.uniform(8 * trial + 6);
        const Box plane{{box.low[0], box.low[1]}, {box.high[0], box.high[1]}};
        for (const bool torus : {true, false}) {
            compare_with_all_pairs<2>(plane, torus, radius, trial);
            compare_with_all_pairs<3>(box, torus, radius, trial);
        }
    }
}

// Sides that are small multiples of the radius: 1, 2, 3, ... cells, the grid smaller than the
// neighbourhood on the torus.
TEST(SpacedPoints, AgreesWithAllPairsOnTheSmallestGrids) {
    for (int quarters = 1; quarters <= 24; ++quarters)
        for (const bool torus : {true, false}) {
            const double side = quarters / 4.0;
            compare_with_all_pairs<2>({{0, 0}, {side, side}}, torus, 1, 1);
            compare_with_all_pairs<2>({{0, 0}, {side, 7}}, torus, 1, 2);
            compare_with_all_pairs<3>({{0, 0, 0}, {side, side, side}}, torus, 1, 3);
            compare_with_all_pairs<3>({{0, 0, 0}, {6.5, side, 0.125}}, torus, 1, 4);
        }
}

// A side just above 5 r / sqrt(3) has six cells of 0.481 r, so that a distance of 2.001 cells,
// below r, can lead to the third cell from here.
TEST(SpacedPoints, LooksAsFarAsARadiusCanLead) {
    const Box box{{0, 0, 0}, {2.8868, 2.8868, 2.8868}};
    EXPECT_EQ(cells_along(box, 1), (std::vector<double>{6, 6, 6}));
    const double cell = 2.8868 / 6;
    for (const bool torus : {true, false}) {
        SpacedPoints<3> points(box, torus, 1, {});
        points.add({cell * 0.9995, 1, 1});
        EXPECT_FALSE(points.fits({cell * 3.0005, 1, 1}));
    }
}

TEST(SpacedPoints, CellsHaveADiagonalBelowTheRadius) {
    for (const double radius : {0.1, 0.3, 1.0, 2.5, 1e-3}) {
        const std::vector<double> cells = cells_along({{0, 0, 0}, {1, 2, 0.3}}, radius);
        const double x = 1 / cells[0];
        const double y = 2 / cells[1];
        const double z = 0.3 / cells[2];
        EXPECT_LT(x * x + y * y + z * z, radius * radius);
    }
}

TEST(SpacedPoints, StopsWhileItMakesALargeGrid) {
    std::stop_source source;
    source.request_stop();
    const RunContext run{.stop = source.get_token()};
    EXPECT_THROW(SpacedPoints<2>({{0, 0}, {1, 1}}, true, 1e-4, run), std::exception);
}
