// SPDX-License-Identifier: MIT
//
// Coverage of a tile of cells in space by balls, with one bit for each of the 4 x 4 x 4 sub-cells
// of a cell. A word has 32 sub-cells of a line along the first direction; the words of adjacent
// lines follow each other.
//
// A ball covers a sub-cell if it covers the corner farthest from its centre. On a line, these are
// the sub-cells between two ends. Finding them takes a square root, for many lines side by side.
//
// Cost    0.25 us for a ball.
// Promise the bit of a sub-cell is set exactly if a single ball covers the sub-cell, and not within
//         float_slack of the ball's rim.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "generators/poisson_disk/gaps.hpp"
#include "generators/poisson_disk/grid.hpp"

namespace stipple::poisson_disk {

/// Cells along each side of a tile.
inline constexpr int space_side = 1 << space_tile_bits;

struct BallLines {
    static constexpr std::size_t along = 4 * space_side;  ///< sub-cells along each direction
    static constexpr std::size_t words = along / 32;      ///< words in a line
    static constexpr std::size_t layer = words * along;
    static constexpr std::size_t pad = 16;  ///< padding at both ends; kernels write to it, too
    static constexpr std::size_t room = along * layer + 2 * pad;

    /// Index of word number `word` of the line (y, z).
    static constexpr std::size_t at(std::size_t word, std::size_t y, std::size_t z) {
        return pad + z * layer + word * along + y;
    }
};

/// A ball, by its centre.
struct PlacedBall {
    TileCell<3> cell;          ///< cell with the centre: in the tile, or up to two cells beyond it
    std::array<float, 3> off;  ///< centre, from that cell's corner, in radii
};

/// Adds the coverage by balls to a tile.
/// @param scales sides of a cell, in radii, at least 1/2
/// @param lines BallLines::room words
void cover_lines(const std::array<float, 3>& scales, std::span<const PlacedBall> balls,
                 std::uint32_t* lines);

/// Word of the first of the 4 x 4 lines through a cell; it also covers seven neighbouring cells.
inline const std::uint32_t* lines_of(const std::uint32_t* lines, const TileCell<3>& cell) {
    return lines + BallLines::at(static_cast<std::size_t>(cell[0]) / 8,
                                 4 * static_cast<std::size_t>(cell[1]),
                                 4 * static_cast<std::size_t>(cell[2]));
}

/// Coverage of the sub-cells of a cell.
inline SubcellBits subcells_of(const std::uint32_t* lines, const TileCell<3>& cell) {
    const unsigned shift = 4 * (static_cast<unsigned>(cell[0]) % 8);
    const std::uint32_t* from = lines_of(lines, cell);
    SubcellBits bits = 0;
    for (std::size_t z = 0; z < 4; ++z, from += BallLines::layer)
        for (std::size_t y = 0; y < 4; ++y)
            bits |= SubcellBits{from[y] >> shift & 15} << (16 * z + 4 * y);
    return bits;
}

}  // namespace stipple::poisson_disk
