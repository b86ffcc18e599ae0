// SPDX-License-Identifier: MIT
//
// Where the points of a tile of cells in the plane are, in 16 bits along each direction, so that
// the 25 cells about a place are looked at by ten loads, four cells at a time.
//
// Coordinates count 1/8192 of the radius and go around every 8 radii. All that is compared lies
// within three cells, at most 2.2 radii, so that differences modulo 2^16 are right. A cell without
// a point has what is 4 radii to the side of its middle, and so nearer than a radius to nothing
// that is compared with it.
//
// Shape   rows of up to 64 cells, with two more at each end.
// Promise distances are off by less than `position_slack` units.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "generators/poisson_disk/near_disks.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace stipple::poisson_disk {

struct FixedPosition {
    std::int16_t x;
    std::int16_t y;
};

inline constexpr double units_per_radius = 8192;
inline constexpr double position_slack = 2;

/// Squared distances from one position to four that lie one behind the other.
class FourSquares {
  public:
    FourSquares() = default;

#if defined(__SSE2__)
    [[gnu::always_inline]] FourSquares(const FixedPosition* four, FixedPosition from) {
        const __m128i there = _mm_loadu_si128(reinterpret_cast<const __m128i*>(four));
        const __m128i off = _mm_sub_epi16(there, _mm_set1_epi32(std::bit_cast<int>(from)));
        squares_ = _mm_madd_epi16(off, off);
    }

    /// Bit i says whether the i-th of one of them is smaller.
    template <std::size_t N>
    [[nodiscard, gnu::always_inline]] static unsigned below(const std::array<FourSquares, N>& all,
                                                            std::int32_t limit) {
        const __m128i limits = _mm_set1_epi32(limit);
        __m128i smaller = _mm_setzero_si128();
        for (const FourSquares& each : all)
            smaller = _mm_or_si128(smaller, _mm_cmplt_epi32(each.squares_, limits));
        return static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(smaller)));
    }

  private:
    __m128i squares_;
#else
    FourSquares(const FixedPosition* four, FixedPosition from) {
        for (std::size_t i = 0; i < 4; ++i) {
            const int x = static_cast<std::int16_t>(four[i].x - from.x);
            const int y = static_cast<std::int16_t>(four[i].y - from.y);
            squares_[i] = x * x + y * y;  // y is small, so that this is below 2^31
        }
    }

    template <std::size_t N>
    [[nodiscard]] static unsigned below(const std::array<FourSquares, N>& all, std::int32_t limit) {
        unsigned bits = 0;
        for (const FourSquares& each : all)
            for (std::size_t i = 0; i < 4; ++i) bits |= (each.squares_[i] < limit ? 1U : 0U) << i;
        return bits;
    }

  private:
    std::array<std::int32_t, 4> squares_;
#endif
};

/// The positions of a tile's cells.
class FixedPositions {
  public:
    FixedPositions() = default;

    static constexpr std::size_t halo = 2;  ///< cells of other tiles about those of the tile
    static constexpr std::size_t stride = 64 + 2 * halo;

    /// Positions that a tile of so many rows of cells needs.
    static constexpr std::size_t needed(std::size_t rows) { return (rows + 2 * halo) * stride; }

    /// @param origin of the tile's first cell; @param cell sides of a cell; both in units
    /// @param rows of cells; @param room for the positions
    FixedPositions(const std::array<double, 2>& origin, const std::array<double, 2>& cell,
                   std::size_t rows, FixedPosition* room)
        : origin_(origin), cell_(cell), positions_(room) {
        for (std::size_t y = 0; y < rows + 2 * halo; ++y)
            for (std::size_t x = 0; x < stride; ++x) {
                const double to_middle = 0.5 - double{halo};
                positions_[y * stride + x] = {
                    wrapped(origin[0] + cell[0] * to_middle + cell[0] * static_cast<double>(x) +
                            half_turn),
                    wrapped(origin[1] + cell[1] * to_middle + cell[1] * static_cast<double>(y))};
            }
    }

    /// The position of a place, in cells from the tile's first.
    [[nodiscard]] FixedPosition position_of(double x, double y) const {
        return {wrapped(origin_[0] + cell_[0] * x), wrapped(origin_[1] + cell_[1] * y)};
    }

    /// A cell's position and those behind it.
    [[nodiscard]] const FixedPosition* from(std::size_t number) const {
        return positions_ + number;
    }

    void put(std::size_t number, FixedPosition position) { positions_[number] = position; }

    /// Number of a cell, counted from the first one of the halo.
    static constexpr std::size_t number(std::size_t x, std::size_t y) { return y * stride + x; }

    /// Whether one of the points in the 25 cells from `first` on covers a place in their middle.
    /// @param sure, possible squared distances below which it does, and from which on it does not
    [[nodiscard, gnu::always_inline]] Hit hit(std::size_t first, FixedPosition place,
                                              std::int32_t sure, std::int32_t possible) const {
        const FixedPosition* row = positions_ + first;
        std::array<FourSquares, 10> squares;
        for (std::size_t y = 0; y < 5; ++y, row += stride) {
            squares[2 * y] = {row, place};
            squares[2 * y + 1] = {row + 1, place};
        }
        if (FourSquares::below(squares, possible) == 0) return Hit::no;
        return FourSquares::below(squares, sure) != 0 ? Hit::yes : Hit::unsure;
    }

    /// Calls visit(position) for those of the points in 25 cells that are nearer than that.
    template <class Visit>
    [[gnu::always_inline]] void for_near(std::size_t first, FixedPosition place,
                                         std::int32_t squared, const Visit& visit) const {
        for (std::size_t y = 0; y < 5; ++y, first += stride) {
            const FixedPosition* row = positions_ + first;
            const std::array<FourSquares, 1> four{FourSquares(row, place)};
            const std::array<FourSquares, 1> last{FourSquares(row + 1, place)};
            unsigned found = FourSquares::below(four, squared);
            found |= (FourSquares::below(last, squared) & 8U) << 1;
            for (; found != 0; found &= found - 1) visit(row[std::countr_zero(found)]);
        }
    }

  private:
    static constexpr double half_turn = 32768;

    /// Modulo 2^16; units are few, and none farther below 0 than the halo is wide.
    static std::int16_t wrapped(double units) {
        return static_cast<std::int16_t>(
            static_cast<std::uint16_t>(static_cast<std::int64_t>(units + 2 * half_turn)));
    }

    std::array<double, 2> origin_{};
    std::array<double, 2> cell_{};
    FixedPosition* positions_ = nullptr;
};

}  // namespace stipple::poisson_disk
