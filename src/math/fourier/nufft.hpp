// SPDX-License-Identifier: MIT
//
// Fourier sums of points at integer frequencies,
//
//     S(f) = sum_j exp(-2 pi i f.x_j),    |f_k| <= F,    x_j in [0, 1]^d,  d = 1, 2, 3,
//
// or, with strengths s_j, sum_j s_j exp(-2 pi i f.x_j),
//
// by a non-uniform fast Fourier transform: the points are spread over a grid of M > 2F + 1 cells a
// side by a window, the real grid is transformed, and the result divided by the window's transform.
// Grid and window are the cheapest that meet the tolerance.
//
// Shape   f_0 = 0..F, the fastest index; f_1, f_2 = -F..F. The other half is S(-f) = conj S(f).
// Cost    O(n w^d + M^d log M) time for windows w <= 16 cells wide; memory: bytes(), however many
//         points come.
// Promise |error| <= max(tolerance, floor) sqrt(n) at every f, for every set: the window's error is
//         held below tolerance / sqrt(n) for each point, so that not even points in phase exceed
//         it. floor = rounding_floor(n), about 1.5e-13 sqrt(n), is what float64 may leave when all
//         n points are in phase; where they are not, smaller tolerances hold as well. With
//         strengths sqrt(sum s_j^2) stands for sqrt(n). The same bits for any number of threads,
//         and however the points are portioned.
// Source  A. Dutt, V. Rokhlin, SIAM J. Sci. Comput. 14 (1993) 1368-1393, doi:10.1137/0914081;
//         A. H. Barnett, J. Magland, L. af Klinteberg, SIAM J. Sci. Comput. 41 (2019) C479-C504,
//         doi:10.1137/18M120885X.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "math/fourier/grid_sum.hpp"
#include "math/fourier/kaiser_bessel.hpp"
#include "math/fourier/spreading.hpp"
#include "math/fourier/transform.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// The choice of grid and window.
class Nufft {
  public:
    /// @param count points that may come; more of them are less exact.
    /// @param max_frequency F, from 1 to 10^6.
    /// @param tolerance in [1e-13, 0.1], relative to sqrt(count).
    /// @param weighted whether rows hold strengths behind the coordinates.
    Nufft(std::uint64_t count, std::size_t dimension, std::size_t max_frequency, double tolerance,
          bool weighted = false);

    /// Peak memory that the transform needs.
    [[nodiscard]] double bytes() const;

    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] std::size_t dimension() const { return dimension_; }
    [[nodiscard]] std::size_t max_frequency() const { return frequency_; }
    [[nodiscard]] bool weighted() const { return weighted_; }
    [[nodiscard]] std::size_t side() const { return side_; }
    [[nodiscard]] const KaiserBessel& window() const { return window_; }

    /// Bound of the error beside that of rounding, relative to sqrt(count), of so many points.
    [[nodiscard]] double error(double count) const;

  private:
    std::uint64_t count_;
    std::size_t dimension_;
    std::size_t frequency_;
    bool weighted_;
    std::size_t side_ = 0;
    KaiserBessel window_;
};

/// A transform whose points come in portions. They are spread over a grid for every block of them,
/// and the grids are added as ScaledGridSum does it: so they may be shared out, block by block, and
/// what becomes of the parts be merged.
class FourierSummation {
  public:
    explicit FourierSummation(const Nufft& nufft);

    /// Points of a block: as many as cells, so that adding grids costs little, but at least 2^24
    /// and at most 2^26.
    static std::uint64_t block_of(const Nufft& nufft);

    void add(std::span<const double> rows, const RunContext& run);

    /// The sum over the points so far. None may come any more.
    void pack(Packer& to, const RunContext& run);
    /// Takes in that of other points; this one's are whole blocks.
    void merge(Unpacker& from, const RunContext& run);

    /// Called once, when all points came.
    [[nodiscard]] FourierSums finish(Planning planning, const RunContext& run);

  private:
    [[nodiscard]] std::span<double> cells() const;
    void close_block(const RunContext& run);

    Nufft nufft_;
    GridCells cells_;
    CellGrid grid_;
    std::optional<Spreader> spreader_;  ///< while points come
    std::uint64_t block_;               ///< points
    std::uint64_t points_ = 0;          ///< of the block at hand
    double strongest_ = 0;              ///< of these: its strength, or 1
    ScaledGridSum sum_;                 ///< of all blocks before
};

/// The same by the plain sum, O(n (2F + 1)^d): the oracle. Phases are reduced before they are
/// rounded, and exact to the last bits for any frequency.
class DirectSummation {
  public:
    DirectSummation(std::size_t dimension, std::size_t max_frequency, bool weighted = false);

    void add(std::span<const double> rows, const RunContext& run);
    [[nodiscard]] FourierSums finish() { return std::move(sums_); }

  private:
    bool weighted_;
    FourierSums sums_;
};

/// Error relative to sqrt(count) that float64 may leave when all points are in phase.
double rounding_floor(std::size_t count);

}  // namespace stipple
