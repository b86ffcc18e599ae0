// SPDX-License-Identifier: MIT
//
// A density on an interval, tabulated as linear on pieces. These are halved, the worst one first,
// until
//
//     sum over pieces of  width * largest |f - table|  <=  tolerance * integral,
//
// which bounds the error of every probability. The table is inverted exactly: in a piece with
// densities a and b at its ends, the fraction r of its mass is below the fraction
//
//     t = r (a + b) / (a + sqrt((1 - r) a^2 + r b^2))    of its width,
//
// which solves a quadratic equation without cancellation.
//
// Shape   any f that is finite, not negative, and not 0 everywhere, with an integral within
//         [1e-280, 1e280]. It may have jumps and corners; the table is faster to make if they are
//         named as breaks.
// Cost    about 1 / sqrt(8 tolerance / f'') pieces; O(1) per point on average (guide table).
// Promise a piece has no mass if f is 0 at a sample inside, so that no point is beyond a jump to 0.
//         Quantiles increase with u.
// Beware  f is sampled at 2^16 or more points: features narrower than the range divided by 2^16 may
//         be missed, except at breaks.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/domain.hpp"
#include "math/densities/guide_table.hpp"
#include "math/geometry/law_moments.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// A piece of a density, linear from f_low at x_low to f_high at x_high.
struct LinePiece {
    double x_low;
    double x_high;
    double f_low;
    double f_high;
    Estimate integral = {};  ///< integral of f by Boole's rule; error: difference from Simpson's
};

/// Sets values[i] to the value of a function at point i; points are stored one after another.
using BlockFunction = std::function<void(std::span<const double> at, std::span<double> values)>;

struct LineRange {
    double low = 0;
    double high = 1;
    std::vector<double> breaks = {};  ///< jumps and corners between low and high, increasing
};

/// Tabulates f. `what` names it in messages: "--density: 1/x". @throws Error(usage) if f is
/// negative, not finite, unbounded or 0 everywhere; Error(limit) if the tolerance cannot be reached
std::vector<LinePiece> tabulate_line(const std::string& what, const BlockFunction& f,
                                     const LineRange& range, double tolerance,
                                     const RunContext& run);

/// Checks a value of a density. @throws Error(usage) if it is negative or not finite
void require_density(const std::string& what, std::span<const double> place, double value);

/// Checks that sums and shares of a density's integral lose no digits. @throws Error(usage)
void require_integral(const std::string& what, double integral);

/// Largest difference of values at 0, 1/4, 1/2, 3/4, 1 from the line between the first and last.
double largest_bend(const std::array<double, 5>& f);

/// Fraction t of a piece's width, from its lower end, that contains the fraction r of its mass, for
/// densities a and b at its ends.
inline double width_share(double a, double b, double r) {
    const double slowness = a + std::sqrt((1 - r) * (a * a) + r * (b * b));
    return slowness > 0 ? std::min(r * (a + b) / slowness, 1.0) : 0;  // a = r = 0 gives 0
}

/// Inverse of width_share: fraction of the mass in the lower fraction t of the width.
double mass_share(double a, double b, double t);

/// A density that is linear on each piece, and may jump between pieces.
class LineTable {
  public:
    /// @param pieces adjacent and in order; at least one must have mass
    explicit LineTable(std::vector<LinePiece> pieces);

    /// Normalized density at x; between two pieces, that of the right one.
    [[nodiscard]] double density(double x) const;

    /// Moments of the density f / mass, which must be smooth on each piece, by quadrature.
    [[nodiscard]] LineMoments moments_of(const std::function<double(double)>& f, double mass) const;

    /// Maximal intervals on which the density is not 0.
    [[nodiscard]] std::vector<std::pair<double, double>> positive_intervals() const;

    [[nodiscard]] const std::vector<LinePiece>& pieces() const { return pieces_; }

    /// Index of the piece that contains x, which must be in the closed range of the table.
    [[nodiscard]] std::size_t piece_of(double x) const;

    /// The x with the fraction u in [0, 1] of the mass below it; always below the upper end of the
    /// piece that contains it.
    [[nodiscard]] double quantile(double u) const;

    /// Replaces each fraction of the mass by its quantile.
    void quantiles(std::span<double> shares) const;

    /// Fraction of the mass below x.
    [[nodiscard]] double fraction(double x) const;

  private:
    /// Data for a quantile: one cache line per piece.
    struct alignas(64) Row {
        double before;  ///< mass of the pieces before
        double mass;
        double f_low;  ///< f_low and f_high are scaled by a common power of 2
        double f_high;
        double x_low;
        double width;
        double last;  ///< largest number in the piece
    };

    std::vector<LinePiece> pieces_;
    std::vector<Row> rows_;
    GuideTable masses_;  ///< running sums of the pieces' masses
};

}  // namespace stipple
