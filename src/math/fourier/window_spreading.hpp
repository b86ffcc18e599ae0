// SPDX-License-Identifier: MIT
//
// Inner loops that spread points over a grid: they locate the points' windows, evaluate them, and
// add them to the buffer of a tile of the grid.
//
// Promise the same bits on any machine: vectors compute the same as scalar code.
// Beware  M x is never rounded to a double: the product's high part is exact, and the position
//         between two grid points keeps 52 bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/machine/vectors.hpp"
#include "math/fourier/kaiser_bessel.hpp"

namespace stipple {

/// A tile of the grid. Only `start` and `reach` differ between tiles.
struct SpreadTile {
    double side = 0;                       ///< M, the cells along an axis
    double tiles = 0;                      ///< number of tiles along an axis
    double shift = 0;                      ///< 1/2 for odd windows, which centre on a grid point
    double lead = 0;                       ///< grid points of the window before the point's cell
    std::size_t width = 0;                 ///< width of the window, in grid points
    unsigned piece_bits = 0;               ///< the window's table has 2^piece_bits pieces
    const double* coefficients = nullptr;  ///< coefficients of the window's table
    std::size_t numbers = 0;               ///< numbers per point: coordinates, then any strength
    /// Cells in a row of the buffer: a multiple of 8, enough for the widest tile and whole vectors.
    std::size_t extent = 0;
    std::array<std::int64_t, 3> start{};           ///< first cell, by axis
    std::array<std::size_t, 3> reach = {1, 1, 1};  ///< cells that its windows touch, by axis
};

/// Finds the tiles in which the windows of points begin, and their positions there. The t-th tile
/// along an axis begins at the grid point floor(t side / tiles); tile_of counts along the first
/// axis fastest.
/// @param places rows like `rows`, with a 64-bit word for each coordinate: its upper 12 bits count
///        grid points from the tile's first to the window's first one, and its lower 52 are the
///        point's position after a grid point, in [0, 1). Strengths are copied.
void find_places(std::span<const double> rows, std::size_t dimension, const SpreadTile& common,
                 std::uint32_t* tile_of, double* places, Vectors widest = Vectors::eights);

/// Spreads points whose windows begin in the tile to its buffer of extent^dimension cells.
/// @param widest widest vectors to use; results are the same bits with any.
void spread_points(std::span<const double> places, std::size_t dimension, const SpreadTile& tile,
                   double* buffer, Vectors widest = Vectors::eights);

}  // namespace stipple
