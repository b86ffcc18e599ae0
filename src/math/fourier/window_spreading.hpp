// SPDX-License-Identifier: MIT
//
// The innermost work of spreading points over a grid: the places of their windows, the windows'
// values, and the sums in the buffer of one tile of the grid.
//
// Promise the same bits on any machine: vectors do what plain code does, number by number.
// Beware  M x is never rounded to a double: the product's high part is exact, and the place between
//         two grid points keeps 52 bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/machine/vectors.hpp"
#include "math/fourier/kaiser_bessel.hpp"

namespace stipple {

/// A tile of the grid. All but its start and reach are the same for all tiles.
struct SpreadTile {
    double side = 0;                       ///< M
    double tiles = 0;                      ///< along an axis
    double shift = 0;                      ///< 1/2 for odd windows, which centre on a grid point
    double lead = 0;                       ///< grid points of the window before the point's cell
    std::size_t width = 0;                 ///< of the window
    unsigned piece_bits = 0;               ///< its table has 2^this pieces
    const double* coefficients = nullptr;  ///< of its table
    std::size_t numbers = 0;               ///< of a point: coordinates, and its strength
    std::size_t extent = 0;  ///< cells of a row of the buffer: a multiple of 8, from the widest
                             ///< tile and whole vectors on
    std::array<std::int64_t, 3> start{};           ///< its first cell, by coordinate
    std::array<std::size_t, 3> reach = {1, 1, 1};  ///< cells that its points touch
};

/// Finds the tiles in which the windows of points begin, and their places there: the t-th tile
/// along an axis begins at the grid point floor(t side / tiles), and the first axis counts fastest.
/// @param places rows of as many numbers: for each coordinate a word of 64 bits, of which the upper
///        12 count the grid points from the tile's first to the window's first one, and the lower
///        52 are the point's place behind a grid point, in [0, 1); strengths stay as they are.
void find_places(std::span<const double> rows, std::size_t dimension, const SpreadTile& common,
                 std::uint32_t* tile_of, double* places, Vectors widest = Vectors::eights);

/// Adds points whose windows begin in the tile to its buffer, extent^dimension cells.
/// @param widest vectors that may be used; the same bits with any.
void spread_points(std::span<const double> places, std::size_t dimension, const SpreadTile& tile,
                   double* buffer, Vectors widest = Vectors::eights);

}  // namespace stipple
