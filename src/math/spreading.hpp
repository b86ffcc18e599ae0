// SPDX-License-Identifier: MIT
//
// Points spread over a periodic grid of cells: every point adds the product of one window a
// dimension,
//
//     g[i] += prod_k phi(M x_k - i_k),    indices modulo M,
//
// where coordinate 0 runs along the rows of the grid, the fastest index.
//
// Cost    O(n w^d + M^d). Points are sorted into tiles of the grid; a tile is summed in a buffer
//         that the nearest cache holds, and then added to the grid.
// Promise the same bits for any number of threads. Tiles are added colour by colour, and the tiles
//         of one colour do not touch each other, so every cell has its summands in a fixed order.
// Beware  M x is never rounded to a double: the product's high part is exact, and the place between
//         two grid points keeps all its bits.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "core/run_context.hpp"
#include "math/kaiser_bessel.hpp"

namespace stipple {

/// Where the cells of a grid stand in memory.
struct CellGrid {
    std::size_t dimension = 1;  ///< 1, 2 or 3
    std::size_t side = 0;       ///< M: even, at least smallest_side, below 2^24
    std::size_t stride = 0;     ///< numbers from one row to the next, at least `side`
    double* cells = nullptr;    ///< stride * side^(dimension - 1) numbers

    static constexpr std::size_t smallest_side = 2 * KaiserBessel::max_width;
};

/// Points that are sorted at a time, which bounds the memory for it.
std::size_t spreading_batch(std::size_t count, const CellGrid& grid);

/// Adds the points (rows of `dimension` numbers in [0, 1]) to the grid.
void spread(std::span<const double> rows, const KaiserBessel& window, const CellGrid& grid,
            const RunContext& run);

}  // namespace stipple
