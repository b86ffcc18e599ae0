// SPDX-License-Identifier: MIT
//
// Equal areas between the unit square and a region of the plane bounded by rings of straight edges
// that do not meet; inside is what an odd number of them surrounds, so that rings in rings are
// holes. The first coordinate is the share of the area below a row, the second the place along the
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
// Shape   any number of rings, any orientation. Coordinates within [-1e150, 1e150].
// Cost    O(n + edges of all slabs) memory; per point O(1) for the slab, on average, and O(edges
//         of the slab) for the place along the row.
// Promise (u, v) comes back within some epsilon of 1, where L(y) > 0; the point within epsilon A /
//         L(y) along y. Images are on the closed region, up to slack(). Same bits on every machine.
#pragma once

#include <cstddef>
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
    /// Rings without contact, with at least 3 vertices each. @throws Error(limit)
    PolygonDomain(std::string spec, const std::vector<Ring>& rings, const RunContext& run);

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
    /// What is inside between two edges that follow each other from left to right, in one slab.
    struct Part {
        double left_bottom;
        double left_top;
        double right_bottom;
        double right_top;

        double left(double t) const { return left_bottom + t * (left_top - left_bottom); }
        /// At least left(t), also where rounding crosses two edges that are next to each other.
        double right(double t) const {
            const double x = right_bottom + t * (right_top - right_bottom);
            return x > left(t) ? x : left(t);
        }
    };
    struct Slab {
        double bottom;
        double top;
        std::size_t first;  ///< of its parts in parts_
        std::size_t last;
        double width_bottom = 0;
        double width_top = 0;
        double area = 0;
        double area_below = 0;
        double area_above = 0;
        double share_bottom = 0;  ///< widths as shares of the greater one
        double share_top = 0;

        double height() const { return top - bottom; }
        double width(double t) const { return width_bottom + t * (width_top - width_bottom); }
    };

    void measure_rings(const std::vector<Ring>& rings);
    void cut_slabs(const RunContext& run);
    void measure_slabs();
    PlanePoint forward(double u, double v) const;
    std::span<const Part> parts_of(const Slab& slab) const {
        return std::span(parts_).subspan(slab.first, slab.last - slab.first);
    }
    double along_row(const Slab& slab, double t, double way) const;
    double place_in_row(const Slab& slab, double t, double x) const;
    double gap(const Slab& slab, PlanePoint p) const;
    const Slab& slab_around(PlanePoint p) const;
    double distance_to_rim(PlanePoint p) const;

    std::vector<std::pair<PlanePoint, PlanePoint>> rim_;  ///< all edges
    std::vector<Slab> slabs_;
    std::vector<Part> parts_;
    GuideTable areas_;             ///< of the slabs, from the lowest on
    std::size_t last_filled_ = 0;  ///< the topmost slab that has an area
    Box box_;
    double area_ = 0;
    double slack_ = 0;
};

}  // namespace stipple::warps
