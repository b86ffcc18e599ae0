// SPDX-License-Identifier: MIT
//
// The local discrepancy of n points in the unit square: the fraction of points in the box from the
// origin to c, minus the box's area,
//
//     delta(c) = #{x in [0,c)} / n - c_1 c_2        for every c in the square.
//
// It is drawn as an image with one pixel for each c. The coordinates of its two extremes are
// coordinates of points or 1: the minimum is in an open box (too few points), the maximum in a
// closed one (too many). The larger magnitude is the star discrepancy.
//
// Cost    image: O(n + pixels), with cumulative counts. Worst boxes: O(n^(4/3)) in practice.
// Promise each pixel has the value at its centre; the worst boxes are those of star-discrepancy.
// Beware  points with a coordinate 1 are in no box [0,c), but in closed boxes that end at 1.
// Source  L. Kuipers, H. Niederreiter, "Uniform Distribution of Sequences" (1974), chapter 2.
#pragma once

#include <optional>
#include <string>

#include "core/point_set.hpp"
#include "plot/chart.hpp"
#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple::plot {

/// A box from the origin and its local discrepancy: negative if open, positive if closed.
struct AnchoredBox {
    Position corner;
    double value = 0;
};

/// The extremes of the local discrepancy: negative for `open`, positive for `closed`; nullopt if no
/// box has that sign.
struct WorstBoxes {
    std::optional<AnchoredBox> open;
    std::optional<AnchoredBox> closed;

    [[nodiscard]] double star() const;
};

/// Finds both boxes. @throws Error(input) if the set is empty, not two-dimensional, or outside the
/// unit square
WorstBoxes worst_boxes_of(const PointSet& points, const RunContext& run);

/// Values of delta at the centres of a grid's cells; the first row is the lowest.
Grid local_discrepancy(const PointSet& points, std::size_t columns, std::size_t rows,
                       const RunContext& run);

/// "[0, 0.5) × [0, 0.25): −0.03"; `digits` is the number of digits of the corner's coordinates.
std::string text_of(const AnchoredBox& box, int digits);

/// Title and colour scale of the picture.
struct LocalDiscrepancyFrame {
    std::string title;
    std::string subtitle;
    double largest = 0;     ///< colours range from minus this value to this value
    bool bar = true;        ///< draws the colour bar
    double resolution = 2;  ///< pixels per unit of the drawing; at most 2048 per side
};

/// Draws the image, the worst boxes, and the points, unless they would cover the image.
Drawing draw_local_discrepancy(const PointSet& points, const WorstBoxes& worst,
                               const LocalDiscrepancyFrame& around, const PictureStyle& style,
                               const RunContext& run);

}  // namespace stipple::plot
