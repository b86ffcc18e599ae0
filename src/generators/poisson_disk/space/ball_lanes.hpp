// SPDX-License-Identifier: MIT
//
// Kernels on balls, for as many floats as a vector holds. This is no header of its own:
// core/machine/vector_widths.hpp includes it for ball_kernels.cpp, once for each width.

constexpr std::size_t lanes = STIPPLE_VECTOR_BITS / 32;
using V [[gnu::vector_size(4 * lanes)]] = float;
using Bits [[gnu::vector_size(4 * lanes)]] = std::int32_t;

STIPPLE_INLINE V load(const float* from) {
    V v;
    std::memcpy(&v, from, sizeof v);
    return v;
}

/// A number in all lanes.
STIPPLE_INLINE V same(float x) { return x - V{}; }

STIPPLE_INLINE V absolute(V x) { return (V)((Bits)x & 0x7fffffff); }
STIPPLE_INLINE V larger(V x, V y) { return x > y ? x : y; }
STIPPLE_INLINE V smaller(V x, V y) { return x < y ? x : y; }

/// A bit for each lane that is set.
STIPPLE_INLINE unsigned set_in(Bits set) {
#if STIPPLE_VECTOR_BITS == 512
    return _mm512_movepi32_mask((__m512i)set);
#elif STIPPLE_VECTOR_BITS == 256
    return static_cast<unsigned>(_mm256_movemask_ps((__m256)set));
#elif defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_ps((__m128)set));
#else
    unsigned bits = 0;
    for (std::size_t l = 0; l < lanes; ++l) bits |= static_cast<unsigned>(set[l] & (1 << l));
    return bits;
#endif
}

/// A bit for each lane in which a is less than b.
STIPPLE_INLINE unsigned below(V a, V b) { return set_in(a < b); }

/// What is open of 64 sub-cells: where no ball has left more of its squared radius along the third
/// direction than the other two take.
struct Open {
    static constexpr std::size_t rows = 16 / lanes;
    std::array<std::array<V, rows>, 4> least;  ///< what they take less what is left

    STIPPLE_INLINE Open() {
        for (auto& layer : least) layer.fill(same(1));
    }
    STIPPLE_INLINE void cover(std::size_t layer, std::size_t row, V taken, float left) {
        least[layer][row] = smaller(least[layer][row], taken - left);
    }
    [[nodiscard]] STIPPLE_INLINE SubcellBits bits() const {
        SubcellBits covered = 0;
        for (std::size_t layer = 0; layer < 4; ++layer)
            for (std::size_t row = 0; row < rows; ++row)
                covered |= SubcellBits{set_in((Bits)least[layer][row])}
                           << (16 * layer + lanes * row);
        return ~covered;
    }
};

/// Where the sub-cells of gaps of a size lie, from their middle: lane x + 4 y of a row of vectors.
struct Pattern {
    static constexpr std::size_t rows = 16 / lanes;
    std::array<float, 3> side;  ///< of a sub-cell
    V along_x;
    V along_z;
    std::array<V, rows> along_y;

    STIPPLE_INLINE Pattern(const std::array<float, 3>& scales, unsigned level) {
        for (std::size_t k = 0; k < 3; ++k)
            side[k] = scales[k] / static_cast<float>(std::size_t{4} << level);
        for (std::size_t l = 0; l < lanes; ++l) {
            const float step = static_cast<float>(l % 4) - 1.5F;
            along_x[l] = side[0] * step;
            along_z[l] = side[2] * step;
            for (std::size_t row = 0; row < rows; ++row)
                along_y[row][l] = side[1] * (static_cast<float>((row * lanes + l) / 4) - 1.5F);
        }
    }
};

/// Squared distance to the far side of a sub-cell along one direction.
STIPPLE_INLINE V far_square(V along, V from, float side) {
    const V far = absolute(along - from) + side / 2;
    return far * far;
}

/// Balls that may cover a sub-cell: the square of the distance to the farthest corner of the
/// nearest one is at least this, which is exact beyond its middle.
STIPPLE_INLINE unsigned may_cover(const Pattern& p, V x, V y, V z) {
    const V far_x = larger(absolute(x) - p.side[0], same(p.side[0] / 2));
    const V far_y = larger(absolute(y) - p.side[1], same(p.side[1] / 2));
    const V far_z = larger(absolute(z) - p.side[2], same(p.side[2] / 2));
    return below(far_x * far_x + far_y * far_y + far_z * far_z, same(1));
}

STIPPLE_INLINE SubcellBits open_gap(const NearBalls& near, const Pattern& p,
                                    const std::array<float, 3>& middle) {
    Open open;
    for (std::size_t i = 0; i < near.size; i += lanes) {
        const V x = load(&near.at[0][i]) - middle[0];
        const V y = load(&near.at[1][i]) - middle[1];
        const V z = load(&near.at[2][i]) - middle[2];
        for (unsigned found = may_cover(p, x, y, z); found != 0; found &= found - 1) {
            const std::size_t j = i + static_cast<std::size_t>(std::countr_zero(found));
            const V far_x = far_square(p.along_x, same(near.at[0][j] - middle[0]), p.side[0]);
            const V from_y = same(near.at[1][j] - middle[1]);
            const V left = (1 - float_slack) -
                           far_square(p.along_z, same(near.at[2][j] - middle[2]), p.side[2]);
            for (std::size_t row = 0; row < Pattern::rows; ++row) {
                const V sum = far_x + far_square(p.along_y[row], from_y, p.side[1]);
                for (std::size_t layer = 0; layer < 4; ++layer)
                    open.cover(layer, row, sum, left[layer]);
            }
        }
    }
    return open.bits();
}

STIPPLE_INLINE V square_root(V x) {
    V roots;
    for (std::size_t l = 0; l < lanes; ++l) roots[l] = std::sqrt(x[l]);
    return roots;
}

/// Sixteen lines of sub-cells beside each other that a ball reaches, for each layer of them.
struct LineCover {
    static constexpr std::size_t rows = 16 / lanes;
    /// A ball reaches seven sub-cells to each side, and into an eighth.
    static constexpr int reach = 8;
    static constexpr int words = static_cast<int>(BallLines::words);
    static constexpr int along = static_cast<int>(BallLines::along);

    int first;                  ///< line, from the cell's corner
    std::array<V, rows> far_y;  ///< squared distances to the far sides of the lines
    float x;                    ///< of the centre, from `reach` sub-cells before the cell, in these
    float per_side;
    int word;        ///< with the first bit
    unsigned shift;  ///< of that

    STIPPLE_INLINE LineCover(const std::array<float, 3>& scales, const PlacedBall& ball) {
        const float side = scales[1] / 4;
        first = std::min(static_cast<int>(ball.off[1] / side), 3) - (reach - 1);
        V ramp;
        for (std::size_t l = 0; l < lanes; ++l) ramp[l] = static_cast<float>(l) + 0.5F;
        for (std::size_t row = 0; row < rows; ++row) {
            const V middle = ramp + static_cast<float>(first + static_cast<int>(row * lanes));
            // Lines beyond the tile are far away.
            const V from_tile = absolute(middle + static_cast<float>(4 * ball.cell[1] - along / 2));
            const V beyond = larger(from_tile - static_cast<float>(along / 2), V{});
            const V far = absolute(middle * side - ball.off[1]) + side / 2 + beyond * 16;
            far_y[row] = far * far;
        }
        per_side = 4 / scales[0];
        x = ball.off[0] * per_side + reach;
        const int bit = 4 * ball.cell[0] - reach;
        word = bit >> 5;
        shift = static_cast<unsigned>(bit & 31);
    }

    /// Bits, from the first one on, of the sub-cells that are not farther than that.
    /// @param left what is left of the squared radius
    [[nodiscard]] STIPPLE_INLINE Bits of(std::size_t row, float left) const {
        const V half = square_root(larger(left - far_y[row], V{})) * per_side;
        const Bits from = __builtin_convertvector(x - half, Bits) + 1;
        const Bits to = __builtin_convertvector(x + half, Bits);
        const Bits one = Bits{} + 1;
        const Bits bits = (one << to) - (one << from);
        return bits > 0 ? bits : Bits{};  // to may be before from
    }
};

STIPPLE_INLINE void add_bits(Bits bits, std::uint32_t* to) {
    Bits all;
    std::memcpy(&all, to, sizeof all);
    all |= bits;
    std::memcpy(to, &all, sizeof all);
}

STIPPLE_INLINE void cover_ball(const std::array<float, 3>& scales, const PlacedBall& ball,
                               std::uint32_t* lines) {
    using Words [[gnu::vector_size(4 * lanes)]] = std::uint32_t;
    constexpr int reach = LineCover::reach;
    constexpr int along = LineCover::along;
    const LineCover cover(scales, ball);
    const bool in_first = cover.word >= 0 && cover.word < LineCover::words;
    const bool in_next =
        cover.shift > 12 && cover.word + 1 >= 0 && cover.word + 1 < LineCover::words;
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
        std::uint32_t* const to = lines + (above + z) * static_cast<int>(BallLines::layer);
        for (std::size_t row = 0; row < LineCover::rows; ++row) {
            const Bits bits = cover.of(row, left);
            if (in_first) add_bits(bits << cover.shift, to + row * lanes);
            if (in_next)
                add_bits((Bits)((Words)bits >> (32 - cover.shift)), to + along + row * lanes);
        }
    }
}

void cover_lines(const std::array<float, 3>& scales, std::span<const PlacedBall> balls,
                 std::uint32_t* lines) {
    for (const PlacedBall& ball : balls) cover_ball(scales, ball, lines);
}

void open_gaps(const NearBalls& near, const std::array<float, 3>& scales,
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

void open_subcells(const NearBalls& near, const std::array<float, 3>& scales, SubcellBits some,
                   SubcellBits* out) {
    const Pattern pattern(scales, 2);
    for (; some != 0; some &= some - 1) {
        const int number = std::countr_zero(some);
        std::array<float, 3> middle;
        for (std::size_t k = 0; k < 3; ++k)
            middle[k] = static_cast<float>((number >> (2 * k) & 3) * 4 + 2) * pattern.side[k];
        *out++ = open_gap(near, pattern, middle);
    }
}

Hit find_hit(const NearBalls& near, const std::array<float, 3>& place) {
    V least = same(2);
    for (std::size_t i = 0; i < near.size; i += lanes) {
        const V x = load(&near.at[0][i]) - place[0];
        const V y = load(&near.at[1][i]) - place[1];
        const V z = load(&near.at[2][i]) - place[2];
        least = smaller(least, x * x + y * y + z * z);
    }
    if (below(least, same(1 - float_slack)) != 0) return Hit::yes;
    return below(least, same(1 + float_slack)) != 0 ? Hit::unsure : Hit::no;
}
