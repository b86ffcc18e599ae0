// SPDX-License-Identifier: MIT
//
// Plane shapes defined in their own frame, within a distance of about 1 from its origin, and their
// placement in the plane:
//
//     point = c + R (cos a  -sin a; sin a  cos a) q,    q = shape.forward(xi0, xi1)
//
// A Shape is a value with
//
//     PlanePoint forward(double u, double v) const     area-preserving, for u, v in [0, 1]
//     PlanePoint inverse(double x, double y) const     rounding may leave the unit square
//     double area() const                              in its own frame
//     double area_in(const Polygon& window) const      of the intersection with a convex polygon
//     double beyond(double x, double y) const          distance from the shape, at most 0 inside
//     std::vector<PlanePoint> hull(double turn) const  points with the same bounding box as the
//                                                      shape, after rotation by `turn` turns
//     PlaneMoments moments() const                     if uniform, in its own frame
//     std::vector<std::string> axes() const            meaning of the coordinates u and v
//
// Promise points lie in the closed shape up to 16 epsilon (R + |cx| + |cy|), the rounding error of
//         generated points.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/options.hpp"
#include "math/distributions/families.hpp"
#include "math/functions/trigonometry.hpp"
#include "math/geometry/law_moments.hpp"
#include "math/geometry/vector3.hpp"
#include "warps/common_options.hpp"
#include "warps/planar/area_share.hpp"
#include "warps/row_mapping.hpp"

namespace stipple::warps {

/// Option --center, which all placed shapes have.
inline constexpr Param<Numbers> shape_center{
    {.name = "center", .fallback = "0,0", .help = "Centre of the shape: x,y"}};

/// The option of shapes that can be rotated.
constexpr Param<double> rotation_option(std::string_view help) {
    return {.name = "rotation", .low = -360, .high = 360, .unit = "degrees", .help = help};
}

/// Places a shape of size R at `center`, rotated by `degrees`. @throws Error(usage) if rounding
/// would lose `finest`, the shape's smallest length, called `what` in the message ("radius")
Placement place(const std::vector<double>& center, double size, double degrees, double finest,
                std::string_view what);

template <class Shape>
class PlacedDomain final : public NamedDomain {
  public:
    PlacedDomain(std::string spec, Shape shape, const Placement& at)
        : NamedDomain(std::move(spec), 2, 2), shape_(std::move(shape)), at_(at) {
        slack_ = 16 * std::numeric_limits<double>::epsilon() *
                 (1 + (std::abs(at.center.x) + std::abs(at.center.y)) / at.size);
    }

    double measure() const override { return shape_.area() * at_.size * at_.size; }

    bool contains(std::span<const double> point) const override {
        const auto [x, y] = at_.to_frame(point[0], point[1]);
        return std::abs(x) < 4 && std::abs(y) < 4 && shape_.beyond(x, y) <= slack_;
    }

    Box bounding_box() const override {
        std::vector<double> rows;
        for (const PlanePoint& q : shape_.hull(at_.turn)) {
            const auto [x, y] = at_.to_world(q);
            rows.insert(rows.end(), {x, y});
        }
        return stipple::bounding_box(rows, 2);
    }

    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        const auto [x, y] = at_.to_frame(point[0], point[1]);
        const auto [u, v] = shape_.inverse(x, y);
        put_clamped<2>({u, v}, cube);
    }
    std::optional<Estimate> box_mass(const Box& box) const override {
        return area_share(box, *this, [&](Polygon window) {
            for (PlanePair& corner : window) {
                const auto [x, y] = at_.to_frame(corner[0], corner[1]);
                corner = {x, y};
            }
            return shape_.area_in(window) * at_.size * at_.size;
        });
    }
    std::optional<Moments> moments() const override {
        return placed_moments(shape_.moments(), at_);
    }
    std::vector<std::string> cube_axes() const override { return shape_.axes(); }

  private:
    Shape shape_;
    Placement at_;
    double slack_;
};

/// Map of the unit square onto a placed shape.
template <class Shape>
struct PlacedMethod {
    Shape shape;
    Placement at;

    std::array<double, 2> forward(const std::array<double, 2>& xi) const {
        const auto [x, y] = at.to_world(shape.forward(xi[0], xi[1]));
        return {x, y};
    }
    std::array<double, 2> inverse(std::span<const double> point) const {
        const auto [x, y] = at.to_frame(point[0], point[1]);
        const auto [u, v] = shape.inverse(x, y);
        return {u, v};
    }
};

/// Mapping onto a placed shape, whose own inverse also defines the domain's cells.
template <class Shape>
std::unique_ptr<Mapping> placed(std::string spec, const Shape& shape, const Placement& at) {
    return row_mapping(std::make_shared<PlacedDomain<Shape>>(std::move(spec), shape, at),
                       PlacedMethod<Shape>{shape, at});
}

}  // namespace stipple::warps
