// SPDX-License-Identifier: MIT
//
// The local discrepancy of n points in the unit square: by how much the share of points in the box
// from the origin to c differs from its area,
//
//     delta(c) = #{x in [0,c)} / n - c_1 c_2        for every c in the square.
//
// It is drawn as an image, one pixel for each c. The two extremes are reached or approached at
// corners made of coordinates of points and 1: the least in an open box (too few points), the
// largest in a closed one (too many). The greater of the two in size is the star discrepancy.
//
// Cost    image: O(n + pixels), by running sums of points. Worst boxes: O(n^(4/3)) in practice.
// Promise each pixel has the value at its middle; the worst boxes are those of star-discrepancy.
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

/// A box from the origin, and its local discrepancy: below 0 where it is open, above where closed.
struct AnchoredBox {
    Position corner;
    double value = 0;
};

/// The extremes of the local discrepancy; none where it is never of that sign.
struct WorstBoxes {
    std::optional<AnchoredBox> open;
    std::optional<AnchoredBox> closed;

    /// The star discrepancy.
    [[nodiscard]] double star() const;
};

/// @throws Error(input) for an empty set, points of another dimension, or outside the unit square
WorstBoxes worst_boxes_of(const PointSet& points, const RunContext& run);

/// delta at the middles of cells of the unit square; the first row is the lowest.
Grid local_discrepancy(const PointSet& points, std::size_t columns, std::size_t rows,
                       const RunContext& run);

/// "[0, 0.5) × [0, 0.25): −0.03", with so many digits of the corner.
std::string text_of(const AnchoredBox& box, int digits);

/// What stands around a picture, and what its colours mean.
struct LocalDiscrepancyFrame {
    std::string title;
    std::string subtitle;
    double largest = 0;     ///< colours go from minus this to this
    bool bar = true;        ///< says so beside the picture
    double resolution = 2;  ///< pixels of the image in a unit, where these are not too many
};

/// The image with the points on it, unless they would cover it, and the worst boxes.
Drawing draw_local_discrepancy(const PointSet& points, const WorstBoxes& worst,
                               const LocalDiscrepancyFrame& around, const PictureStyle& style,
                               const RunContext& run);

}  // namespace stipple::plot
