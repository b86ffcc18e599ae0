// SPDX-License-Identifier: MIT
//
// The Fourier transform of a real periodic grid at the lowest frequencies,
//
//     S(f) = c(f_0) c(f_1) ... sum_i g[i] exp(-2 pi i f.i / M),    |f_k| <= F,
//
// with given factors c; first along the rows, then across them. Only F + 1 numbers of each row's
// transform are used further, and half of the frequencies follow from the others.
//
// Shape   f_0 = 0..F, the fastest index; f_1, f_2 = -F..F. The other half is S(-f) = conj S(f).
// Cost    O(M^d log M); 13 ms for M = 2048, F = 512 in the plane on one core.
// Promise the same bits for any number of threads, and with `estimated` plans in every run.
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

    /// S(f), also for f_0 < 0. Requires |f_k| <= max_frequency, and f_k = 0 for k >= dimension.
    [[nodiscard]] std::complex<double> at(std::array<std::int64_t, 3> f) const;
};

/// Number of values in FourierSums.
double fourier_sums_size(std::size_t dimension, std::size_t max_frequency);

/// Distance between rows of a grid, in numbers, with room to transform rows in place. Not a power
/// of two for sides >= 256 of quick_length(): it would map a column to few cache lines.
std::size_t stride_of(std::size_t side);

/// Smallest even side >= `least` that is fast to transform: a power of two times an odd number with
/// prime factors 3 and 5, below 27 if the side is 256 or more.
std::size_t quick_length(std::size_t least);

/// Approximate time of the transform on one core, in seconds.
double transform_seconds(std::size_t dimension, std::size_t side);

/// Transforms the grid in place, destroying it, and returns S(f). @param factors c(0), ..., c(F)
FourierSums transform_grid(GridCells cells, const CellGrid& grid, std::span<const double> factors,
                           Planning planning, const RunContext& run);

}  // namespace stipple
