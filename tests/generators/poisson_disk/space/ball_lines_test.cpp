// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/space/ball_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "core/rng.hpp"
#include "generators/poisson_disk/near_disks.hpp"

namespace stipple::testing::ball_lines_test {
using namespace stipple::poisson_disk;

namespace {

using Lines = std::vector<std::uint32_t>;

constexpr int lines_across = static_cast<int>(BallLines::along);

bool is_set(const Lines& lines, const std::array<int, 3>& part) {
    const auto x = static_cast<std::size_t>(part[0]);
    const std::size_t at =
        BallLines::at(x / 32, static_cast<std::size_t>(part[1]), static_cast<std::size_t>(part[2]));
    return (lines[at] >> (x % 32) & 1) != 0;
}

/// Squared distance from the ball's centre to the farthest corner of a part of the tile.
double farthest(const PlacedBall& ball, const std::array<int, 3>& part,
                const std::array<float, 3>& scales) {
    double squared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double side = double{scales[k]} / 4;
        const double low = (part[k] - 4 * ball.cell[k]) * side - double{ball.off[k]};
        const double far = std::max(std::abs(low), std::abs(low + side));
        squared += far * far;
    }
    return squared;
}

/// A ball in any cell of a tile, or of the two layers around it.
PlacedBall ball_anywhere(const Rng& rng, std::uint64_t i, const std::array<float, 3>& scales) {
    PlacedBall ball{};
    for (std::size_t k = 0; k < 3; ++k) {
        ball.cell[k] = static_cast<int>(rng.below(10 * i + k, space_side + 4)) - 2;
        ball.off[k] = static_cast<float>(rng.uniform(10 * i + 3 + k)) * scales[k];
    }
    return ball;
}

}  // namespace

// Exactly those parts of the tile that the ball covers.
TEST(BallLines, AreWhatABallCoversOfATile) {
    const Rng rng(1);
    for (const std::array<float, 3>& scales :
         {std::array{0.577F, 0.577F, 0.577F}, {0.501F, 0.55F, 0.577F}, {0.577F, 0.501F, 0.53F}}) {
        std::size_t set = 0;
        for (std::uint64_t i = 0; i < 120; ++i) {
            PlacedBall ball = ball_anywhere(rng, i, scales);
            if (i < 8)  // at corners of tile and cell, rounded up to the next cell
                for (std::size_t k = 0; k < 3; ++k) {
                    ball.cell[k] = (i >> k & 1) != 0 ? space_side + 1 : -2;
                    ball.off[k] = (i >> k & 1) != 0 ? 0 : scales[k];
                }
            Lines lines(BallLines::room);
            cover_lines(scales, {&ball, 1}, lines.data());
            std::array<std::pair<int, int>, 3> near;
            for (std::size_t k = 0; k < 3; ++k)
                near[k] = {std::max(4 * ball.cell[k] - 10, 0),
                           std::min(4 * ball.cell[k] + 14, lines_across)};
            std::size_t here = 0;
            for (int z = near[2].first; z < near[2].second; ++z)
                for (int y = near[1].first; y < near[1].second; ++y)
                    for (int x = near[0].first; x < near[0].second; ++x) {
                        const bool is = is_set(lines, {x, y, z});
                        here += is ? 1 : 0;
                        const double far = farthest(ball, {x, y, z}, scales);
                        if (std::abs(far - 1 + float_slack) > 2e-6) {
                            EXPECT_EQ(is, far < 1 - float_slack)
                                << i << ": " << x << " " << y << " " << z;
                        }
                        if (is) {
                            EXPECT_LT(far, 1) << i;
                        }
                    }
            std::size_t all = 0;
            for (const std::uint32_t word : lines) all += std::popcount(word);
            EXPECT_EQ(all, here) << i;  // no bits far from the ball or outside the tile
            set += all;
        }
        EXPECT_GT(set / 120, 400U);
    }
}

TEST(BallLines, StayWhereOtherBallsAreAdded) {
    const Rng rng(2);
    const std::array<float, 3> scales{0.577F, 0.577F, 0.577F};
    std::vector<PlacedBall> balls;
    Lines one_by_one(BallLines::room);
    for (std::uint64_t i = 0; i < 300; ++i) {
        balls.push_back(ball_anywhere(rng, i, scales));
        Lines alone(BallLines::room);
        cover_lines(scales, {&balls.back(), 1}, alone.data());
        for (std::size_t w = 0; w < alone.size(); ++w) one_by_one[w] |= alone[w];
    }
    Lines together(BallLines::room);
    cover_lines(scales, balls, together.data());
    EXPECT_EQ(together, one_by_one);
}

TEST(BallLines, AreReadByCells) {
    const Rng rng(3);
    Lines lines(BallLines::room);
    for (std::size_t w = 0; w < lines.size(); ++w)
        lines[w] = static_cast<std::uint32_t>(rng.bits(w));
    for (std::uint64_t i = 0; i < 200; ++i) {
        TileCell<3> cell{};
        for (std::size_t k = 0; k < 3; ++k)
            cell[k] = static_cast<int>(rng.below(1'000'000 + 3 * i + k, space_side));
        const SubcellBits there = subcells_of(lines.data(), cell);
        for (std::size_t part = 0; part < 64; ++part) {
            const auto step = static_cast<int>(part);
            const bool is = is_set(lines, {4 * cell[0] + step % 4, 4 * cell[1] + step / 4 % 4,
                                           4 * cell[2] + step / 16});
            EXPECT_EQ((there >> part & 1) != 0, is);
        }
    }
}

}  // namespace stipple::testing::ball_lines_test
