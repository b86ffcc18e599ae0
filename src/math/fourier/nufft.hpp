// SPDX-License-Identifier: MIT
//
// Fourier sums of points at integer frequencies,
//
//     S(f) = sum_j exp(-2 pi i f.x_j),    |f_k| <= F,    x_j in [0, 1]^d,  d = 1, 2, 3,
//
// or, with strengths s_j, sum_j s_j exp(-2 pi i f.x_j),
//
// by a non-uniform fast Fourier transform. A window spreads the points over a grid with M > 2F + 1
// cells per side, the real grid is transformed, and the result is divided by the window's
// transform. Grid and window are the cheapest ones that meet the tolerance.
//
// Shape   f_0 = 0..F, the fastest index; f_1, f_2 = -F..F. The other half is S(-f) = conj S(f).
// Cost    O(n w^d + M^d log M) time for windows w <= 16 cells wide; memory: bytes(), for any number
//         of points.
// Promise |error| <= max(tolerance, floor) sqrt(n) at every f, for every set. The window's error
//         per point is kept below tolerance / sqrt(n), so that even points in phase satisfy the
//         bound. floor = rounding_floor(n), about 1.5e-13 sqrt(n), bounds the rounding error of
//         float64 if all n points are in phase; otherwise smaller tolerances are met as well. With
//         strengths, sqrt(sum s_j^2) replaces sqrt(n). The same bits for any number of threads, and
//         for any division of the points into portions.
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

/// Choice of grid and window.
class Nufft {
  public:
    /// @param count expected maximum number of points; more points lose accuracy
    /// @param max_frequency F, from 1 to 10^6.
    /// @param tolerance in [1e-13, 0.1], relative to sqrt(count).
    /// @param weighted true if rows have strengths after the coordinates.
    Nufft(std::uint64_t count, std::size_t dimension, std::size_t max_frequency, double tolerance,
          bool weighted = false);

    /// Peak memory of the transform, in bytes.
    [[nodiscard]] double bytes() const;

    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] std::size_t dimension() const { return dimension_; }
    [[nodiscard]] std::size_t max_frequency() const { return frequency_; }
    [[nodiscard]] bool weighted() const { return weighted_; }
    [[nodiscard]] std::size_t side() const { return side_; }
    [[nodiscard]] const KaiserBessel& window() const { return window_; }

    /// Bound on the error for `count` points, excluding rounding, relative to sqrt(count).
    [[nodiscard]] double error(double count) const;

  private:
    std::uint64_t count_;
    std::size_t dimension_;
    std::size_t frequency_;
    bool weighted_;
    std::size_t side_ = 0;
    KaiserBessel window_;
};

/// Transform of points that arrive in portions. Each block of points is spread over a grid, and the
/// grids are added by ScaledGridSum. So processes can sum different blocks, and merge the sums.
class FourierSummation {
  public:
    explicit FourierSummation(const Nufft& nufft);

    /// Number of points in a block: about the number of cells, so that adding grids costs little,
    /// but between 2^24 and 2^26.
    static std::uint64_t block_of(const Nufft& nufft);

    void add(std::span<const double> rows, const RunContext& run);

    /// Packs the sum over the points so far. No points may be added afterwards.
    void pack(Packer& to, const RunContext& run);
    /// Adds the packed sum over other points. This object's own points must fill whole blocks.
    void merge(Unpacker& from, const RunContext& run);

    /// Returns the sums over all points; must be called once, after the last point.
    [[nodiscard]] FourierSums finish(Planning planning, const RunContext& run);

  private:
    [[nodiscard]] std::span<double> cells() const;
    void close_block(const RunContext& run);

    Nufft nufft_;
    GridCells cells_;
    CellGrid grid_;
    std::optional<Spreader> spreader_;  ///< exists until finish()
    std::uint64_t block_;               ///< points per block
    std::uint64_t points_ = 0;          ///< points in the current block
    double strongest_ = 0;  ///< largest |strength| in the current block; 1 without strengths
    ScaledGridSum sum_;     ///< sum over the previous blocks
};

/// Reference implementation by the plain sum, O(n (2F + 1)^d). Phases are reduced before rounding,
/// so they are exact to the last bits for any frequency.
class DirectSummation {
  public:
    DirectSummation(std::size_t dimension, std::size_t max_frequency, bool weighted = false);

    void add(std::span<const double> rows, const RunContext& run);
    [[nodiscard]] FourierSums finish() { return std::move(sums_); }

  private:
    bool weighted_;
    FourierSums sums_;
};

/// Rounding error that float64 may leave if all points are in phase, relative to sqrt(count).
double rounding_floor(std::size_t count);

}  // namespace stipple
