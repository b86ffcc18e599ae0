// SPDX-License-Identifier: MIT
//
// The Kaiser-Bessel window, w grid cells wide, by which a point is spread over a grid:
//
//     phi(a) = I0(beta sqrt(1 - (2a/w)^2)) / I0(beta),    |a| <= w/2,
//     its transform at xi cycles a cell:  w sinh(s) / (s I0(beta)),  s^2 = beta^2 - (pi w xi)^2.
//
// The w values that a point needs are taken from polynomials of its place between two grid points,
// so that spreading it takes neither roots nor Bessel functions.
//
// Source  J. F. Kaiser's window; as a spreading function: J. A. Fessler, B. P. Sutton, IEEE Trans.
//         Signal Process. 51 (2003) 560-574, doi:10.1109/TSP.2002.807005.
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
    /// @param band highest frequency that is wanted, in cycles a cell; in (0, 1/2).
    KaiserBessel(std::size_t width, double band);

    [[nodiscard]] std::size_t width() const { return width_; }

    /// phi(a), 0 outside the window.
    [[nodiscard]] double operator()(double a) const;

    /// Its Fourier transform at xi cycles a cell, xi in [0, band].
    [[nodiscard]] double transform(double xi) const;

    /// Largest error of exp(-2 pi i xi x), |xi| <= band, of one point in one dimension, after
    /// spreading it, transforming and dividing by transform(xi).
    [[nodiscard]] double error() const;

    /// How much the division by the transform magnifies rounding errors at the end of the band,
    /// beside those at 0.
    [[nodiscard]] double magnification() const { return transform(0) / transform(band_); }

  private:
    std::size_t width_;
    double band_;
    double beta_;
    double scale_;  ///< 1 / I0(beta)
};

/// The narrowest window whose error() is at most `tolerance`, or else the widest one.
KaiserBessel window_for(double tolerance, double band);

/// The window's values at its grid points as polynomials of the point's place u in [0, 1) behind a
/// grid point: the value at the j-th grid point is phi(u + w/2 - 1 - j). The unit is cut into so
/// many pieces that short polynomials do.
class WindowTable {
  public:
    explicit WindowTable(const KaiserBessel& window);

    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] std::size_t pieces() const { return pieces_; }

    /// Values that a row of coefficients holds: whole vectors; the surplus is zero.
    static constexpr std::size_t row_of(std::size_t width) { return (width + 7) / 8 * 8; }

    /// Degree that is quickest: of a table that the nearest cache holds beside a tile.
    static constexpr std::size_t degree_of(std::size_t width) { return (width + 3) / 4 + 2; }

    [[nodiscard]] std::size_t degree() const { return degree_of(width_); }

    /// For each piece, degree + 1 rows of row_of(width); row k holds the coefficients of
    /// t^(degree - k), t in [-1, 1) being the place in the piece. Aligned to 64 bytes.
    [[nodiscard]] const double* coefficients() const { return rows_.front().numbers.data(); }

    /// The value at the j-th grid point.
    [[nodiscard]] double value(std::size_t j, double u) const;

  private:
    struct alignas(64) Vector {
        std::array<double, 8> numbers;
    };

    void fill(const KaiserBessel& window);
    [[nodiscard]] bool agrees(const KaiserBessel& window) const;
    [[nodiscard]] double polynomial(std::size_t piece, std::size_t j, double t) const;
    double& coefficient(std::size_t piece, std::size_t k, std::size_t j) {
        return rows_[((piece * (degree() + 1) + k) * row_of(width_) + j) / 8].numbers[j % 8];
    }

    std::size_t width_;
    std::size_t pieces_ = 4;
    std::vector<Vector> rows_;
};

}  // namespace stipple
