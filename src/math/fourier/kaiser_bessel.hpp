// SPDX-License-Identifier: MIT
//
// The Kaiser-Bessel window, which spreads a point over the w grid points around it,
//
//     phi(a) = I0(beta sqrt(1 - (2 a / w)^2)) / I0(beta),    |a| <= w / 2,
//
// and its transform, by which the transform of the grid is divided to give that of the points:
//
//     s(xi) = w sinh(r) / (r I0(beta)),    r^2 = beta^2 - (pi w xi)^2.
//
// xi is in cycles per cell, |xi| <= band. The error of the quotient comes from the window's
// aliases.
//
// The window is tabulated as polynomials in a point's position u between two grid points, so that
// spreading needs no Bessel functions.
//
// Source  J. F. Kaiser, R. W. Schafer, IEEE Trans. Acoust. Speech Signal Process. 28 (1980)
//         105-107, doi:10.1109/TASSP.1980.1163349; J. A. Fessler, B. P. Sutton, IEEE Trans. Signal
//         Process. 51 (2003) 560-574, doi:10.1109/TSP.2002.807005 (its error compared with that of
//         the best weights).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace stipple {

class KaiserBessel {
  public:
    static constexpr std::size_t min_width = 2;
    static constexpr std::size_t max_width = 16;

    /// @param width in [min_width, max_width], in grid cells.
    /// @param band highest requested frequency in cycles per cell, in (0, 1/2).
    KaiserBessel(std::size_t width, double band);

    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] double band() const { return band_; }

    /// The window's transform s(xi), for xi in [0, band].
    [[nodiscard]] double scaling(double xi) const;

    /// The window at the grid points 0, ..., width - 1 around a point.
    /// @param u in [0, 1], for a point at the position u + width / 2 - 1
    [[nodiscard]] std::array<double, max_width> weights(double u) const;

    /// Largest error of exp(-2 pi i xi x), |xi| <= band, for one point in one dimension, after
    /// spreading, transforming and dividing by the scaling factors. Computed at so many positions
    /// that the true maximum is at most a tenth larger.
    [[nodiscard]] double error() const { return error_; }

    /// Factor by which the division by scaling factors magnifies rounding errors at the end of the
    /// band, relative to those at 0.
    [[nodiscard]] double magnification() const { return scaling(0) / scaling(band_); }

    /// Estimate of error() by a formula.
    static double expected_error(std::size_t width, double band);

  private:
    [[nodiscard]] double largest_error() const;

    std::size_t width_;
    double band_;
    double beta_;
    double scale_;  ///< 1 / I0(beta)
    double error_;
};

/// The narrowest window with error() <= tolerance; the widest one if there is none.
KaiserBessel window_for(double tolerance, double band);

/// A window as polynomials of u, on enough pieces of the unit interval that low degrees suffice.
class WeightTable {
  public:
    explicit WeightTable(const KaiserBessel& window);

    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] std::size_t pieces() const { return pieces_; }

    /// Length of a row of coefficients, a multiple of 8; unused ones are zero.
    static constexpr std::size_t row_of(std::size_t width) { return (width + 7) / 8 * 8; }

    /// Degree of the polynomials, chosen for speed: with it, the table fits the first-level cache
    /// together with a tile's buffer.
    static constexpr std::size_t degree_of(std::size_t width) { return (width + 3) / 4 + 2; }

    [[nodiscard]] std::size_t degree() const { return degree_of(width_); }

    /// For each piece, degree + 1 rows of row_of(width) coefficients. Row k is for t^(degree - k),
    /// where t in [-1, 1) is the position in the piece. Aligned to 64 bytes.
    [[nodiscard]] const double* coefficients() const { return rows_.front().numbers.data(); }

  private:
    struct alignas(64) Vector {
        std::array<double, 8> numbers;
    };

    double& coefficient(std::size_t piece, std::size_t k, std::size_t j) {
        return rows_[((piece * (degree() + 1) + k) * row_of(width_) + j) / 8].numbers[j % 8];
    }

    std::size_t width_;
    std::size_t pieces_;
    std::vector<Vector> rows_;
};

}  // namespace stipple
