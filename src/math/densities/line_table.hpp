// SPDX-License-Identifier: MIT
//
// A density on an interval, tabulated: linear on pieces that are halved, the worst one first, until
//
//     sum over pieces of  width * largest |f - table|  <=  tolerance * integral,
//
// which bounds what any probability is off by. The table itself is inverted exactly: in a piece
// with ends a and b, the share r of its mass lies below the share
//
//     t = r (a + b) / (a + sqrt((1 - r) a^2 + r b^2))    of its width,
//
// which solves a quadratic equation without a difference.
//
// Shape   any f that is finite and not negative, not 0 everywhere; jumps and corners where they
//         are, faster where they are named.
// Cost    about 1 / sqrt(8 tolerance / f'') pieces; O(1) a point on average (guide table).
// Promise a piece in which f was seen to be 0 between points holds no mass, so that no point lands
//         beyond a jump to 0; rising in u.
// Beware  f is looked at in 2^16 places at least: what is narrower than the range over that and not
//         at a break may not be seen.
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

/// Linear from f_low at x_low to f_high at x_high.
struct LinePiece {
    double x_low;
    double x_high;
    double f_low;
    double f_high;
    Estimate integral = {};  ///< of f itself, by Boole's rule and what Simpson's differs from it
};

/// Values of a function at places, which stand one after the other.
using BlockFunction = std::function<void(std::span<const double> at, std::span<double> values)>;

struct LineRange {
    double low = 0;
    double high = 1;
    std::vector<double> breaks = {};  ///< inside, rising
};

/// Pieces for f. `what` names it: "--density: 1/x". @throws Error(usage): negative, not finite,
/// unbounded, 0 everywhere; Error(limit): tolerance out of reach
std::vector<LinePiece> tabulate_line(const std::string& what, const BlockFunction& f,
                                     const LineRange& range, double tolerance,
                                     const RunContext& run);

/// @throws Error(usage) for a value that no density has
void require_density(const std::string& what, std::span<const double> place, double value);

/// Largest difference of values at 0, 1/4, 1/2, 3/4 and 1 from a line between the first and the last.
double largest_bend(const std::array<double, 5>& f);

/// The share of a piece's width below which the share r of its mass lies, for densities a and b at
/// its ends.
inline double width_share(double a, double b, double r) {
    const double slowness = a + std::sqrt((1 - r) * (a * a) + r * (b * b));
    return slowness > 0 ? std::min(r * (a + b) / slowness, 1.0) : 0;  // all at 0 for a = r = 0
}

/// The way back.
double mass_share(double a, double b, double t);

/// The density is constant or changes linearly on each piece, and may jump between them.
class LineTable {
  public:
    /// Pieces side by side, not all without mass.
    explicit LineTable(std::vector<LinePiece> pieces);

    /// Density at x, over the mass: at a seam, that of the piece which begins there.
    [[nodiscard]] double density(double x) const;

    /// Of the density f / mass, smooth on each piece, by a rule there.
    [[nodiscard]] LineMoments moments_of(const std::function<double(double)>& f, double mass) const;

    /// The intervals on which the density is not 0, side by side.
    [[nodiscard]] std::vector<std::pair<double, double>> positive_intervals() const;

    [[nodiscard]] const std::vector<LinePiece>& pieces() const { return pieces_; }

    /// Piece that holds a place of the closed range.
    [[nodiscard]] std::size_t piece_of(double x) const;

    /// The number below which the share u in [0, 1] of the mass lies; never the end of a piece.
    [[nodiscard]] double quantile(double u) const;

    /// The same for many shares, in place.
    void quantiles(std::span<double> shares) const;

    /// The share of the mass below x.
    [[nodiscard]] double fraction(double x) const;

  private:
    /// What a quantile is worked out from: one line of the caches.
    struct alignas(64) Row {
        double before;  ///< mass below the piece, and of it
        double mass;
        double f_low;  ///< both over a power of 2
        double f_high;
        double x_low;
        double width;
        double last;  ///< the largest number in the piece
    };

    std::vector<LinePiece> pieces_;
    std::vector<Row> rows_;
    GuideTable masses_;  ///< of the pieces, side by side
};

}  // namespace stipple
