// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/cube_windows.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/rng.hpp"

namespace stipple::testing::cube_windows_test {
namespace {

/// Balls about a cell, and the sides of that.
struct Scene {
    NearBalls near;
    std::vector<std::array<float, 3>> centers;
    std::array<float, 3> scales;

    Scene(std::uint64_t seed, std::size_t count) {
        const Rng rng(seed);
        std::uint64_t i = 0;
        const auto draw = [&] { return static_cast<float>(rng.uniform(i++)); };
        for (float& scale : scales) scale = 0.4F + 0.17F * draw();
        near.size = count;
        for (std::size_t n = 0; n < count; ++n) {
            std::array<float, 3> center;
            for (std::size_t k = 0; k < 3; ++k) near.at[k][n] = center[k] = 2.6F * draw() - 1;
            centers.push_back(center);
        }
        near.close();
    }

    /// The largest 1 - d^2 that is true for all of a box and the same ball, d from its centre.
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

    /// The same for a part of a window with that corner, in cells.
    [[nodiscard]] double depth(const std::array<double, 3>& corner, double part_side,
                               std::size_t part) const {
        std::array<double, 3> low;
        std::array<double, 3> sides;
        for (std::size_t k = 0; k < 3; ++k, part /= 4) {
            low[k] = (corner[k] + static_cast<double>(part % 4) * part_side) * scales[k];
            sides[k] = part_side * scales[k];
        }
        return depth(low, sides);
    }
};

/// What is covered is so for certain, and what is deep enough in a ball is.
void expect_right(bool is_open, double depth, const std::string& which) {
    if (depth < 3e-6) {
        EXPECT_TRUE(is_open) << which;
    }
    if (depth > 5e-6) {
        EXPECT_FALSE(is_open) << which;
    }
}

PartBits random_bits(std::uint64_t seed, double chance) {
    const Rng rng(seed);
    PartBits bits = 0;
    for (std::size_t i = 0; i < 64; ++i)
        if (rng.uniform(i) < chance) bits |= PartBits{1} << i;
    return bits;
}

CubeWindow cube_at(const std::array<double, 3>& corner, std::uint16_t place, std::uint8_t level) {
    CubeWindow window{{}, place, level};
    for (std::size_t k = 0; k < 3; ++k)
        window.corner[k] = static_cast<std::uint16_t>(corner[k] * 65536);
    return window;
}

int side_of(const CubeWindow& window) { return 65536 >> window.level; }

}  // namespace

TEST(CubeWindows, PartsAreOpenUnlessOneBallCoversThem) {
    std::size_t open_parts = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const Scene scene(seed, seed % 40);
        const Rng rng(seed, 1);
        std::vector<CubeWindow> windows;
        for (std::uint64_t w = 0; w < 5; ++w) {
            CubeWindow window{{}, 0, static_cast<std::uint8_t>(rng.below(4 * w, 10))};
            for (std::size_t k = 0; k < 3; ++k)
                window.corner[k] = static_cast<std::uint16_t>(
                    rng.below(4 * w + k + 1, std::uint64_t{1} << window.level)
                    << (16 - window.level));
            windows.push_back(window);
        }
        std::vector<PartBits> open(windows.size());
        open_cubes(scene.near, scene.scales, windows, open.data());
        for (std::size_t w = 0; w < windows.size(); ++w)
            for (std::size_t part = 0; part < 64; ++part) {
                std::array<double, 3> corner;
                for (std::size_t k = 0; k < 3; ++k) corner[k] = windows[w].corner[k] * 0x1p-16;
                const bool is_open = (open[w] >> part & 1) != 0;
                open_parts += is_open ? 1 : 0;
                expect_right(
                    is_open,
                    scene.depth(corner, 0.25 / static_cast<double>(1U << windows[w].level), part),
                    fmt::format("seed {}, window {}, part {}", seed, w, part));
            }
    }
    EXPECT_GT(open_parts, 20'000);
    EXPECT_LT(open_parts, 270'000);
}

TEST(CubeWindows, PartsOfPartsAreThoseOfWindows) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const Scene scene(seed, seed % 40);
        const PartBits some = random_bits(seed, 0.3);
        std::array<OpenPart, 65> parts;
        const std::size_t count = open_parts(scene.near, scene.scales, some, parts.data());
        std::size_t next = 0;
        for (std::uint8_t part = 0; part < 64; ++part) {
            if ((some >> part & 1) == 0) continue;
            const bool listed = next < count && parts[next].part == part;
            const PartBits open = listed ? parts[next++].open : 0;
            if (listed) {
                EXPECT_NE(open, 0);
            }
            for (std::size_t small = 0; small < 64; ++small)
                expect_right(
                    (open >> small & 1) != 0,
                    scene.depth({0.25 * (part % 4), 0.25 * (part / 4 % 4), 0.25 * (part / 16)},
                                0.0625, small),
                    fmt::format("seed {}, part {}, {}", seed, part, small));
        }
        EXPECT_EQ(next, count);
    }
}

TEST(CubeWindows, HitsAreThoseOfAnyBall) {
    std::array<int, 2> counts{};
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const Scene scene(seed, seed % 40);
        const Rng rng(seed, 2);
        std::vector<std::array<float, 3>> places(10);
        for (std::size_t i = 0; i < 30; ++i)
            places[i / 3][i % 3] = static_cast<float>(rng.uniform(i)) * 0.5F;
        std::vector<Hit> hits(places.size());
        find_hits(scene.near, places, hits.data());
        for (std::size_t i = 0; i < places.size(); ++i) {
            const double depth = scene.depth({places[i][0], places[i][1], places[i][2]}, {0, 0, 0});
            if (std::abs(depth) < 2e-6) {
                EXPECT_EQ(hits[i], Hit::unsure);
            } else if (std::abs(depth) > 6e-6) {
                EXPECT_EQ(hits[i], depth > 0 ? Hit::yes : Hit::no) << seed << ", " << i;
                ++counts[depth > 0 ? 1 : 0];
            }
        }
    }
    EXPECT_GT(counts[0], 100);
    EXPECT_GT(counts[1], 100);
}

TEST(CubeWindows, NearPlacesAreFoundInAnyRun) {
    const Rng rng(5);
    std::array<std::vector<float>, 3> along;
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < 60; ++i)
            along[k].push_back(static_cast<float>(rng.uniform(3 * i + k)));
        along[k].resize(76, 1e9F);
    }
    const std::array<float, 3> place{0.4F, 0.5F, 0.6F};
    for (std::size_t first = 0; first < 60; first += 7)
        for (std::size_t last = first; last <= 60; ++last) {
            std::vector<std::uint16_t> expected;
            for (std::size_t i = first; i < last; ++i) {
                const double x = along[0][i] - place[0];
                const double y = along[1][i] - place[1];
                const double z = along[2][i] - place[2];
                if (x * x + y * y + z * z < 0.1) expected.push_back(static_cast<std::uint16_t>(i));
            }
            std::vector<std::uint16_t> found(60);
            found.resize(find_near({along[0].data(), along[1].data(), along[2].data()}, first, last,
                                   place, 0.1F, found.data()));
            EXPECT_EQ(found, expected) << first << " to " << last;
        }
}

// Every open part is within exactly one of the windows that are left, which are within the old one
// and have something open each.
TEST(CubeWindows, NarrowingLosesNothingAndKeepsNothingCovered) {
    const CubeWindow window = cube_at({0.625, 0.5, 0.25}, 7, 3);
    for (std::uint64_t seed = 0; seed < 400; ++seed)
        for (const double chance : {0.01, 0.03, 0.2, 1.0})
            for (const double darts : {0.1, 10.0}) {
                const PartBits open = random_bits(seed, chance);
                if (open == 0) continue;
                std::vector<CubeWindow> left;
                narrow_cube(window, open, darts, left);
                std::vector<int> found(64, 0);
                for (const CubeWindow& w : left) {
                    EXPECT_EQ(w.place, 7);
                    int within = 0;
                    for (std::size_t part = 0; part < 64; ++part) {
                        if ((open >> part & 1) == 0) continue;
                        bool inside = true;
                        for (std::size_t k = 0, rest = part; k < 3; ++k, rest /= 4) {
                            const int part_side = side_of(window) / 4;
                            const int low =
                                window.corner[k] + static_cast<int>(rest % 4) * part_side;
                            inside = inside && low >= w.corner[k] &&
                                     low + part_side <= w.corner[k] + side_of(w);
                        }
                        found[part] += inside ? 1 : 0;
                        within += inside ? 1 : 0;
                    }
                    EXPECT_GT(within, 0) << "seed " << seed;
                    for (std::size_t k = 0; k < 3; ++k) {
                        EXPECT_GE(w.corner[k], window.corner[k]);
                        EXPECT_LE(w.corner[k] + side_of(w), window.corner[k] + side_of(window));
                    }
                }
                for (std::size_t part = 0; part < 64; ++part)
                    EXPECT_EQ(found[part], static_cast<int>(open >> part & 1))
                        << "seed " << seed << ", part " << part;
            }
}

TEST(CubeWindows, NarrowToTheOpenPartsAndAreSplitOnceDartsHadTheirChance) {
    const CubeWindow window = cube_at({0.5, 0, 0}, 0, 1);
    std::vector<CubeWindow> left;
    narrow_cube(window, PartBits{1} << 63, 0, left);  // the last part
    ASSERT_EQ(left.size(), 1);
    EXPECT_EQ(left[0].level, 3);
    EXPECT_EQ(left[0].corner, cube_at({0.875, 0.375, 0.375}, 0, 3).corner);
    left.clear();
    narrow_cube(window, PartBits{3} << 22, 0, left);  // x 2 and 3, y 1, z 1
    ASSERT_EQ(left.size(), 1);
    EXPECT_EQ(left[0].level, 2);
    EXPECT_EQ(left[0].corner, cube_at({0.75, 0.125, 0.125}, 0, 2).corner);
    left.clear();
    narrow_cube(window, ~PartBits{0}, 0.5, left);
    ASSERT_EQ(left.size(), 1);
    EXPECT_EQ(left[0].level, 1);
    left.clear();
    narrow_cube(window, ~PartBits{0}, 2, left);
    EXPECT_EQ(left.size(), 8);
}

}  // namespace stipple::testing::cube_windows_test
