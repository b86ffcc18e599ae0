// SPDX-License-Identifier: MIT
#include "generators/cube_windows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"

using namespace stipple;

namespace {

/// Places about a window from 0 on, and its sides; all numbers are floats.
struct Scene {
    NearDisks<3, float> near;
    std::vector<std::array<float, 3>> centers;
    Raster<3, float> raster;

    Scene(std::uint64_t seed, std::size_t count) {
        const Rng rng(seed);
        std::uint64_t i = 0;
        const auto draw = [&] { return static_cast<float>(rng.uniform(i++)); };
        for (std::size_t k = 0; k < 3; ++k) {
            raster.corner[k] = draw();
            raster.part[k] = std::ldexp(0.1F + 0.1F * draw(), -static_cast<int>(seed % 7));
        }
        near.clear();
        for (std::size_t n = 0; n < count; ++n) {
            std::array<float, 3> center;
            for (float& x : center) x = 3 * draw() - 1;
            centers.push_back(center);
            near.add(center);
        }
        near.close();
    }

    /// How far inside of one disk a part is at least, as 1 - a squared distance.
    [[nodiscard]] double depth(std::size_t part) const {
        double deepest = -1e9;
        for (const auto& center : centers) {
            double left = 1;
            for (std::size_t k = 0, rest = part; k < 3; ++k, rest /= 4) {
                const double side = raster.part[k];
                const double low = raster.corner[k] + static_cast<double>(rest % 4) * side;
                const double far =
                    std::max(std::abs(center[k] - low), std::abs(low + side - center[k]));
                left -= far * far;
            }
            deepest = std::max(deepest, left);
        }
        return deepest;
    }
};

PartBits random_bits(std::uint64_t seed, double chance) {
    const Rng rng(seed);
    PartBits bits = 0;
    for (std::size_t i = 0; i < 64; ++i)
        if (rng.uniform(i) < chance) bits |= PartBits{1} << i;
    return bits;
}

}  // namespace

TEST(CubeWindows, PartsAreOpenUnlessOneDiskCoversThem) {
    std::size_t open_parts = 0;
    std::size_t covered_parts = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const Scene scene(seed, seed % 23);
        const PartBits open = open_cube(scene.near, scene.raster);
        for (std::size_t part = 0; part < 64; ++part) {
            const double depth = scene.depth(part);
            const bool is_open = (open >> part & 1) != 0;
            if (depth < 3e-6) {
                EXPECT_TRUE(is_open) << "seed " << seed << ", part " << part;
            }
            if (depth > 5e-6) {
                EXPECT_FALSE(is_open) << "seed " << seed << ", part " << part;
            }
            ++(is_open ? open_parts : covered_parts);
        }
    }
    EXPECT_GT(open_parts, 10000);
    EXPECT_GT(covered_parts, 10000);
}

// Every open part is within exactly one of the windows that are left, which are within the old one
// and have something open each.
TEST(CubeWindows, NarrowingLosesNothingAndKeepsNothingCovered) {
    const Window<3> window{.corner = {0.625, 0.5, 0.25}, .place = 7, .level = 3};
    for (std::uint64_t seed = 0; seed < 400; ++seed)
        for (const double chance : {0.01, 0.03, 0.2, 1.0})
            for (const double darts : {0.1, 10.0}) {
                const PartBits open = random_bits(seed, chance);
                if (open == 0) continue;
                std::vector<Window<3>> left;
                narrow_cube(window, open, darts, left);
                std::vector<int> found(64, 0);
                for (const Window<3>& w : left) {
                    EXPECT_EQ(w.place, 7);
                    int within = 0;
                    for (std::size_t part = 0; part < 64; ++part) {
                        if ((open >> part & 1) == 0) continue;
                        bool inside = true;
                        for (std::size_t k = 0, rest = part; k < 3; ++k, rest /= 4) {
                            const double low =
                                window.corner[k] + static_cast<double>(rest % 4) * window.part();
                            inside = inside && low >= w.corner[k] &&
                                     low + window.part() <= w.corner[k] + w.side();
                        }
                        found[part] += inside ? 1 : 0;
                        within += inside ? 1 : 0;
                    }
                    EXPECT_GT(within, 0) << "seed " << seed;
                    for (std::size_t k = 0; k < 3; ++k) {
                        EXPECT_GE(w.corner[k], window.corner[k]);
                        EXPECT_LE(w.corner[k] + w.side(), window.corner[k] + window.side());
                    }
                }
                for (std::size_t part = 0; part < 64; ++part)
                    EXPECT_EQ(found[part], static_cast<int>(open >> part & 1))
                        << "seed " << seed << ", part " << part;
            }
}

TEST(CubeWindows, NarrowToTheOpenPartsAndAreSplitOnceDartsHadTheirChance) {
    const Window<3> window{.corner = {0.5, 0, 0}, .place = 0, .level = 1};
    std::vector<Window<3>> left;
    narrow_cube(window, PartBits{1} << 63, 0, left);  // the last part
    ASSERT_EQ(left.size(), 1);
    EXPECT_EQ(left[0].level, 3);
    EXPECT_EQ(left[0].corner, (std::array{0.875, 0.375, 0.375}));
    left.clear();
    narrow_cube(window, PartBits{3} << 22, 0, left);  // x 2 and 3, y 1, z 1
    ASSERT_EQ(left.size(), 1);
    EXPECT_EQ(left[0].level, 2);
    EXPECT_EQ(left[0].corner, (std::array{0.75, 0.125, 0.125}));
    left.clear();
    narrow_cube(window, ~PartBits{0}, 0.5, left);
    ASSERT_EQ(left.size(), 1);
    EXPECT_EQ(left[0].level, 1);
    left.clear();
    narrow_cube(window, ~PartBits{0}, 2, left);
    EXPECT_EQ(left.size(), 8);
}

TEST(CubeWindows, HalvesAreThoseThatAWindowReachesInto) {
    EXPECT_EQ(halves_of<3>({.corner = {}, .place = 0, .level = 0}), all_halves<3>);
    EXPECT_EQ(halves_of<2>({.corner = {}, .place = 0, .level = 0}), all_halves<2>);
    EXPECT_EQ(halves_of<3>({.corner = {}, .place = 0, .level = 1}), 1U);
    EXPECT_EQ(halves_of<3>({.corner = {0.5, 0.5, 0.5}, .place = 0, .level = 1}), 1U << 7);
    EXPECT_EQ(halves_of<3>({.corner = {0.25, 0.75, 0}, .place = 0, .level = 2}), 1U << 2);
    EXPECT_EQ(halves_of<3>({.corner = {0.25, 0, 0.5}, .place = 0, .level = 1}), 3U << 4);
}
