// SPDX-License-Identifier: MIT
#include "generators/blue_noise/relaxation/relaxation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/rng.hpp"

namespace stipple::testing::density_relaxation_test {
namespace {

std::vector<double> scattered(const DensityMap& map, std::size_t n, std::uint64_t seed = 1) {
    std::vector<double> rows;
    const Rng rng(seed);
    for (std::size_t i = 0; i < n; ++i)
        for (const double x : map.place(rng.uniform(2 * i), rng.uniform(2 * i + 1)))
            rows.push_back(x);
    return rows;
}

std::size_t points_in(const std::vector<double>& rows, double x0, double x1, double y0, double y1) {
    std::size_t found = 0;
    for (std::size_t i = 0; i < rows.size(); i += 2)
        found += rows[i] >= x0 && rows[i] < x1 && rows[i + 1] >= y0 && rows[i + 1] < y1;
    return found;
}

double smallest_distance(const std::vector<double>& rows, double x0, double x1) {
    double least = 1;
    for (std::size_t i = 0; i < rows.size(); i += 2)
        for (std::size_t j = 0; j < i; j += 2) {
            if (rows[i] < x0 || rows[i] >= x1 || rows[j] < x0 || rows[j] >= x1) continue;
            const double y = std::abs(rows[i + 1] - rows[j + 1]);
            least = std::min(least, std::hypot(rows[i] - rows[j], std::min(y, 1 - y)));
        }
    return least;
}

}  // namespace

// 256 = 4^4 points: the leaves are equal, their forces cancel, and the plain step remains.
TEST(DensityRelaxation, AConstantDensityGivesThePlainSteps) {
    const DensityMap map(3, 5, std::vector<double>(15, 2));
    auto rows = scattered(map, 256);
    auto plain = rows;
    relax_to_density(rows, map, 3, {});
    relax_gaussian(plain, 2, 3, {});
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double difference = rows[i] - plain[i];
        EXPECT_NEAR(difference, std::round(difference), 1e-4 / 16) << i;
    }
}

// 256 points on 32 x 8 squares: the leaves of four roots are equal, as above.
TEST(DensityRelaxation, AConstantDensityGivesThePlainStepsInABox) {
    const DensityMap map(3, 5, std::vector<double>(15, 2));
    const std::vector<double> extents{4, 1};
    auto rows = scattered(map, 256);
    auto plain = rows;
    relax_to_density(rows, map, 3, {}, extents);
    relax_gaussian(plain, 2, 3, {}, extents);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double difference = rows[i] - plain[i];
        EXPECT_NEAR(difference, std::round(difference), 1e-4 / 8) << i;
    }
}

// Four parts of a long box with 40, 120, 240 and 400 of 800 points.
TEST(DensityRelaxation, EveryRegionOfABoxGetsItsShare) {
    const DensityMap map(1, 4, {0.1, 0.3, 0.6, 1});
    auto rows = scattered(map, 800);
    relax_to_density(rows, map, 60, {}, std::vector<double>{1, 6.5});
    const double expected[] = {40, 120, 240, 400};
    for (std::size_t c = 0; c < 4; ++c) {
        const double y = static_cast<double>(c) / 4;
        EXPECT_NEAR(static_cast<double>(points_in(rows, 0, 1, y, y + 0.25)), expected[c], 3) << c;
    }
}

// Four squares with 40, 120, 240 and 400 of 800 points. Random points would deviate by about 15.
TEST(DensityRelaxation, EveryRegionGetsItsShare) {
    const DensityMap map(2, 2, {0.1, 0.3, 0.6, 1});
    auto rows = scattered(map, 800);
    relax_to_density(rows, map, 60, {});
    const std::size_t expected[] = {40, 120, 240, 400};
    for (std::size_t c = 0; c < 4; ++c) {
        const double x = c % 2 == 1 ? 0.5 : 0;
        const double y = c / 2 == 1 ? 0.5 : 0;
        EXPECT_NEAR(static_cast<double>(points_in(rows, x, x + 0.5, y, y + 0.5)),
                    static_cast<double>(expected[c]), 4)
            << c;
    }
}

// Each half has its own distance; both keep at least 0.4 of it, unlike random points.
TEST(DensityRelaxation, DistancesFollowTheDensity) {
    const DensityMap map(2, 1, {0.2, 1.8});
    auto rows = scattered(map, 500);
    relax_to_density(rows, map, 150, {});
    EXPECT_GT(smallest_distance(rows, 0, 0.5), 0.4 / std::sqrt(500 * 0.2));
    EXPECT_GT(smallest_distance(rows, 0.5, 1), 0.4 / std::sqrt(500 * 1.8));
}

TEST(DensityRelaxation, NoPointLiesWhereTheDensityIsNothing) {
    std::vector<double> ring(32 * 32);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const double x = (static_cast<double>(i % 32) + 0.5) / 32 - 0.5;
        const double y = (static_cast<double>(i / 32) + 0.5) / 32 - 0.5;
        ring[i] = x * x + y * y > 0.03 && x * x + y * y < 0.12;
    }
    const DensityMap map(32, 32, ring);
    auto rows = scattered(map, 300);
    relax_to_density(rows, map, 30, {});
    for (std::size_t i = 0; i < rows.size(); i += 2) EXPECT_GT(map.at(rows[i], rows[i + 1]), 0);
}

// A slanted bar a few points wide, with a grey rim like an antialiased letter: where sigma is
// discontinuous, points might drift along it and gather at one end.
TEST(DensityRelaxation, ThinShapesKeepTheirShareAllAlong) {
    std::vector<double> bar(128 * 128);
    for (std::size_t i = 0; i < bar.size(); ++i) {
        const double x = static_cast<double>(i % 128) + 0.5;
        const double y = static_cast<double>(i / 128) + 0.5;
        bar[i] = std::clamp(6 - std::abs(y - 20 - 0.6 * x), 0.0, 1.0);
    }
    const DensityMap map(128, 128, bar);
    auto rows = scattered(map, 400);
    relax_to_density(rows, map, 150, {});
    for (int part = 0; part < 4; ++part)
        EXPECT_NEAR(static_cast<double>(points_in(rows, part / 4.0, (part + 1) / 4.0, 0, 1)), 100,
                    3)
            << part;
}

TEST(DensityRelaxation, TakesAnyContrastAndVeryFewPoints) {
    std::vector<double> spike(64 * 64, 1e-6);
    spike[1000] = 1;
    const DensityMap map(64, 64, spike);
    for (const std::size_t n : {1U, 2U, 3U, 50U}) {
        auto rows = scattered(map, n);
        relax_to_density(rows, map, 10, {});
        for (const double x : rows) EXPECT_TRUE(x >= 0 && x < 1) << n;
    }
}

TEST(DensityRelaxation, StaysTheSameForAnyNumberOfThreads) {
    const DensityMap map(2, 2, {1, 2, 3, 0});
    auto one = scattered(map, 1000);
    auto three = one;
    relax_to_density(one, map, 5, {.threads = 1});
    relax_to_density(three, map, 5, {.threads = 3});
    EXPECT_EQ(one, three);
}

}  // namespace stipple::testing::density_relaxation_test
