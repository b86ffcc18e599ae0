// SPDX-License-Identifier: MIT
//
// A tabulated density on a box in the plane. The box is cut along x into strips, and each strip
// along y into its own patches, on which the table is bilinear. The marginal density of x is then
// linear on each strip, and the conditional density of y at x is linear on each patch:
//
//     p(x) = integral p(x, y) dy,    p(y | x) = p(x, y) / p(x).
//
// Both are inverted exactly (math/densities/line_table.hpp). Strips and patches are halved, the
// worst one first, until the sum of area * largest |f - table| over all patches is below tolerance
// * integral. Patches are not made finer than is useful for the width of their strip.
//
// Shape   any f that is finite, not negative, and not 0 everywhere.
// Cost    about 1 / sqrt(tolerance) strips, and as many patches in each, for a smooth f; 1 /
//         tolerance strips of about 20 patches if f jumps along a slanting line. 56 bytes per
//         patch. A point takes O(1) plus the logarithm of the number of patches in a strip.
// Beware  f is sampled on a grid of 512 x 512 points. After refinement to the tolerance it is
//         sampled at 2^17 other points, again and again until they show no mass that the table
//         misses. A feature that contains a disk of 1/256 of the box's extents is found, its mass
//         correct to 3 %; a smaller one only if a sample hits it.
// Promise a patch has no mass if f is 0 at a sample inside, so that no point is beyond a jump to 0
//         that was sampled. x increases with xi0, and y with xi1 for given x.
#pragma once

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/domain.hpp"
#include "math/densities/guide_table.hpp"
#include "math/densities/line_table.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Patch from y_low to y_high of a strip, with densities at its corners.
struct StripPatch {
    double y_low;
    double y_high;
    std::array<double, 2> left;  ///< densities at y_low and y_high
    std::array<double, 2> right;

    /// Densities at y_low and y_high at the fraction t of the width.
    [[nodiscard]] std::array<double, 2> ends(double t) const {
        return {(1 - t) * left[0] + t * right[0], (1 - t) * left[1] + t * right[1]};
    }
};

struct Strip {
    double x_low;
    double x_high;
    std::vector<StripPatch> patches;
};

/// Tabulates f. `what` names it in messages.
/// @throws Error(usage) if f is negative, not finite or 0 everywhere; Error(limit) if the tolerance
///         cannot be reached, or if new samples keep showing mass that the table misses
std::vector<Strip> tabulate_strips(const std::string& what, const BlockFunction& f, const Box& box,
                                   double tolerance, const RunContext& run);

class StripTable {
  public:
    explicit StripTable(const std::vector<Strip>& strips);

    [[nodiscard]] std::array<double, 2> quantile(double u, double v) const;
    [[nodiscard]] std::array<double, 2> fraction(double x, double y) const;

    /// Density of the points that quantile() returns, at (x, y).
    [[nodiscard]] double density(double x, double y) const;

  private:
    /// A patch, and the integrals over y from the strip's bottom to the patch's top on both strip
    /// sides.
    struct Patch {
        StripPatch shape;
        double left_sum;
        double right_sum;

        [[nodiscard]] double sum_at(double t) const { return (1 - t) * left_sum + t * right_sum; }
    };
    struct Column {
        double x_low;
        double x_high;
        std::size_t first;  ///< index of the first patch
        double left;        ///< integral of the density over y on the left side
        double right;

        /// Position (0: left side, 1: right side) at which the density of y given x is taken: t
        /// itself or, if the column has no mass there, the other side.
        [[nodiscard]] double side(double t) const {
            if ((1 - t) * left + t * right > 0) return t;
            return left > 0 ? 0 : 1;
        }
    };

    /// Index of the column that contains x, and the position of x between its sides.
    [[nodiscard]] std::pair<std::size_t, double> column_at(double x) const;
    /// Index of the last patch that begins at or below y.
    [[nodiscard]] static std::size_t patch_at(std::span<const Patch> patches, double y);

    [[nodiscard]] std::span<const Patch> patches_of(std::size_t column) const {
        return std::span(patches_).subspan(columns_[column].first,
                                           columns_[column + 1].first - columns_[column].first);
    }

    /// The columns, followed by a sentinel with the number of patches as `first`.
    std::vector<Column> columns_;
    std::vector<Patch> patches_;
    GuideTable masses_;  ///< running sums of the strips' masses
};

}  // namespace stipple
