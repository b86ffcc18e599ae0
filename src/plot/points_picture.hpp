// SPDX-License-Identifier: MIT
//
// Pictures of points.
//
//     d = 1   histogram, with a mark for each point below
//     d = 2   a disk for each point and the outline of the domain; x and y have equal scales
//     d = 3   a parallel projection from a fixed direction, in a box; distant points are paler and
//             smaller
//     d > 3   each pair of the first 8 coordinates in its own panel; on request for d = 3, too
//
// Too many disks to distinguish become pixels, one per point. If pixels would fill the frame (at
// about 300 000 points), a density is drawn. Several sets are drawn over each other, in colours.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/point_set.hpp"
#include "plot/chart.hpp"
#include "stipple/run.hpp"

namespace stipple::plot {

inline constexpr std::size_t most_pair_coordinates = 8;
inline constexpr double density_share = 0.75;  ///< minimum points per square unit for a density

/// Limit for the ratio of a box's sides. Beyond it, coordinates are assumed to have different units
/// and are scaled separately.
inline constexpr double most_unlike = 20;

enum class Marking { automatic, disks, density };

/// A box drawn over the points, in coordinates from 0 to 1 relative to the box around the first
/// set's domain. Where low > high, it wraps around from 1 to 0.
struct MarkedBox {
    std::string kind;  ///< class in a page's style sheet
    std::string label = {};
    std::vector<double> low = {};
    std::vector<double> high = {};
    bool closed = true;  ///< whether drawn with a solid line; false: dashed
};

/// A circle drawn over plane points.
struct MarkedCircle {
    Position centre;
    double radius = 0;
    bool torus = false;  ///< whether it continues across opposite sides of the first set's domain
};

struct PointsPicture {
    std::vector<const PointSet*> sets;  ///< at least one; equal dimensions, none empty
    std::vector<std::string> names;     ///< names of the sets, for the legend
    std::string title = {};
    std::string subtitle = {};
    Marking marking = Marking::automatic;
    std::vector<MarkedBox> boxes = {};
    std::vector<MarkedCircle> circles = {};
    std::vector<std::pair<Position, Position>> lines = {};  ///< drawn thinly over plane points
    bool cells = false;  ///< draws the Voronoi cells of a single plane set, in its domain's box
    bool pairs = false;  ///< whether three coordinates are drawn as pairs
    /// Whether each coordinate has a logarithmic axis; empty: none has.
    std::vector<bool> log = {};
    std::vector<std::string> units = {};  ///< unit of each coordinate, or ""; may be empty
    std::size_t most_disks = 20'000;      ///< limit beyond which pixels replace disks
    std::size_t most_coordinates = most_pair_coordinates;  ///< limit for coordinates drawn in pairs
};

/// Polylines along the boundary of a planar domain, in its coordinates; empty for other dimensions
/// and for domains that are unbounded or have no interior (a circle).
std::vector<std::vector<Position>> outline_of(const Domain& domain);

/// The box that a picture of the sets shows: around their domain and all points, or around the
/// points alone if the domain is only the default unit cube and points are outside. Each level of a
/// categorical coordinate gets the same space. A range too narrow to be visible is widened.
/// @throws Error(input) if the range is too wide for an axis
Box shown_box(std::span<const PointSet* const> sets);

/// Whether all values of a coordinate that a picture shows are positive.
bool is_positive(std::span<const PointSet* const> sets, std::size_t k);

/// Names of the coordinates, with units, and notes on ranges too narrow to be shown.
std::vector<std::string> shown_names(const PointsPicture& picture);

/// Texts for both ends of a coordinate: numbers, or the first and last level of a categorical
/// coordinate.
std::pair<std::string, std::string> shown_ends(const PointsPicture& picture, const Box& box,
                                               std::size_t k);

/// Axis of a coordinate, without a name.
Axis shown_axis(const PointsPicture& picture, const Box& box, std::size_t k);

/// Height over width of a picture of the first two coordinates: the ratio of the box's sides, or 1
/// if that is beyond most_unlike or an axis is logarithmic.
double picture_ratio(const PointsPicture& picture, const Box& box);

/// Whether the picture is a parallel projection of points with three coordinates.
bool is_space(const PointsPicture& picture);

/// A three-dimensional point in a picture's parallel projection. The unit is the box's longest
/// side; each side has its own unit if the ratio of sides is beyond most_unlike. `depth` is larger
/// for nearer points.
struct Projected {
    double right = 0;
    double up = 0;
    double depth = 0;
};
Projected project(const Box& box, std::span<const double> point);

/// Minimum and maximum of the projected box.
std::pair<Projected, Projected> projected_range(const Box& box);

Drawing draw_points(const PointsPicture& picture, const PictureStyle& style, const RunContext& run);

/// Whether the domain is the unit cube, but points lie outside, so that it is only the default.
bool without_domain(const PointSet& set);

/// Draws each pair of the first coordinates in its own panel; needs two or more coordinates.
Drawing draw_pairs(const PointsPicture& picture, const PictureStyle& style, const RunContext& run);

/// Histograms of each coordinate in separate panels, at most 6. They share an x axis if their
/// ranges are equal.
Chart histogram_chart(const PointsPicture& picture);

/// Histogram of the distances to the nearest neighbour; not periodic if the points have no domain.
/// Also shows the density for independent points, except if a side of the domain is too short for
/// the formula. If `log`, the axis is logarithmic, without distances of 0.
/// @throws Error(input) for a set with one point
Chart distance_chart(std::span<const PointSet* const> sets, const std::vector<std::string>& names,
                     bool log, const RunContext& run);

}  // namespace stipple::plot
