// SPDX-License-Identifier: MIT
//
// Points spread over a periodic grid of cells: every point of strength s (default 1) adds s times
// the product of one window per dimension,
//
//     g[i] += s prod_k phi(M x_k - i_k),    indices modulo M,
//
// where coordinate 0 runs along the rows of the grid, the fastest index.
//
// Cost    O(n w^d + M^d ceil(n / batch)). Points may be added in any portions. They are sorted into
//         tiles of the grid on arrival, and spread in batches. A tile is summed in a buffer in the
//         first-level cache, and then added to the grid.
// Promise the same bits for any number of threads, and for any division of the points into
//         portions. The colour of a tile is the parity of its position along each axis. Tiles of
//         one colour do not touch each other, and others are added in the order of their colours;
//         so the order of additions to every cell is fixed.
// Beware  M x is never rounded to a double: the product's high part is exact, and the position
//         between two grid points keeps 52 bits.
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

/// Memory layout of a grid.
struct CellGrid {
    std::size_t dimension = 1;  ///< 1, 2 or 3
    std::size_t side = 0;       ///< M: even, at least smallest_side, below 2^24
    std::size_t stride = 0;     ///< numbers between the starts of rows, at least `side`
    double* cells = nullptr;    ///< stride * side^(dimension - 1) numbers

    static constexpr std::size_t smallest_side = 2 * KaiserBessel::max_width;
};

class Spreader {
  public:
    /// @param count expected number of points; more may be added.
    /// @param weighted true if rows have strengths after the coordinates.
    Spreader(const KaiserBessel& window, const CellGrid& grid, std::uint64_t count,
             bool weighted = false);
    Spreader(const Spreader&) = delete;
    Spreader& operator=(const Spreader&) = delete;
    ~Spreader();

    /// Adds points: rows of `dimension` numbers in [0, 1], followed by strengths if weighted.
    void add(std::span<const double> rows, const RunContext& run);

    /// Spreads the remaining points, which did not fill a batch.
    void finish(const RunContext& run);

    /// Peak memory for `count` points without the grid, in bytes.
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
    std::size_t width_;               ///< numbers per row
    std::size_t batch_;               ///< points per batch
    std::size_t waits_ = 0;           ///< points sorted but not yet spread
    std::vector<TilePoints> points_;  ///< by stream; streams without points may be missing
};

}  // namespace stipple
