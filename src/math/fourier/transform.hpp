// SPDX-License-Identifier: MIT
//
// The Fourier transform of a real periodic grid at the lowest frequencies,
//
//     S(f) = c(f_0) c(f_1) ... sum_i g[i] exp(-2 pi i f.i / M),    |f_k| <= F,
//
// row by row and then across; of the rows' transforms no more than F + 1 numbers are looked at
// again, and half of the frequencies follow from the others.
//
// Shape   f_0 = 0..F, the fastest index; f_1, f_2 = -F..F. The other half is S(-f) = conj S(f).
// Cost    O(M^d log M); 13 ms for M = 2048, F = 512 in the plane on one core.
// Promise the same bits for any number of threads, and with `estimated` plans in any run.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "math/fourier/fft.hpp"
#include "math/fourier/grid_cells.hpp"
#include "math/fourier/spreading.hpp"
#include "stipple/run.hpp"

namespace stipple {

struct FourierSums {
    std::size_t dimension = 0;
    std::size_t max_frequency = 0;
    std::vector<std::complex<double>> values;

    /// S(f), also for f_0 < 0; |f_k| <= max_frequency, and 0 beyond the dimension.
    [[nodiscard]] std::complex<double> at(std::array<std::int64_t, 3> f) const;
};

/// Number of values of such sums.
double fourier_sums_size(std::size_t dimension, std::size_t max_frequency);

/// Numbers from one row of a grid to the next: room for the transform of a row in place, and no
/// power of two, which would put a column into few lines of the cache.
std::size_t stride_of(std::size_t side);

/// A side that transforms are quick at and that is at least `least`: even, times 1 to 27 a power of two.
std::size_t quick_length(std::size_t least);

/// Seconds, nearly, that the transform takes one core.
double transform_seconds(std::size_t dimension, std::size_t side);

/// Transforms the grid, and destroys it.
/// @param factors c(0..F).
FourierSums transform_grid(GridCells cells, const CellGrid& grid, std::span<const double> factors,
                           Planning planning, const RunContext& run);

}  // namespace stipple
