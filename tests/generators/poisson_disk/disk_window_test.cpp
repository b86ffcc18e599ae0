// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/disk_window.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"

namespace stipple::testing::disk_window_test {
namespace {

template <std::size_t D>
OpenParts<D> random_parts(std::uint64_t seed, double chance) {
    const Rng rng(seed);
    OpenParts<D> open{};
    for (std::size_t line = 0; line < lines<D>; ++line)
        for (std::size_t i = 0; i < parts<D>; ++i)
            if (rng.uniform(line * parts<D> + i) < chance)
                open[line] |= static_cast<std::uint8_t>(1U << i);
    return open;
}

/// Whether [low, low + side) is in the window.
template <std::size_t D>
bool holds(const Window<D>& window, const std::array<double, D>& low, double side) {
    bool inside = true;
    for (std::size_t k = 0; k < D; ++k)
        inside = inside && low[k] >= window.corner[k] &&
                 low[k] + side <= window.corner[k] + window.side();
    return inside;
}

/// What is open stays within exactly one window, and windows stay within the old one.
template <std::size_t D>
void expect_nothing_lost(std::uint64_t seed, double chance, double darts) {
    Window<D> window{.corner = {}, .place = 7, .level = 3};
    window.corner.fill(0.625);
    const OpenParts<D> open = random_parts<D>(seed, chance);
    if (count_open<D>(open) == 0) return;
    std::vector<Window<D>> left;
    narrow<D>(window, open, darts, left);
    for (const Window<D>& w : left) {
        EXPECT_TRUE(holds<D>(window, w.corner, w.side()));
        EXPECT_EQ(w.place, 7);
    }
    for (std::size_t n = 0; n < count_open<D>(open); ++n) {
        std::array<double, D> low = open_part<D>(open, n);
        for (double& x : low) x = 0.625 + x * window.part();
        int found = 0;
        for (const Window<D>& w : left) found += holds<D>(w, low, window.part());
        EXPECT_EQ(found, 1) << D << "-D, seed " << seed << ", part " << n;
    }
}

}  // namespace

TEST(DiskWindow, NarrowingLosesNothing) {
    for (std::uint64_t seed = 0; seed < 100; ++seed)
        for (const double chance : {0.02, 0.1, 0.5, 1.0})
            for (const double darts : {0.1, 10.0}) {
                expect_nothing_lost<2>(seed, chance, darts);
                expect_nothing_lost<3>(seed, chance, darts);
                expect_nothing_lost<4>(seed, chance, darts);
                expect_nothing_lost<5>(seed, chance, darts);
                expect_nothing_lost<6>(seed, chance, darts);
            }
}

// 8 x 8 parts, open where x = 5, 6 and y = 6: a window of a quarter of the side holds them.
TEST(DiskWindow, NarrowsToTheOpenParts) {
    const Window<2> window{.corner = {0, 0}, .place = 0, .level = 0};
    OpenParts<2> open{};
    open[6] = 0b0110'0000;
    std::vector<Window<2>> left;
    narrow<2>(window, open, 0, left);
    ASSERT_EQ(left.size(), 1);
    EXPECT_EQ(left[0].level, 2);
    EXPECT_EQ(left[0].corner, (std::array<double, 2>{5. / 8, 6. / 8}));
    EXPECT_EQ(count_open<2>(open), 2);
    EXPECT_EQ(open_part<2>(open, 1), (std::array<double, 2>{6, 6}));
}

// One that is open from end to end waits for darts before it is split.
TEST(DiskWindow, IsSplitOnceDartsHadTheirChance) {
    const Window<2> window{.corner = {0, 0}, .place = 0, .level = 0};
    OpenParts<2> open{};
    open[0] = 0b1000'0001;
    std::vector<Window<2>> left;
    narrow<2>(window, open, 0.5, left);
    ASSERT_EQ(left.size(), 1);
    EXPECT_EQ(left[0].level, 0);
    left.clear();
    narrow<2>(window, open, 5, left);
    ASSERT_EQ(left.size(), 2);
    EXPECT_EQ(left[0].corner, (std::array<double, 2>{0, 0}));
    EXPECT_EQ(left[1].corner, (std::array<double, 2>{0.5, 0}));
    EXPECT_EQ(left[1].level, 1);
}

}  // namespace stipple::testing::disk_window_test
