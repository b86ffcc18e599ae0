// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/space/ball_kernels.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/rng.hpp"

namespace stipple::testing::ball_kernels_test {
using namespace stipple::poisson_disk;

namespace {

/// Balls around a cell, and its sides.
struct Scene {
    NearDisks<3, float> near;
    std::vector<std::array<float, 3>> centers;
    std::array<float, 3> scales;

    Scene(std::uint64_t seed, std::size_t count) {
        const Rng rng(seed);
        std::uint64_t i = 0;
        const auto draw = [&] { return static_cast<float>(rng.uniform(i++)); };
        for (float& scale : scales) scale = 0.4F + 0.17F * draw();
        for (std::size_t n = 0; n < count; ++n) {
            std::array<float, 3> center;
            for (float& x : center) x = 2.6F * draw() - 1;
            near.add(center);
            centers.push_back(center);
        }
        near.close();
    }

    /// Largest 1 - d^2 that holds for a whole box and a single ball at distance d.
    [[nodiscard]] double depth(const std::array<double, 3>& low,
                               const std::array<double, 3>& sides) const {
        double deepest = -1e9;
        for (const auto& center : centers) {
            double left = 1;
            for (std::size_t k = 0; k < 3; ++k) {
                const double far =
                    std::max(std::abs(center[k] - low[k]), std::abs(low[k] + sides[k] - center[k]));
                left -= far * far;
            }
            deepest = std::max(deepest, left);
        }
        return deepest;
    }

    /// The same for a sub-cell of a gap with that corner, in cells.
    [[nodiscard]] double depth(const std::array<double, 3>& corner, double subcell_side,
                               std::size_t subcell) const {
        std::array<double, 3> low;
        std::array<double, 3> sides;
        for (std::size_t k = 0; k < 3; ++k, subcell /= 4) {
            low[k] = (corner[k] + static_cast<double>(subcell % 4) * subcell_side) * scales[k];
            sides[k] = subcell_side * scales[k];
        }
        return depth(low, sides);
    }
};

/// Covered sub-cells must be certain, and those deep inside a ball must be covered.
void expect_right(bool is_open, double depth, const std::string& which) {
    if (depth < 3e-6) {
        EXPECT_TRUE(is_open) << which;
    }
    if (depth > 5e-6) {
        EXPECT_FALSE(is_open) << which;
    }
}

SubcellBits random_bits(std::uint64_t seed, double chance) {
    const Rng rng(seed);
    SubcellBits bits = 0;
    for (std::size_t i = 0; i < 64; ++i)
        if (rng.uniform(i) < chance) bits |= SubcellBits{1} << i;
    return bits;
}

}  // namespace

TEST(BallKernels, SubcellsAreOpenUnlessOneBallCoversThem) {
    std::size_t open_count = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const Scene scene(seed, seed % 40);
        const Rng rng(seed, 1);
        std::vector<Gap<3>> gaps;
        for (std::uint64_t w = 0; w < 5; ++w) {
            Gap<3> gap{{}, 0, static_cast<std::uint8_t>(rng.below(4 * w, 10))};
            for (std::size_t k = 0; k < 3; ++k)
                gap.corner[k] = gap.side() * static_cast<double>(rng.below(
                                                 4 * w + k + 1, std::uint64_t{1} << gap.level));
            gaps.push_back(gap);
        }
        std::vector<SubcellBits> open(gaps.size());
        open_gaps(scene.near, scene.scales, gaps, open.data());
        for (std::size_t w = 0; w < gaps.size(); ++w)
            for (std::size_t subcell = 0; subcell < 64; ++subcell) {
                const bool is_open = (open[w] >> subcell & 1) != 0;
                open_count += is_open ? 1 : 0;
                expect_right(is_open, scene.depth(gaps[w].corner, gaps[w].subcell_side(), subcell),
                             fmt::format("seed {}, gap {}, subcell {}", seed, w, subcell));
            }
    }
    EXPECT_GT(open_count, 20'000);
    EXPECT_LT(open_count, 270'000);
}

TEST(BallKernels, SubcellsOfSubcellsAreThoseOfGaps) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const Scene scene(seed, seed % 40);
        const SubcellBits some = random_bits(seed, 0.3);
        std::vector<SubcellBits> open(64);
        open_subcells(scene.near, scene.scales, some, open.data());
        std::size_t next = 0;
        for (std::size_t subcell = 0; subcell < 64; ++subcell) {
            if ((some >> subcell & 1) == 0) continue;
            for (std::size_t small = 0; small < 64; ++small)
                expect_right((open[next] >> small & 1) != 0,
                             scene.depth({0.25 * static_cast<double>(subcell % 4),
                                          0.25 * static_cast<double>(subcell / 4 % 4),
                                          0.25 * static_cast<double>(subcell / 16)},
                                         0.0625, small),
                             fmt::format("seed {}, subcell {}, {}", seed, subcell, small));
            ++next;
        }
    }
}

TEST(BallKernels, HitsAreThoseOfAnyBall) {
    std::array<int, 2> counts{};
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const Scene scene(seed, seed % 40);
        const Rng rng(seed, 2);
        for (std::uint64_t i = 0; i < 10; ++i) {
            std::array<float, 3> place;
            for (std::size_t k = 0; k < 3; ++k)
                place[k] = static_cast<float>(rng.uniform(3 * i + k)) * 0.5F;
            const Hit hit = hits<3, float>(scene.near, place, float_slack);
            const double depth = scene.depth({place[0], place[1], place[2]}, {0, 0, 0});
            if (std::abs(depth) < 2e-6) {
                EXPECT_EQ(hit, Hit::unsure);
            } else if (std::abs(depth) > 6e-6) {
                EXPECT_EQ(hit, depth > 0 ? Hit::yes : Hit::no) << seed << ", " << i;
                ++counts[depth > 0 ? 1 : 0];
            }
        }
    }
    EXPECT_GT(counts[0], 100);
    EXPECT_GT(counts[1], 100);
}

}  // namespace stipple::testing::ball_kernels_test
