// SPDX-License-Identifier: MIT
//
// Fourier sums of points at integer frequencies,
//
//     S(f) = sum_j exp(-2 pi i f.x_j),    |f_k| <= F,    x_j in [0, 1]^d,  d = 1, 2, 3,
//
// by a non-uniform fast Fourier transform: the points are spread over a grid of M > 2F + 1 cells a
// side with a window phi, the real grid is transformed, and the result divided by the window's own
// transform. Grid and window are the cheapest that meet the tolerance.
//
// Shape   f_0 = 0..F, the fastest index; f_1, f_2 = -F..F. The other half is S(-f) = conj S(f).
// Cost    O(n w^d + M^d log M) time for windows w <= 16 cells wide; memory: bytes().
// Promise |error| <= max(tolerance, floor) sqrt(n) at every f, for every set: the window's error is
//         held below tolerance / sqrt(n) for each point, so that not even points in phase exceed
//         it. floor = rounding_floor(n), about 1e-13 sqrt(n), is what float64 may leave when all n
//         points are in phase; where they are not, smaller tolerances hold as well.
//         The same bits for any number of threads.
// Source  A. Dutt, V. Rokhlin, SIAM J. Sci. Comput. 14 (1993) 1368-1393, doi:10.1137/0914081;
//         A. H. Barnett, J. Magland, L. af Klinteberg, SIAM J. Sci. Comput. 41 (2019) C479-C504,
//         doi:10.1137/18M120885X.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/run_context.hpp"
#include "math/kaiser_bessel.hpp"

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

class Nufft {
  public:
    /// Chooses grid and window for sets of `count` points.
    /// @param max_frequency F, from 1 to 10^6.
    /// @param tolerance in [1e-13, 0.1], relative to sqrt(count).
    Nufft(std::size_t count, std::size_t dimension, std::size_t max_frequency, double tolerance);

    /// Peak memory that transform() needs.
    [[nodiscard]] double bytes() const;

    [[nodiscard]] std::size_t side() const { return side_; }
    [[nodiscard]] const KaiserBessel& window() const { return window_; }

    /// @param rows `count` points in [0, 1]^dimension, point after point.
    /// @throws Error(cancelled)
    [[nodiscard]] FourierSums transform(std::span<const double> rows, const RunContext& run) const;

  private:
    std::size_t count_;
    std::size_t dimension_;
    std::size_t frequency_;
    std::size_t side_ = 0;
    KaiserBessel window_;
};

/// The same by the plain sum, O(n (2F + 1)^d): the oracle. Phases are reduced before they are
/// rounded, and exact to the last bits for any frequency.
FourierSums fourier_sums_directly(std::span<const double> rows, std::size_t dimension,
                                  std::size_t max_frequency, const RunContext& run);

/// Error relative to sqrt(count) that float64 may leave when all points are in phase.
double rounding_floor(std::size_t count);

}  // namespace stipple
