// SPDX-License-Identifier: MIT
//
// The Kaiser-Bessel window, by which a point is spread over the w grid points around it,
//
//     phi(a) = I0(beta sqrt(1 - (2 a / w)^2)) / I0(beta),    |a| <= w / 2,
//
// and its transform, by which the grid's is divided to become that of the points:
//
//     s(xi) = w sinh(r) / (r I0(beta)),    r^2 = beta^2 - (pi w xi)^2.
//
// With xi in cycles a cell it holds in the band |xi| <= band of frequencies that are wanted, but for
// the error of the window's aliases.
//
// The window is taken from polynomials of a point's place u between two grid points, so that
// spreading a point takes no Bessel functions.
//
// Source  J. F. Kaiser, R. W. Schafer, IEEE Trans. Acoust. Speech Signal Process. 28 (1980)
//         105-107, doi:10.1109/TASSP.1980.1163349; J. A. Fessler, B. P. Sutton, IEEE Trans. Signal
//         Process. 51 (2003) 560-574, doi:10.1109/TSP.2002.807005 (its error beside that of the best weights).
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
    [[nodiscard]] double band() const { return band_; }

    /// s(xi), xi in [0, band].
    [[nodiscard]] double scaling(double xi) const;

    /// The window at a point's grid points.
    /// @param u in [0, 1]: the point is so far behind the one of place width / 2 - 1, or, with odd
    ///          widths, half a cell more.
    [[nodiscard]] std::array<double, max_width> weights(double u) const;

    /// Largest error of exp(-2 pi i xi x), |xi| <= band, of one point in one dimension, after
    /// spreading it, transforming and dividing by the scaling factors; it is looked for at so many
    /// places that not a tenth more is anywhere.
    [[nodiscard]] double error() const { return error_; }

    /// How much the division by the scaling factors magnifies rounding errors at the end of the
    /// band, beside those at 0.
    [[nodiscard]] double magnification() const { return scaling(0) / scaling(band_); }

    /// Near error(), at no cost.
    static double expected_error(std::size_t width, double band);

  private:
    [[nodiscard]] double largest_error() const;

    std::size_t width_;
    double band_;
    double beta_;
    double scale_;  ///< 1 / I0(beta)
    double error_;
};

/// The narrowest window whose error() is at most `tolerance`, or else the widest one.
KaiserBessel window_for(double tolerance, double band);

/// A window as polynomials of u. The unit is cut into so many pieces that short polynomials do.
class WeightTable {
  public:
    explicit WeightTable(const KaiserBessel& window);

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
