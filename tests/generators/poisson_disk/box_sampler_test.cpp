// SPDX-License-Identifier: MIT
//
// The general box sampler, also for boxes for which another sampler would be chosen.
#include <gtest/gtest.h>

#include "core/rng.hpp"
#include "generators/poisson_disk/grid.hpp"
#include "support/spacing.hpp"

namespace stipple::testing::box_sampler_test {
namespace {

using poisson_disk::Grid;
using poisson_disk::Task;

template <std::size_t D>
PointSet sampled(const Space& space, double radius, std::uint64_t seed,
                 const RunContext& run = {.threads = 1}) {
    const BoxSpace box{space.box, space.torus};
    const Grid<D> grid(box, radius, radius, 1U << poisson_disk::box_tile_bits<D>);
    const Task<D> task{grid, 1000, seed};
    return PointSet(poisson_disk::box_sample(task, run), D);
}

/// Distance from a position to the nearest point.
double distance_to(const PointSet& set, std::span<const double> place, const Space& space) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < set.count(); ++i)
        least = std::min(least, distance(set[i], place, space));
    return least;
}

template <std::size_t D>
void expect_maximal(double radius) {
    for (const bool torus : {true, false}) {
        const Space space{{std::vector<double>(D, -1.0), std::vector<double>(D, 0.5)}, torus};
        const PointSet set = sampled<D>(space, radius, 7);
        expect_inside(set, space);
        EXPECT_GE(smallest_distance(set, space), radius) << space.name();
        const Rng rng(3);
        std::vector<double> place(D);
        for (std::uint64_t i = 0; i < 20'000; ++i) {
            for (std::size_t k = 0; k < D; ++k) place[k] = -1 + 1.5 * rng.uniform(i * D + k);
            ASSERT_LE(distance_to(set, place, space), radius * (1 + 1e-9)) << space.name();
        }
    }
}

}  // namespace

TEST(BoxSampler, LeavesNoPlaceForAnotherPoint) {
    expect_maximal<2>(0.1);
    expect_maximal<3>(0.25);
    expect_maximal<4>(0.5);
    expect_maximal<5>(0.8);
    expect_maximal<6>(1.1);
}

TEST(BoxSampler, GivesTheSamePointsOnAnyNumberOfThreads) {
    const Space space{{{0, 0, 0}, {1, 2, 0.5}}, true};
    const PointSet alone = sampled<3>(space, 0.08, 5);
    EXPECT_EQ(sampled<3>(space, 0.08, 5, {.threads = 4}), alone);
    EXPECT_NE(sampled<3>(space, 0.08, 6), alone);
}

// A torus one cell wide, where a disk meets its own image.
TEST(BoxSampler, FillsBoxesThatAreNarrowerThanTheRadius) {
    const Space space{{{0, 0}, {10, 0.05}}, true};
    const PointSet set = sampled<2>(space, 0.2, 1);
    EXPECT_GE(smallest_distance(set, space), 0.2);
    EXPECT_GT(set.count(), 25U);
    EXPECT_LE(set.count(), 50U);
}

}  // namespace stipple::testing::box_sampler_test
