// SPDX-License-Identifier: MIT
//
// A density on a box of the plane, tabulated: the box is cut into strips along x, each strip along
// y into patches of its own, on which the table is bilinear. The marginal density of x is then
// linear on each strip, and the conditional density of y at x is linear on each patch:
//
//     p(x) = integral p(x, y) dy,    p(y | x) = p(x, y) / p(x).
//
// Both are inverted exactly (math/densities/line_table.hpp). Strips and patches are halved, the worst one
// first, until the sum of area * largest |f - table| over all patches is below tolerance *
// integral; patches of a strip no finer than its width asks for.
//
// Shape   any f that is finite and not negative, not 0 everywhere.
// Cost    1 / sqrt(tolerance) strips and patches of each for a smooth f; 1 / tolerance strips of
//         some 20 patches where f jumps along a slanting line. 56 bytes a patch. O(1) plus the
//         logarithm of a strip's patches for a point.
// Beware  f is looked at on a grid of 512 x 512 places, and when that has been refined to the
//         tolerance, in 2^17 others, until these show no mass that the table lacks. What holds a disk
//         of 1/256 of the box's extents is seen, its mass right to 3 %; what is smaller, if a place is
//         on it.
// Promise a patch in which f was seen to be 0 inside holds no mass, so that no point lands beyond a
//         jump to 0 that the patch was seen to hold. x rises in xi0; y in xi1 for a given x.
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

/// From y_low to y_high of a strip; densities at its corners.
struct StripPatch {
    double y_low;
    double y_high;
    std::array<double, 2> left;  ///< at y_low and y_high
    std::array<double, 2> right;

    /// The same at the share t of the width.
    [[nodiscard]] std::array<double, 2> ends(double t) const {
        return {(1 - t) * left[0] + t * right[0], (1 - t) * left[1] + t * right[1]};
    }
};

struct Strip {
    double x_low;
    double x_high;
    std::vector<StripPatch> patches;
};

/// Strips for f, whose points stand one after the other. `what` names it.
/// @throws Error(usage): negative, not finite, 0 everywhere; Error(limit): tolerance out of reach, or
/// looks at other places go on to show mass that the table lacks
std::vector<Strip> tabulate_strips(const std::string& what, const BlockFunction& f, const Box& box,
                                   double tolerance, const RunContext& run);

class StripTable {
  public:
    explicit StripTable(const std::vector<Strip>& strips);

    [[nodiscard]] std::array<double, 2> quantile(double u, double v) const;
    [[nodiscard]] std::array<double, 2> fraction(double x, double y) const;

    /// Of the points that quantile() gives, at a place of the box.
    [[nodiscard]] double density(double x, double y) const;

  private:
    /// Integrals over y on a strip's two sides, up to the upper end of a patch.
    struct Patch {
        StripPatch shape;
        double left_sum;
        double right_sum;

        [[nodiscard]] double sum_at(double t) const { return (1 - t) * left_sum + t * right_sum; }
    };
    struct Column {
        double x_low;
        double x_high;
        std::size_t first;  ///< patch
        double left;        ///< integrals over y
        double right;

        /// Where between the sides the conditional is to be taken, for a place t: on a side without
        /// mass, it is the limit, which is the other side's.
        [[nodiscard]] double side(double t) const {
            if ((1 - t) * left + t * right > 0) return t;
            return left > 0 ? 0 : 1;
        }
    };

    /// The column that holds x, and where between its sides x is.
    [[nodiscard]] std::pair<std::size_t, double> column_at(double x) const;
    /// The last of the patches that begins at y or below.
    [[nodiscard]] static std::size_t patch_at(std::span<const Patch> patches, double y);

    [[nodiscard]] std::span<const Patch> patches_of(std::size_t column) const {
        return std::span(patches_).subspan(columns_[column].first,
                                           columns_[column + 1].first - columns_[column].first);
    }

    std::vector<Column> columns_;  ///< and one more, for its `first`
    std::vector<Patch> patches_;
    GuideTable masses_;  ///< of the strips, side by side
};

}  // namespace stipple
