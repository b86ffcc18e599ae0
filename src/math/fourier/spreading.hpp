// SPDX-License-Identifier: MIT
//
// Points spread over a periodic grid of cells: every point of strength s (1, if not told) adds s
// times the product of one window a dimension,
//
//     g[i] += s prod_k phi(M x_k - i_k),    indices modulo M,
//
// where coordinate 0 runs along the rows of the grid, the fastest index.
//
// Cost    O(n w^d + M^d ceil(n / batch)). Points come in any portions, are sorted into tiles of the
//         grid as they come, and spread a batch at a time; a tile is summed in a buffer that the
//         nearest cache holds, and then added to the grid.
// Promise the same bits for any number of threads, and however the points are portioned. The colour
//         of a tile is the parity of its place along each axis. Tiles of one colour do not touch
//         each other, and where tiles do they are added in the order of their colours; so every
//         cell has its summands in a fixed order.
// Beware  M x is never rounded to a double: the product's high part is exact, and the place between
//         two grid points keeps 52 bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "math/fourier/kaiser_bessel.hpp"
#include "math/fourier/tile_points.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Where the cells of a grid stand in memory.
struct CellGrid {
    std::size_t dimension = 1;  ///< 1, 2 or 3
    std::size_t side = 0;       ///< M: even, at least smallest_side, below 2^24
    std::size_t stride = 0;     ///< numbers from one row to the next, at least `side`
    double* cells = nullptr;    ///< stride * side^(dimension - 1) numbers

    static constexpr std::size_t smallest_side = 2 * KaiserBessel::max_width;
};

class Spreader {
  public:
    /// @param count points that are expected; more may come.
    /// @param weighted whether a row holds the point's strength behind its coordinates.
    Spreader(const KaiserBessel& window, const CellGrid& grid, std::uint64_t count,
             bool weighted = false);
    Spreader(const Spreader&) = delete;
    Spreader& operator=(const Spreader&) = delete;
    ~Spreader();

    /// Takes points, rows of `dimension` numbers in [0, 1] and their strengths.
    void add(std::span<const double> rows, const RunContext& run);

    /// Spreads what still waits for a full batch.
    void finish(const RunContext& run);

    /// Peak memory besides the grid, for so many points.
    static double bytes(double count, const CellGrid& grid, bool weighted);

  private:
    class Tiling;

    void sort(std::span<const double> rows, const RunContext& run);
    void spread_colour(std::size_t colour, std::size_t first, std::size_t last,
                       const RunContext& run);
    void spread_tile(std::size_t number, double* buffer, const RunContext& run) const;

    WeightTable table_;
    std::unique_ptr<Tiling> tiling_;
    std::size_t dimension_;
    std::size_t width_;               ///< numbers of a row
    std::size_t batch_;               ///< points of a batch
    std::size_t waits_ = 0;           ///< points that are sorted, and not spread yet
    std::vector<TilePoints> points_;  ///< of each stream that has some
};

}  // namespace stipple
