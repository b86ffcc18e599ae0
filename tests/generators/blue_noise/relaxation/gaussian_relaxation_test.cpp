// SPDX-License-Identifier: MIT
#include "generators/blue_noise/relaxation/relaxation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"

namespace stipple::testing::gaussian_relaxation_test {
namespace {

std::vector<double> random_rows(std::size_t n, std::size_t d, std::uint64_t seed = 1) {
    std::vector<double> rows(n * d);
    Rng(seed).fill(0, rows);
    return rows;
}

/// Oracle: one coordinate's factor, summed over images, in units of the mean distance.
double factor(double difference, double side) {
    const int images = static_cast<int>(std::ceil(20 / side));
    double sum = 0;
    for (int m = -images; m <= images; ++m) {
        const double t = (difference + m) * side;
        sum += std::exp(-t * t / 2);
    }
    return sum;
}

/// Sides of the torus in units of the mean distance, with the ratios of the extents.
std::vector<double> sides_of(std::size_t n, const std::vector<double>& extents) {
    double volume = 1;
    for (const double extent : extents) volume *= extent;
    std::vector<double> sides;
    for (const double extent : extents)
        sides.push_back(extent * std::pow(static_cast<double>(n) / volume,
                                          1 / static_cast<double>(extents.size())));
    return sides;
}

/// Oracle: energy by its definition, with images at any distance. A point also interacts with its
/// own images.
double energy(const std::vector<double>& rows, std::size_t d, std::vector<double> extents = {}) {
    const std::size_t n = rows.size() / d;
    if (extents.empty()) extents.assign(d, 1);
    const auto sides = sides_of(n, extents);
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            double product = 1;
            for (std::size_t k = 0; k < d; ++k)
                product *= factor(rows[i * d + k] - rows[j * d + k], sides[k]);
            sum += product - (i == j ? 1 : 0);
        }
    return sum / 2;
}

}  // namespace

TEST(GaussianRelaxation, TheFirstStepGoesDownTheGradient) {
    for (const std::size_t d : {1U, 2U, 3U, 4U}) {
        const std::size_t n = 60;
        const double side = std::pow(60.0, 1 / static_cast<double>(d));
        const auto start = random_rows(n, d, 7);
        auto moved = start;
        relax_gaussian(moved, d, 1, {});
        const double step = std::pow(2 * M_PI, 1 - static_cast<double>(d) / 2) / 4;
        for (std::size_t c = 0; c < 5 * d; ++c) {
            auto more = start, less = start;
            more[c] += 1e-5;
            less[c] -= 1e-5;
            const double slope = (energy(more, d) - energy(less, d)) / 2e-5;
            double shift = moved[c] - start[c];
            shift -= std::round(shift);
            EXPECT_NEAR(shift, -step * slope / (side * side), 1e-6) << d << "-D, " << c;
        }
    }
}

TEST(GaussianRelaxation, EnergyFallsTowardsThatOfAnEvenDensity) {
    // A constant density has (2 pi)^(d/2) / 2 per point, minus 1/2 for the pair of a point with
    // itself.
    for (const std::size_t d : {1U, 2U, 3U}) {
        const std::size_t n = 300;
        const double even = (std::pow(2 * M_PI, static_cast<double>(d) / 2) - 1) / 2;
        double last = energy(random_rows(n, d), d) / n;
        EXPECT_GT(last, even + 0.1);
        for (const std::uint64_t steps : {1, 5, 30, 100}) {
            auto rows = random_rows(n, d);
            relax_gaussian(rows, d, steps, {});
            const double reached = energy(rows, d) / n;
            EXPECT_LT(reached, last) << steps << " steps in " << d << "-D";
            last = reached;
        }
        EXPECT_NEAR(last, even, 1e-3) << d << "-D";
    }
}

TEST(GaussianRelaxation, StaysTheSameForAnyNumberOfThreads) {
    auto one = random_rows(5000, 2);
    auto four = one;
    relax_gaussian(one, 2, 10, {.threads = 1});
    relax_gaussian(four, 2, 10, {.threads = 4});
    EXPECT_EQ(one, four);
}

TEST(GaussianRelaxation, StepsAreThoseOfABoxOfAnyProportions) {
    for (const auto& extents : std::vector<std::vector<double>>{
             {2, 1}, {0.1, 0.3}, {1, 25}, {5, 1, 2}, {1, 1.5, 0.5, 1}, {7}}) {
        const std::size_t d = extents.size();
        const std::size_t n = d == 4 ? 12 : 60;
        const auto sides = sides_of(n, extents);
        const auto start = random_rows(n, d, 7);
        auto moved = start;
        relax_gaussian(moved, d, 1, {}, extents);
        const double step = std::pow(2 * M_PI, 1 - static_cast<double>(d) / 2) / 4;
        for (std::size_t c = 0; c < 3 * d; ++c) {
            auto more = start, less = start;
            more[c] += 1e-5;
            less[c] -= 1e-5;
            const double slope = (energy(more, d, extents) - energy(less, d, extents)) / 2e-5;
            double shift = moved[c] - start[c];
            shift -= std::round(shift);
            const double side = sides[c % d];
            EXPECT_NEAR(shift * side, -step * slope / side, 1e-5) << d << "-D, " << c;
        }
    }
}

// So thin that steps may be longer than a side.
TEST(GaussianRelaxation, StaysInsideVeryThinBoxes) {
    for (const std::size_t n : {1U, 2U, 5U, 200U}) {
        auto rows = random_rows(n, 2, 3);
        relax_gaussian(rows, 2, 20, {}, std::vector<double>{1, 1000});
        for (const double x : rows) EXPECT_TRUE(x >= 0 && x < 1) << n;
    }
}

TEST(GaussianRelaxation, EqualExtentsAreAsNone) {
    auto with = random_rows(100, 3);
    auto without = with;
    relax_gaussian(with, 3, 5, {}, std::vector<double>{0.3, 0.3, 0.3});
    relax_gaussian(without, 3, 5, {});
    EXPECT_EQ(with, without);
}

// On a line, points converge to equal distances.
TEST(GaussianRelaxation, EvensOutPointsOfALine) {
    auto rows = random_rows(20, 1);
    relax_gaussian(rows, 1, 2000, {});
    std::ranges::sort(rows);
    for (std::size_t i = 0; i < 20; ++i) {
        const double next = i + 1 < 20 ? rows[i + 1] : rows[0] + 1;
        EXPECT_NEAR(next - rows[i], 0.05, 0.01) << i;
    }
}

TEST(GaussianRelaxation, LeavesALatticeAndCoincidentPointsAtRest) {
    std::vector<double> lattice;
    for (int i = 0; i < 256; ++i) lattice.insert(lattice.end(), {(i % 16) / 16.0, (i / 16) / 16.0});
    auto rows = lattice;
    relax_gaussian(rows, 2, 3, {});
    for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_NEAR(rows[i], lattice[i], 1e-12);
    std::vector<double> same(2 * 9, 0.25);
    relax_gaussian(same, 2, 3, {});
    for (const double x : same) EXPECT_NEAR(x, 0.25, 1e-12);
}

}  // namespace stipple::testing::gaussian_relaxation_test
