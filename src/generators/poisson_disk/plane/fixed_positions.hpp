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

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "generators/poisson_disk/near_disks.hpp"

namespace stipple::poisson_disk {

struct FixedPosition {
    std::int16_t x;
    std::int16_t y;
};

inline constexpr double units_per_radius = 8192;
inline constexpr double position_slack = 2;

using FourNumbers [[gnu::vector_size(16)]] = std::int32_t;

/// Squared distances from one position to four that lie one behind the other.
[[gnu::always_inline]] inline FourNumbers four_squares(const FixedPosition* four,
                                                       FixedPosition from) {
    using Halves [[gnu::vector_size(16)]] = std::uint16_t;
    Halves off;
    std::memcpy(&off, four, sizeof off);
    off -= (Halves)(FourNumbers{} + std::bit_cast<std::int32_t>(from));
    const FourNumbers x = (FourNumbers)off << 16 >> 16;
    const FourNumbers y = (FourNumbers)off >> 16;
    return x * x + y * y;  // y is small, so that this is below 2^31
}

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
        FourNumbers least = FourNumbers{} + possible;
        for (std::size_t y = 0; y < 5; ++y, row += stride)
            for (std::size_t x = 0; x < 2; ++x) {
                const FourNumbers squares = four_squares(row + x, place);
                least = squares < least ? squares : least;
            }
        const std::int32_t nearest =
            std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
        return nearest < sure ? Hit::yes : nearest < possible ? Hit::unsure : Hit::no;
    }

    /// Calls visit(position) for those of the points in 25 cells that are nearer than that.
    template <class Visit>
    [[gnu::always_inline]] void for_near(std::size_t first, FixedPosition place,
                                         std::int32_t squared, const Visit& visit) const {
        for (std::size_t y = 0; y < 5; ++y, first += stride)
            for (std::size_t x = 0; x < 5; ++x) {
                const FixedPosition& p = positions_[first + x];
                const int across = static_cast<std::int16_t>(p.x - place.x);
                const int up = static_cast<std::int16_t>(p.y - place.y);
                if (across * across + up * up < squared) visit(p);
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
