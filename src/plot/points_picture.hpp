// SPDX-License-Identifier: MIT
//
// Pictures of points.
//
//     d = 1   histogram, with a mark for each point below
//     d = 2   a disk for each point, lengths along x and y alike, and the outline of their domain
//     d = 3   the same from a fixed place, in a box; distant points are paler and smaller
//     d > 3   every pair of the first 8 coordinates in a panel of its own, as of three if asked
//
// Too many disks to tell apart become pixels: one for each point, until (at some 300 000 in one
// frame) they would fill it; then a density. Several sets are drawn over each other, in colours.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/point_set.hpp"
#include "plot/chart.hpp"
#include "stipple/run.hpp"

namespace stipple::plot {

inline constexpr std::size_t most_pair_coordinates = 8;
inline constexpr double density_share = 0.75;  ///< of points to a frame's area, for their density

/// Sides of a box that differ by more measure different things; their lengths are not compared.
inline constexpr double most_unlike = 20;

/// How points are marked.
enum class Marking { automatic, disks, density };

/// A box that is drawn over the points, in shares of the bounding box of the first set's domain: a
/// lower corner above the upper one means that it goes on from 1 to 0.
struct MarkedBox {
    std::string kind;        ///< class of a page's style sheet
    std::string label = {};  ///< what it is, in words
    std::vector<double> low = {};
    std::vector<double> high = {};
    bool closed = true;  ///< drawn with a solid line; else dashed
};

/// A circle that is drawn over points of the plane.
struct MarkedCircle {
    Position centre;
    double radius = 0;
    bool torus = false;  ///< goes on across opposite sides of the first set's domain
};

struct PointsPicture {
    std::vector<const PointSet*> sets;  ///< of one dimension, none empty
    std::vector<std::string> names;     ///< of the sets, for the legend
    std::string title = {};
    std::string subtitle = {};
    Marking marking = Marking::automatic;
    std::vector<MarkedBox> boxes = {};
    std::vector<MarkedCircle> circles = {};
    bool cells = false;  ///< those of Voronoi, of a single set of the plane, in its domain's box
    bool pairs = false;  ///< of three coordinates as of more
    std::size_t most_disks = 20'000;                       ///< above, points are pixels
    std::size_t most_coordinates = most_pair_coordinates;  ///< of which pairs are drawn
};

/// Lines along the boundary, in the domain's coordinates; none where the domain has no inside (a circle)
/// or no end.
std::vector<std::vector<Position>> outline_of(const Domain& domain);

/// The box that a picture of the sets shows: their domain's and all points. Where points are outside
/// the unit cube that is their default domain, the box is that of the points.
/// A coordinate of words has as much room for each; one that is not visible is widened.
/// @throws Error(input) where it is too wide for an axis
Box shown_box(std::span<const PointSet* const> sets);

/// The coordinates' names, with what no picture can show of them.
std::vector<std::string> shown_names(const PointsPicture& picture);

/// Both ends of a coordinate, of words the first and the last.
std::pair<std::string, std::string> shown_ends(const PointsPicture& picture, const Box& box,
                                               std::size_t k);

/// The height of a picture of two coordinates over its width: that of the box, unless its sides are so
/// different that they measure different things.
double picture_ratio(const Box& box, std::size_t i, std::size_t j);

/// A point of three coordinates in the parallel projection of a picture, in units of the box's longest
/// side or, where sides are as different as above, each in units of its own; `depth` is larger for
/// nearer points.
struct Projected {
    double right = 0;
    double up = 0;
    double depth = 0;
};
Projected project(const Box& box, std::span<const double> point);

/// The least and the largest of these over the box.
std::pair<Projected, Projected> projected_range(const Box& box);

Drawing draw_points(const PointsPicture& picture, const PictureStyle& style, const RunContext& run);

/// Whether the unit cube is only the default domain of points that lie outside it.
bool without_domain(const PointSet& set);

/// Every pair of the first coordinates in a panel of its own, of two or more.
Drawing draw_pairs(const PointsPicture& picture, const PictureStyle& style, const RunContext& run);

/// The histogram of each coordinate in a panel of its own, at most 6 of them; they have one x axis
/// where their ranges are the same.
Chart histogram_chart(const PointsPicture& picture);

/// Histogram of the distances to the nearest other point, straight ones where points have no domain;
/// beside it that of independent points, unless a side is too short for it to hold. @throws Error(input) for a set of one point.
Chart distance_chart(std::span<const PointSet* const> sets, const std::vector<std::string>& names,
                     const RunContext& run);

}  // namespace stipple::plot
