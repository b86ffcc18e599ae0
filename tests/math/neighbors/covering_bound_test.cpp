// SPDX-License-Identifier: MIT
#include "math/neighbors/covering_bound.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/rng.hpp"

namespace stipple::testing::covering_bound_test {
namespace {

template <std::size_t D>
using Points = std::vector<std::array<double, D>>;

template <std::size_t D>
double bound_of(const Points<D>& points, const std::array<double, D>& half) {
    CoveringBound<D> bound;
    for (const auto& q : points) bound.add(q);
    return bound.squared(half);
}

/// Oracle: largest squared distance to the nearest point, over a lattice of positions that includes
/// the corners.
template <std::size_t D>
double farthest_place(const Points<D>& points, const std::array<double, D>& half,
                      std::size_t steps) {
    std::size_t places = 1;
    for (std::size_t k = 0; k < D; ++k) places *= steps + 1;
    double farthest = 0;
    for (std::size_t place = 0; place < places; ++place) {
        std::array<double, D> x;
        for (std::size_t k = 0, rest = place; k < D; ++k, rest /= steps + 1)
            x[k] = half[k] *
                   (2 * static_cast<double>(rest % (steps + 1)) / static_cast<double>(steps) - 1);
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& q : points) {
            double squared = 0;
            for (std::size_t k = 0; k < D; ++k) squared += (x[k] - q[k]) * (x[k] - q[k]);
            nearest = std::min(nearest, squared);
        }
        farthest = std::max(farthest, nearest);
    }
    return farthest;
}

/// Solution of the linear program: y where |q|^2 - 2 q.y is equal for all points.
template <std::size_t D>
void expect_reached(const Points<D>& points, const std::array<double, D>& half,
                    const CoveringBound<0>::Point& y, double bound) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& q : points) {
        double value = 0;
        for (std::size_t k = 0; k < D; ++k) value += q[k] * q[k] - 2 * q[k] * y[k];
        least = std::min(least, value);
    }
    for (std::size_t k = 0; k < D; ++k) EXPECT_LE(std::abs(y[k]), half[k]);
    EXPECT_NEAR(least, bound, 1e-9) << D << "-D";
}

/// The promise, for random points and boxes. The lattice misses at most half of a step's diagonal.
template <std::size_t D>
void expect_tight(std::size_t steps) {
    const Rng rng(D);
    constexpr double fine = 1e-13;
    std::uint64_t i = 0;
    for (int trial = 0; trial < 60; ++trial) {
        Points<D> points(1 + trial % 12);
        for (auto& q : points)
            for (double& x : q) x = 2 * rng.uniform(i++) - 1;
        std::array<double, D> half;
        double squares = 0;
        for (double& h : half) {
            h = 0.4 * rng.uniform(i++);
            squares += h * h;
        }
        const double bound = bound_of<D>(points, half);
        CoveringBound<0> any(D, fine);  // dimension at run time, with a finer tolerance
        CoveringBound<0>::Point sides{};
        std::ranges::copy(half, sides.begin());
        for (const auto& q : points) {
            CoveringBound<0>::Point p{};
            std::ranges::copy(q, p.begin());
            any.add(p);
        }
        const double least = any.squared(sides);
        EXPECT_LE(least, bound * (1 + 1e-12)) << D << "-D, trial " << trial;
        EXPECT_GE(least, bound * (1 - 2e-3)) << D << "-D, trial " << trial;
        expect_reached<D>(points, half, any.place(sides), least - squares);
        const double sampled = farthest_place<D>(points, half, steps);
        const double missed = std::sqrt(squares) / static_cast<double>(steps);
        const double farthest = std::sqrt(sampled) + missed;
        EXPECT_GE(bound, sampled * (1 - 1e-12)) << D << "-D, trial " << trial;
        EXPECT_LE(bound, (farthest * farthest + squares) * 1.01) << D << "-D, trial " << trial;
    }
}

}  // namespace

// With one point, the farthest corner. With (+-1, 0) and a box about the origin, (0, h) is at 1 +
// h^2, and the bound adds w^2.
TEST(CoveringBound, ByHand) {
    EXPECT_NEAR(bound_of<2>({{3, -4}}, {1, 2}), 16 + 36, 1e-12);
    EXPECT_NEAR(bound_of<2>({{1, 0}, {-1, 0}}, {0.25, 0.5}), 1 + 0.25 + 0.0625, 1e-12);
    EXPECT_NEAR(bound_of<1>({{0}}, {0.5}), 0.25, 1e-12);
    EXPECT_NEAR(bound_of<1>({{1}, {1}, {-1}}, {0.5}), 1.25, 1e-12);
}

TEST(CoveringBound, IsAboveTheFarthestPlaceByTheSquareOfTheBox) {
    expect_tight<1>(100);
    expect_tight<2>(40);
    expect_tight<3>(14);
    expect_tight<4>(6);
}

TEST(CoveringBound, HoldsForFlatBoxesAndCopies) {
    EXPECT_NEAR(bound_of<2>({{1, 1}, {1, 1}, {1, 1}}, {0, 0}), 2, 1e-12);
    EXPECT_NEAR(bound_of<3>({{0, 0, 0}}, {0, 0, 0}), 0, 1e-12);
}

}  // namespace stipple::testing::covering_bound_test
