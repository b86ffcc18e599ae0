// SPDX-License-Identifier: MIT
//
// Area-preserving map between the unit square and a plane region bounded by rings of straight edges
// that meet only in vertices. A point is inside if an odd number of rings surround it, so rings in
// rings are holes. The first coordinate is the fraction of the area below a row; the second is the
// fraction of the row's inner parts, from left to right:
//
//     u = A(y) / A,    A(y) = area below y        v = L(x, y) / L(y),   L(y) = length of the row
//
// Between two consecutive heights of vertices (a slab) L is linear. With L_0, L_1 at its ends and f
// the fraction of the slab's area below the row,
//
//     t = f (L_0 + L_1) / (L_0 + sqrt((1 - f) L_0^2 + f L_1^2)),    y = y_0 + t (y_1 - y_0),
//
// and likewise from above in the upper half of the area, so that no digits are lost towards a tip.
//
// The region is divided into trapezoids, each between two edges and from the height of one vertex
// to that of another. They are stored in a segment tree over the slabs, in the nodes that cover
// their height: the path from a slab to the root has all trapezoids that a row in the slab meets.
//
// Shape   any number of rings, any orientation. Coordinates within [-1e150, 1e150].
// Cost    O(n log n) time and memory. Per point on average O(1) for the slab; O(1) for the position
//         along the row if it has one part, at most O(log(n)^3).
// Promise round trips return (u, v) within a few epsilon, if L(y) > 0, and the point within epsilon
//         A / L(y) along y. Images lie in the closed region, up to slack(). Same bits on every
//         machine.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/domain.hpp"
#include "math/densities/guide_table.hpp"
#include "math/geometry/polygon_contact.hpp"
#include "math/geometry/vector3.hpp"
#include "stipple/run.hpp"
#include "warps/named_domain.hpp"

namespace stipple::warps {

class PolygonDomain final : public NamedDomain {
  public:
    /// @param edges edges of all rings, which may touch only at vertices
    /// @throws Error(limit) if the segment tree exceeds the memory limit
    PolygonDomain(std::string spec, const std::vector<RingSegment>& edges, const RunContext& run);

    double measure() const override { return area_; }

    /// Tolerance for rounding of generated points: 16 epsilon (largest coordinate).
    double slack() const { return slack_; }

    /// Whether the point is inside, or within slack() of the boundary.
    bool contains(std::span<const double> point) const override;
    Box bounding_box() const override { return box_; }
    void to_cube(std::span<const double> point, std::span<double> cube) const override;
    std::optional<Estimate> box_mass(const Box& box) const override;
    std::optional<Moments> moments() const override;
    std::vector<std::string> cube_axes() const override {
        return {"area fraction below", "position along the row"};
    }
    void from_cube(std::span<const double> cube, std::span<double> image) const;

  private:
    /// Region between two consecutive edges of a band, from left to right.
    struct Part {
        double left_bottom;
        double left_top;
        double right_bottom;
        double right_top;
        double before_bottom = 0;  ///< length of all parts further left, at the bottom
        double before_top = 0;

        double left(double t) const { return left_bottom + t * (left_top - left_bottom); }
        /// At least left(t), even if rounding makes two adjacent edges cross.
        double right(double t) const {
            const double x = right_bottom + t * (right_top - right_bottom);
            return x > left(t) ? x : left(t);
        }
        double before(double t) const { return before_bottom + t * (before_top - before_bottom); }
        double through(double t) const { return before(t) + (right(t) - left(t)); }
    };
    /// A node of the tree: consecutive slabs, and the parts that span all of them, left to right.
    struct Band {
        double bottom;
        double top;
        std::size_t first;  ///< index of the band's first part in parts_
        std::size_t last;
        std::size_t above;  ///< index of the next band on the path to the root; or none
    };
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    struct Slab {
        double bottom;
        double top;
        std::size_t band;  ///< the lowest band in the tree that contains the slab, or `none`
        double width_bottom = 0;
        double width_top = 0;
        double area = 0;
        double area_below = 0;
        double area_above = 0;
        double share_bottom = 0;  ///< width_bottom and width_top, divided by the larger one
        double share_top = 0;

        double height() const { return top - bottom; }
    };

    /// Section of one band by a horizontal row, which crosses all parts of the band.
    struct Cut {
        const Part* parts;
        std::size_t count;
        double t;  ///< relative height within the band

        /// Length of the first k parts.
        double before(std::size_t k) const {
            return k < count ? parts[k].before(t) : parts[count - 1].through(t);
        }
        /// Number of parts that begin to the left of x; known to be between `low` and `high`.
        std::size_t left_of(double x, std::size_t low, std::size_t high) const;
    };
    static constexpr std::size_t most_bands = 48;  ///< limit for the path from a slab to the root
    /// All parts that a row meets.
    struct Row {
        std::array<Cut, most_bands> cuts;
        std::size_t count = 0;

        std::span<const Cut> all() const { return {cuts.data(), count}; }
        double length() const;
    };
    struct Nearest {
        double left = 0;
        double right = 0;
        double gap = std::numeric_limits<double>::infinity();
    };

    void measure_rim(const std::vector<RingSegment>& edges);
    void cut_bands(const RunContext& run);
    void measure_slabs();
    PlanePoint forward(double u, double v) const;
    std::span<const Part> parts_of(const Band& band) const {
        return std::span(parts_).subspan(band.first, band.last - band.first);
    }
    Row row_at(const Slab& slab, double y) const;
    static double along_row(const Row& row, double way);
    static double place_in_row(const Row& row, double x);
    static Nearest nearest_part(const Row& row, double x);
    double gap(const Slab& slab, PlanePoint p) const;
    const Slab& slab_around(PlanePoint p) const;
    double distance_to_rim(PlanePoint p) const;

    std::vector<std::pair<PlanePoint, PlanePoint>> rim_;  ///< all edges of the boundary
    std::vector<Slab> slabs_;
    std::vector<Band> bands_;
    std::vector<Part> parts_;
    GuideTable areas_;             ///< cumulative areas of the slabs, from the lowest up
    std::size_t last_filled_ = 0;  ///< the topmost slab with an area
    Box box_;
    double area_ = 0;
    double slack_ = 0;
};

}  // namespace stipple::warps
