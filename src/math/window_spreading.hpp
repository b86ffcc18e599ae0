// SPDX-License-Identifier: MIT
//
// The innermost work of spreading points over a grid: the places of their windows, the windows'
// values, and the sums in the buffer of one tile of the grid.
//
// Promise the same bits on any machine: vectors do what plain code does, number by number.
// Beware  M x is never rounded to a double: the product's high part is exact, and the place between
//         two grid points keeps all its bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/vectors.hpp"
#include "math/kaiser_bessel.hpp"

namespace stipple {

/// A tile of the grid. All but its start and reach are the same for all tiles.
struct SpreadTile {
    double side = 0;                       ///< M
    double tiles = 0;                      ///< along an axis
    double shift = 0;                      ///< 1/2 for odd windows, which centre on a grid point
    double lead = 0;                       ///< grid points of the window before the point's cell
    std::size_t width = 0;                 ///< of the window
    double pieces = 0;                     ///< of its table
    const double* coefficients = nullptr;  ///< of its table
    std::size_t numbers = 0;               ///< of a point: coordinates, and its strength
    std::size_t extent = 0;  ///< cells of a row of the buffer: a multiple of 8, from the widest
                             ///< tile and whole vectors on
    std::size_t plane = 0;   ///< cells from one layer of the buffer to the next
    bool in_grid = false;    ///< the buffer is the grid itself: nothing before a window is touched,
                             ///< and behind it less than a whole vector
    std::array<std::int64_t, 3> start{};           ///< its first cell, by coordinate
    std::array<std::size_t, 3> reach = {1, 1, 1};  ///< cells that its points touch
};

/// Adds points whose windows begin in the tile to its buffer, extent^dimension cells.
/// @param widest vectors that may be used; the same bits with any.
void spread_points(std::span<const double> rows, std::size_t dimension, const SpreadTile& tile,
                   double* buffer, Vectors widest = Vectors::eights);

/// Finds the tiles in which the windows of points begin: the t-th along an axis begins at the grid
/// point floor(t side / tiles), and the first axis counts fastest.
void find_tiles(std::span<const double> rows, std::size_t dimension, const SpreadTile& common,
                std::uint32_t* tile_of, Vectors widest = Vectors::eights);

}  // namespace stipple
