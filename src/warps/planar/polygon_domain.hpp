// SPDX-License-Identifier: MIT
//
// Equal areas between the unit square and a region of the plane bounded by rings of straight edges
// that meet in vertices only; inside is what an odd number of them surrounds, so that rings in rings
// are holes. The first coordinate is the share of the area below a row, the second the place along the
// parts of that row that are inside, one after the other:
//
//     u = A(y) / A,    A(y) = area below y        v = L(x, y) / L(y),   L(y) = length of the row
//
// Between the heights of two vertices that follow each other (a slab) L is linear, so that with
// L_0, L_1 at its ends and f the share of the slab's area that is below the row
//
//     t = f (L_0 + L_1) / (L_0 + sqrt((1 - f) L_0^2 + f L_1^2)),    y = y_0 + t (y_1 - y_0),
//
// and in the upper half of the area the same from above, so that nothing is lost towards a tip.
//
// The region is cut into trapezoids, each between two edges from the height of one vertex to that of
// another. A trapezoid is kept in the nodes of a segment tree over the slabs that cover its height,
// so that those that a row meets are on the way from its slab to the root.
//
// Shape   any number of rings, any orientation. Coordinates within [-1e150, 1e150].
// Cost    O(n log n) time and memory; per point O(1) for the slab, on average, and for the place
//         along the row O(1) where it has one part, at most O(log(n)^3).
// Promise (u, v) comes back within some epsilon of 1, where L(y) > 0; the point within epsilon A /
//         L(y) along y. Images are on the closed region, up to slack(). Same bits on every machine.
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
    /// Edges of rings that meet in vertices only. @throws Error(limit)
    PolygonDomain(std::string spec, const std::vector<RingSegment>& edges, const RunContext& run);

    double measure() const override { return area_; }

    /// 16 epsilon (largest coordinate): how far rounding takes a point that was made.
    double slack() const { return slack_; }

    /// Whether the point is inside, or within slack() of the rim.
    bool contains(std::span<const double> point) const override;
    Box bounding_box() const override { return box_; }
    void to_cube(std::span<const double> point, std::span<double> cube) const override;
    std::optional<Estimate> box_mass(const Box& box) const override;
    std::optional<Moments> moments() const override;
    std::vector<std::string> cube_axes() const override {
        return {"area fraction below", "place along the row"};
    }
    void from_cube(std::span<const double> cube, std::span<double> image) const;

  private:
    /// What is inside between two edges that follow each other from left to right, in one band.
    struct Part {
        double left_bottom;
        double left_top;
        double right_bottom;
        double right_top;
        double before_bottom = 0;  ///< length of the band's parts on the left
        double before_top = 0;

        double left(double t) const { return left_bottom + t * (left_top - left_bottom); }
        /// At least left(t), also where rounding crosses two edges that are next to each other.
        double right(double t) const {
            const double x = right_bottom + t * (right_top - right_bottom);
            return x > left(t) ? x : left(t);
        }
        double before(double t) const { return before_bottom + t * (before_top - before_bottom); }
        double through(double t) const { return before(t) + (right(t) - left(t)); }
    };
    /// Rows of slabs that follow each other, a node of the tree, with the parts that reach from its
    /// bottom to its top, from left to right.
    struct Band {
        double bottom;
        double top;
        std::size_t first;  ///< of its parts in parts_
        std::size_t last;
        std::size_t above;  ///< the next band towards the root; none: `none`
    };
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    struct Slab {
        double bottom;
        double top;
        std::size_t band;  ///< the lowest in the tree that holds it; none: `none`
        double width_bottom = 0;
        double width_top = 0;
        double area = 0;
        double area_below = 0;
        double area_above = 0;
        double share_bottom = 0;  ///< widths as shares of the greater one
        double share_top = 0;

        double height() const { return top - bottom; }
    };

    /// Parts of one band where a row cuts them.
    struct Cut {
        const Part* parts;
        std::size_t count;
        double t;  ///< share of the band's height

        /// Length of the first k parts.
        double before(std::size_t k) const {
            return k < count ? parts[k].before(t) : parts[count - 1].through(t);
        }
        /// Number of parts that begin on the left of x, those from `low` to `high` being in doubt.
        std::size_t left_of(double x, std::size_t low, std::size_t high) const;
    };
    static constexpr std::size_t most_bands = 48;  ///< on the way from a slab to the root
    /// All that a row meets.
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

    std::vector<std::pair<PlanePoint, PlanePoint>> rim_;  ///< all edges
    std::vector<Slab> slabs_;
    std::vector<Band> bands_;
    std::vector<Part> parts_;
    GuideTable areas_;             ///< of the slabs, from the lowest on
    std::size_t last_filled_ = 0;  ///< the topmost slab that has an area
    Box box_;
    double area_ = 0;
    double slack_ = 0;
};

}  // namespace stipple::warps
