// SPDX-License-Identifier: MIT
//
// The weights t_j of w grid points by which a point is spread over a grid, for its place u between
// two of them: those for which
//
//     sum_j t_j(u) exp(-2 pi i xi j) = s(xi) exp(-2 pi i xi u)
//
// holds best in the band |xi| <= band of frequencies that are wanted. They are found by least
// squares, relative to s(xi), at the Chebyshev nodes of the band. The grid's transform, divided by
// the scaling factors s, is that of the points. For s stands the transform of a Kaiser-Bessel
// window,
//
//     s(xi) = w sinh(r) / (r I0(beta)),    r^2 = beta^2 - (pi w xi)^2,
//
// by which points might be spread as well, with 2 to 8 times the error: some two thirds of a grid
// point more along each axis.
//
// The weights are taken from polynomials of u, so that spreading a point takes no equations.
//
// Source  J. A. Fessler, B. P. Sutton, IEEE Trans. Signal Process. 51 (2003) 560-574,
//         doi:10.1109/TSP.2002.807005 (interpolators and scaling factors; there the largest error
//         is made least).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace stipple {

class Interpolator {
  public:
    static constexpr std::size_t min_width = 2;
    static constexpr std::size_t max_width = 16;

    /// @param width in [min_width, max_width], in grid cells.
    /// @param band highest frequency that is wanted, in cycles a cell; in (0, 1/2).
    /// @param shape where the window's transform ends, as a share of the nearest alias of the band:
    ///        a little below 1 is best.
    Interpolator(std::size_t width, double band, double shape = 0.965);

    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] double band() const { return band_; }

    /// s(xi), xi in [0, band].
    [[nodiscard]] double scaling(double xi) const;

    /// The weights of a point's grid points.
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
    static constexpr std::size_t max_samples = 2 * max_width;
    static constexpr std::size_t max_terms = max_width / 2 + 1;

    /// Equations of least squares: the samples, and for each term one that holds it back.
    using Column = std::array<double, max_samples + max_terms>;

    /// Least squares for the weights' even or odd part: R t = Q' (samples of the aim).
    struct Part {
        std::size_t terms = 0;
        std::array<Column, max_terms> q{};                         ///< columns
        std::array<std::array<double, max_terms>, max_terms> r{};  ///< [row][column]

        /// Householder's factorisation of the first `used` equations, which are columns of q first.
        void factorise(std::size_t used);
        void solve(const std::array<double, max_samples>& aim,
                   std::array<double, max_terms>& solution) const;
    };

    [[nodiscard]] std::size_t samples() const { return 2 * width_; }
    [[nodiscard]] Part part(bool odd) const;
    [[nodiscard]] double largest_error() const;

    std::size_t width_;
    double band_;
    double beta_;
    double scale_;                                 ///< 1 / I0(beta)
    std::array<double, max_samples> frequency_{};  ///< at which there are equations
    Part even_;
    Part odd_;
    double error_;
};

/// The narrowest interpolator of some shapes whose error() is at most `tolerance`, or else the
/// widest one.
Interpolator interpolator_for(double tolerance, double band);

/// The weights as polynomials of u. The unit is cut into so many pieces that short polynomials do.
class WeightTable {
  public:
    explicit WeightTable(const Interpolator& interpolator);

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
