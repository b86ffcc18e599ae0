// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/space/ball_kernels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/machine/wide.hpp"
#include "generators/poisson_disk/space/ball_lines.hpp"

namespace stipple::poisson_disk {
namespace {

constexpr std::size_t layer = 16;  ///< number of sub-cells with the same third index

/// Positions of the sub-cells of a gap, relative to its middle; x + 4 y is the index in a layer.
struct Pattern {
    std::array<float, 3> side;  ///< sides of a sub-cell, in radii
    std::array<float, layer> along_x;
    std::array<float, layer> along_y;
    std::array<float, 4> along_z;

    Pattern(const std::array<float, 3>& scales, unsigned level) {
        for (std::size_t k = 0; k < 3; ++k)
            side[k] = scales[k] / static_cast<float>(std::size_t{4} << level);
        for (std::size_t i = 0; i < layer; ++i) {
            along_x[i] = side[0] * (static_cast<float>(i % 4) - 1.5F);
            along_y[i] = side[1] * (static_cast<float>(i / 4) - 1.5F);
        }
        for (std::size_t i = 0; i < 4; ++i) along_z[i] = side[2] * (static_cast<float>(i) - 1.5F);
    }
};

/// Squared distance along one direction to the far side of a sub-cell.
[[gnu::always_inline]] inline float far_square(float along, float from, float side) {
    const float far = std::abs(along - from) + side / 2;
    return far * far;
}

/// Sub-cells that no single ball covers: for every ball, the squared distance along x and y exceeds
/// the squared radius minus the squared distance along z.
[[gnu::always_inline]] inline SubcellBits open_gap(const NearDisks<3, float>& near,
                                                   const Pattern& p,
                                                   const std::array<float, 3>& middle) {
    constexpr std::size_t most = power(5, 3);  // number of balls
    float across[most][layer];                 // squared distances along x and y
    float left[4][most];                       // squared radius minus squared distance along z
    for (std::size_t i = 0; i < near.size(); ++i) {
        const float x = near.along(0)[i] - middle[0];
        const float y = near.along(1)[i] - middle[1];
        const float z = near.along(2)[i] - middle[2];
        for (std::size_t l = 0; l < layer; ++l)
            across[i][l] =
                far_square(p.along_x[l], x, p.side[0]) + far_square(p.along_y[l], y, p.side[1]);
        for (std::size_t k = 0; k < 4; ++k)
            left[k][i] = (1 - float_slack) - far_square(p.along_z[k], z, p.side[2]);
    }
    SubcellBits open = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        // If these loops were unrolled first, they would not be vectorised and `least` would leave
        // the registers.
        float least[layer];
        std::fill_n(least, layer, 1.0F);
        for (std::size_t i = 0; i < near.size(); ++i)
#pragma GCC unroll 1
            for (std::size_t l = 0; l < layer; ++l)
                least[l] = std::min(least[l], across[i][l] - left[k][i]);
        std::uint32_t bits = 0;
#pragma GCC unroll 1
        for (std::uint32_t l = 0; l < layer; ++l) bits |= least[l] < 0 ? 0U : 1U << l;
        open |= SubcellBits{bits} << (layer * k);
    }
    return open;
}

/// Sub-cells of a layer that a ball covers, on 16 adjacent lines: a ball reaches no more lines.
struct LineCover {
    /// Maximum radius of a ball in sub-cells, whose sides are at least an eighth of a radius.
    static constexpr int reach = 8;
    static constexpr std::size_t lines = 2 * reach;
    static constexpr int along = static_cast<int>(BallLines::along);

    int first;                       ///< index of the first line, from the cell's corner
    std::array<float, lines> far_y;  ///< squared distances to the far sides of the lines
    float x;  ///< centre in sub-cells, from a point `reach` sub-cells before the cell
    float per_side;
    int word;        ///< index of the word with the first bit
    unsigned shift;  ///< position of that bit

    [[gnu::always_inline]] inline LineCover(const std::array<float, 3>& scales,
                                            const PlacedBall& ball) {
        const float side = scales[1] / 4;
        first = std::min(static_cast<int>(ball.off[1] / side), 3) - (reach - 1);
        for (std::size_t l = 0; l < lines; ++l) {
            const float middle = static_cast<float>(static_cast<int>(l) + first) + 0.5F;
            // Lines beyond the tile count as far away, so that the ball does not cover them.
            const float from_tile =
                std::abs(middle + static_cast<float>(4 * ball.cell[1] - along / 2));
            const float beyond = std::max(from_tile - static_cast<float>(along / 2), 0.0F);
            const float far = std::abs(middle * side - ball.off[1]) + side / 2 + beyond * 16;
            far_y[l] = far * far;
        }
        per_side = 4 / scales[0];
        x = ball.off[0] * per_side + reach;
        const int bit = 4 * ball.cell[0] - reach;
        word = bit >> 5;
        shift = static_cast<unsigned>(bit & 31);
    }

    /// Bits of the covered sub-cells of a line, from the first one on.
    /// @param left squared radius minus the squared distance along the third direction
    [[nodiscard, gnu::always_inline]] inline std::int32_t of(std::size_t line, float left) const {
        const float half = std::sqrt(std::max(left - far_y[line], 0.0F)) * per_side;
        const auto from = static_cast<std::int32_t>(x - half) + 1;
        const auto to = static_cast<std::int32_t>(x + half);
        return std::max((1 << to) - (1 << from), 0);  // 0 if `to` is below `from`
    }
};

[[gnu::always_inline]] inline void cover_ball(const std::array<float, 3>& scales,
                                              const PlacedBall& ball, std::uint32_t* lines) {
    constexpr int reach = LineCover::reach;
    constexpr int along = LineCover::along;
    constexpr int words = static_cast<int>(BallLines::words);
    const LineCover cover(scales, ball);
    const bool in_first = cover.word >= 0 && cover.word < words;
    const bool in_next = cover.shift > 12 && cover.word + 1 >= 0 && cover.word + 1 < words;
    const float side = scales[2] / 4;
    const int middle = static_cast<int>(ball.off[2] / side);
    const int above = 4 * ball.cell[2];
    const int low = std::max(middle - (reach - 1), -above);
    const int high = std::min(middle + reach, along - above);
    lines += static_cast<int>(BallLines::pad) + cover.word * along + 4 * ball.cell[1] + cover.first;
    for (int z = low; z < high; ++z) {
        const float far = std::abs((static_cast<float>(z) + 0.5F) * side - ball.off[2]) + side / 2;
        const float left = (1 - float_slack) - far * far;
        if (left <= 0) continue;
        std::uint32_t bits[LineCover::lines];
        for (std::size_t l = 0; l < LineCover::lines; ++l)
            bits[l] = static_cast<std::uint32_t>(cover.of(l, left));
        std::uint32_t* const to = lines + (above + z) * static_cast<int>(BallLines::layer);
        if (in_first)
            for (std::size_t l = 0; l < LineCover::lines; ++l) to[l] |= bits[l] << cover.shift;
        if (in_next)
            for (std::size_t l = 0; l < LineCover::lines; ++l)
                to[along + l] |= bits[l] >> (32 - cover.shift);
    }
}

}  // namespace

STIPPLE_WIDE void cover_lines(const std::array<float, 3>& scales, std::span<const PlacedBall> balls,
                              std::uint32_t* lines) {
    for (const PlacedBall& ball : balls) cover_ball(scales, ball, lines);
}

STIPPLE_WIDE void open_gaps(const NearDisks<3, float>& near, const std::array<float, 3>& scales,
                            std::span<const Gap<3>> gaps, SubcellBits* out) {
    for (std::size_t i = 0; i < gaps.size();) {
        const unsigned level = gaps[i].level;
        const Pattern pattern(scales, level);
        for (; i < gaps.size() && gaps[i].level == level; ++i) {
            std::array<float, 3> middle;
            for (std::size_t k = 0; k < 3; ++k)
                middle[k] = static_cast<float>(gaps[i].corner[k]) * scales[k] + 2 * pattern.side[k];
            *out++ = open_gap(near, pattern, middle);
        }
    }
}

STIPPLE_WIDE void open_subcells(const NearDisks<3, float>& near, const std::array<float, 3>& scales,
                                SubcellBits some, SubcellBits* out) {
    const Pattern pattern(scales, 2);
    for (; some != 0; some &= some - 1) {
        const int number = std::countr_zero(some);
        std::array<float, 3> middle;
        for (std::size_t k = 0; k < 3; ++k)
            middle[k] = static_cast<float>((number >> (2 * k) & 3) * 4 + 2) * pattern.side[k];
        *out++ = open_gap(near, pattern, middle);
    }
}

}  // namespace stipple::poisson_disk
